// The matrix of an implicit step: A = M (1 + b c) + b D + b^2 K, with b the implicit part of the step [s], c the drag,
// D the dashpots' and K the springs' stiffness at given positions. A spring's blocks are known in closed form,
//   K = k u u^T + (k (1 - l0 / l) + d w / l) (I - u u^T),   D = d u u^T,   w = (v1 - v2).u,
// with k I for K at l = 0. (The dashpot's direction changes with the positions; the symmetric part of that
// derivative is in K, the rest is dropped, so that A is symmetric and Newton's method a little slower.) The factor of I - u u^T is
// negative where a spring is compressed; taken as zero there, every block, and A, is positive definite: the nearest such
// matrix, without an eigensolver.
#pragma once

#include <vector>

#include "sim/forces/force_tangent.h"
#include "sim/forces/spring_tangents.h"
#include "sim/methods/implicit/linear_solver.h"

namespace hooke {

// The positions of the springs' blocks in a solver's matrix, found once per topology. The hand's pull between three points,
// forces on the center of mass and the pressure in a volume couple points that no spring joins. They are not part of the pattern but
// updates of rank 1, the first two one for each component, to what was factored:
//   A = B + w s s^T,   A^-1 r = y - z w / (1 + w s.z) s.y,   B y = r,  B z = s
// (J. Sherman, W. J. Morrison 1950, M. A. Woodbury 1950); with several, one after another.
class StiffnessMatrix {
 public:
  explicit StiffnessMatrix(const Plan& plan);
  // Once per frame, before its first assemble: a step never allocates. Without it there are no updates.
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
  void add_springs(const Plan& plan, double b, const Field& x, const Field& v, Curvature curvature);
  void set_updates(const Plan& plan, double b);
  void apply_updates(std::size_t count, Field& r) const;

  LinearSolver solver_;
  std::vector<LinearSolver::Block> diagonal_;  // of the points
  std::vector<LinearSolver::Block> coupling_;  // of the packed springs
  std::vector<LinearSolver::Block> hinges_;    // of the entries of the matrix of the hinges, on and above the diagonal
  std::vector<LinearSolver::Block> enclosure_edges_;

  struct Update {
    double weight = 0.0;     // w; 0: there is none
    Field vector, response;  // s, z
    double gain = 0.0;       // w / (1 + w s.z)
  };
  double time_ = 0.0;            // [s]
  std::vector<Update> updates_;  // of the pull between points, of forces on the center of mass, and of the volumes
  bool is_linearized_ = false;
  ForceTangent tangent_;
};

}  // namespace hooke
