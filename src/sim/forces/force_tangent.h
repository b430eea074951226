// Derivatives of the scene's optional forces, as the matrix of an implicit step takes them: symmetric and positive semidefinite,
// parts that are not being left out.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "base/types.h"

namespace hooke {

class ForceTangent {
 public:
  // Zero, for `points` points and the entries of the matrix of the hinges (hinges.h).
  void reset(Index points, std::size_t hinge_entries) {
    stiffness_.assign(points, glm::dmat3(0.0));
    damping_.assign(points, glm::dmat3(0.0));
    hinge_damping_.assign(hinge_entries, glm::dmat3(0.0));
    mean_stiffness_ = mean_damping_ = hinge_stiffness_ = 0.0;
    are_hinges_damped_ = false;
  }

  // -df/dx [N/m] or -df/dv [N s/m] of one point: `axial` along the unit vector u, `transverse` across it.
  void add_stiffness(Index point, const Vec3& u, double axial, double transverse) { add(stiffness_[point], u, axial, transverse); }
  void add_damping(Index point, const Vec3& u, double axial, double transverse) { add(damping_[point], u, axial, transverse); }
  // Of a force that depends on the center of mass alone and is distributed by mass: block (i, j) is m_i m_j k I [N/m], k in
  // [N/(m kg^2)], and likewise for the damping.
  void add_mean(double stiffness, double damping) {
    mean_stiffness_ += stiffness;
    mean_damping_ += damping;
  }
  // Of the hinges: `stiffness` [N m] times the matrix of the Plan, for each component; and -df/dv of an entry on or above its diagonal.
  void add_hinges(double stiffness) { hinge_stiffness_ += stiffness; }
  void add_hinge_damping(Index entry, const glm::dmat3& block) {
    hinge_damping_[entry] += block;
    are_hinges_damped_ = true;
  }

  // b D + b^2 K of a point, and of the mean the factor of m_i m_j.
  glm::dmat3 block(Index point, double b) const { return b * damping_[point] + b * b * stiffness_[point]; }
  double mean(double b) const { return b * mean_damping_ + b * b * mean_stiffness_; }
  const glm::dmat3& damping(Index point) const { return damping_[point]; }
  double hinge_stiffness() const { return hinge_stiffness_; }
  bool are_hinges_damped() const { return are_hinges_damped_; }
  const glm::dmat3& hinge_damping(Index entry) const { return hinge_damping_[entry]; }
  double mean_damping() const { return mean_damping_; }

 private:
  static void add(glm::dmat3& block, const Vec3& u, double axial, double transverse) {
    axial = axial > 0.0 ? axial : 0.0;
    transverse = transverse > 0.0 ? transverse : 0.0;
    block += (axial - transverse) * glm::outerProduct(u, u) + glm::dmat3(transverse);
  }

  std::vector<glm::dmat3> stiffness_, damping_, hinge_damping_;
  double mean_stiffness_ = 0.0, mean_damping_ = 0.0, hinge_stiffness_ = 0.0;
  bool are_hinges_damped_ = false;
};

}  // namespace hooke
