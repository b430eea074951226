// The matrix of an implicit step: A = M (1 + b c) + b D + b^2 K, with b the implicit part of the step [s], c the drag,
// D the dashpots' and K the springs' stiffness at given positions. A spring's blocks are known in closed form,
//   K = k u u^T + (k (1 - l0 / l) + d w / l) (I - u u^T),   D = d u u^T,   w = (v1 - v2).u,
// with k I for K at l = 0. (The dashpot's direction changes with the positions; the symmetric part of that
// derivative is in K, the rest is dropped, so that A is symmetric and Newton's method a little slower.) The factor of I - u u^T is
// negative where a spring is compressed; taken as zero there, every block, and A, is positive definite: the nearest such
// matrix, without an eigensolver.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <vector>

#include "sim/forces/force_tangent.h"
#include "sim/methods/implicit/linear_solver.h"

namespace hooke {

enum class Curvature { Exact, Clamped };

// The positions of the springs' blocks in a solver's matrix, found once per topology. The hand's pull between three points,
// forces on the center of mass and the pressure in a volume couple points that no spring joins. Each is of the form w s_i s_j I, and is not
// part of the pattern but an update of rank 3 to what was factored:
//   A = B + w S S^T,  S = s I,   A^-1 r = y - Z G S^T y,   B y = r,  B Z = S,  G = w (I + w S^T Z)^-1
// (J. Sherman, W. J. Morrison 1950, M. A. Woodbury 1950); with several, one after another.
class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const Plan& plan);
  // Once per frame, before its first assemble: a step never allocates.
  void allocate(const Plan& plan);

  // Takes the derivatives of the listed forces at x and v into the next assemble; until the next allocate. The rest lengths of springs
  // are those at this time.
  void linearize_forces(const Plan& plan, double time, const Field& x, const Field& v);
  // Adds `scale` D v of the listed forces, over the points that move freely.
  void add_force_damping(const Plan& plan, double scale, const Field& v, Field& result) const;
  // Sets A. Points that are not free keep their mass on the diagonal and are coupled to nothing, so that nailing and
  // grabbing do not change the pattern.
  void assemble(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature);
  // False when A, without the updates of low rank, is not positive definite; then it cannot solve.
  bool factorize();
  // b becomes A^-1 b.
  void solve(Field& b);

 private:
  void add_hinges(const Plan& plan, double b, Curvature curvature);
  void add_volume_curvature(const Plan& plan, double b);
  template <int Dimensions>
  void add_springs(const Plan& plan, double b, const double* x, const double* v, Curvature curvature);

  LinearSolver solver_;
  std::vector<LinearSolver::Block> diagonal_;  // of the points
  std::vector<LinearSolver::Block> coupling_;  // of the packed springs
  std::vector<LinearSolver::Block> hinges_;    // of the entries of the matrix of the hinges, on and above the diagonal
  std::vector<LinearSolver::Block> enclosure_edges_;

  struct Update {
    std::vector<PlannedPull::Part> parts;  // s; zero for points that do not move freely
    double weight = 0.0;                   // w
    std::array<Field, 3> response;         // Z, a field per component
    glm::dmat3 gain{1.0};                  // G
    glm::dvec3 project(const double* field, std::size_t points, int dimensions) const;
  };
  void apply(const Update& update, Field& b) const;

  // The update w g g^T of rank 1 for the volume of an enclosure: A^-1 r = y - z w / (1 + w g.z) g.y, B z = g.
  struct VolumeUpdate {
    double weight = 0.0;       // w
    Field gradient, response;  // g, zero for points that do not move freely; z
    double gain = 0.0;         // w / (1 + w g.z)
  };
  static void apply(const VolumeUpdate& update, Field& b);

  int dimensions_;
  double time_ = 0.0;            // [s]
  std::vector<Update> updates_;  // of the pull between points, and of forces on the center of mass
  std::vector<VolumeUpdate> volume_updates_;
  bool has_pull_update_ = false, has_forces_ = false, is_linearized_ = false;
  ForceTangent tangent_;
};

}  // namespace hooke
