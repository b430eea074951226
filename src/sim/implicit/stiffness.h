// The matrix of an implicit step: A = M (1 + b c) + b D + b^2 K, with b the step's share that is implicit [s], c the drag,
// D the dashpots' and K the springs' stiffness at given positions. A spring's blocks are known in closed form,
//   K = k u u^T + (k (1 - l0 / l) + d w / l) (I - u u^T),   D = d u u^T,   w = (v1 - v2).u,
// with k I for K at l = 0. (The dashpot's direction changes with the positions; of that derivative the symmetric part stands
// in K, the rest is dropped, so that A is symmetric and Newton's method a little slower.) The factor of I - u u^T is
// negative where a spring is compressed; taken as zero there, every block, and A, is positive definite: the nearest such
// matrix, without an eigensolver.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <optional>

#include "sim/implicit/linear_solver.h"

namespace hooke {

enum class Curvature { Exact, Clamped };

// The places of the springs' blocks in a solver's matrix: found once a topology. A pull between three points k s_i s_j I
// couples points that no spring may join; it is no part of the pattern but a change of rank 3 of what was factored:
//   A = B + W W^T,  W = b sqrt(k) s I,   A^-1 r = y - Z (I + W^T Z)^-1 W^T y,   B y = r,  B Z = W
// (J. Sherman, W. J. Morrison 1950, M. A. Woodbury 1950).
class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const Plan& plan);
  // Once a frame, before its first assemble: a step never allocates.
  void allocate(const Plan& plan);

  // Sets A. Points that do not move freely keep their mass on the diagonal and are coupled to nothing, so that nailing and
  // grabbing change no pattern.
  void assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature);
  // False when A, without a pull between points, is not positive definite; then there is nothing to solve with.
  bool factorize();
  // b becomes A^-1 b.
  void solve(Field& b);

 private:
  template <int Dimensions>
  void add_springs(const Plan& plan, double b, const double* x, const double* v, Curvature curvature);

  LinearSolver solver_;
  std::vector<LinearSolver::Block> diagonal_;  // of the points
  std::vector<LinearSolver::Block> coupling_;  // of the packed springs

  std::optional<PlannedPull> pull_;  // between points; those that do not move freely have no share
  double weight_ = 0.0;              // b^2 k of it
  std::array<Field, 3> response_;    // Z / (b sqrt(k)), a field a component
  glm::dmat3 gain_{1.0};             // b^2 k (I + W^T Z)^-1
};

}  // namespace hooke
