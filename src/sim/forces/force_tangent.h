// Derivatives of the scene's optional forces, as the matrix of an implicit step takes them: symmetric and positive semidefinite, except for
// the curvatures of volumes and of hinges with a rest shape; other parts are left out.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "sim/plan/plan.h"

namespace hooke {

// Of the hinges, for the entries of the matrix of the Plan on and above its diagonal.
class HingeTangent {
 public:
  void reset(std::size_t entries) {
    damping_.assign(entries, glm::dmat3(0.0));
    stiffness = 0.0;
    is_damped_ = is_bent_ = false;
  }
  // -df/dx of an entry: the definite part, and the other one, which is due to the moments.
  void add_stiffness(Index entry, const glm::dmat3& block, const glm::dmat3& curvature) {
    // only sheets with a rest shape need them
    if (!is_bent_) blocks_.assign(damping_.size(), glm::dmat3(0.0)), curvature_.assign(damping_.size(), glm::dmat3(0.0));
    is_bent_ = true;
    blocks_[entry] += block;
    curvature_[entry] += curvature;
  }
  // -df/dv of an entry.
  void add_damping(Index entry, const glm::dmat3& block) {
    damping_[entry] += block;
    is_damped_ = true;
  }
  bool is_damped() const { return is_damped_; }
  bool has_blocks() const { return is_damped_ || is_bent_; }
  const glm::dmat3& damping(Index entry) const { return damping_[entry]; }
  // b D + b^2 K of an entry, without `stiffness`.
  glm::dmat3 block(Index entry, double b, bool with_curvature) const {
    glm::dmat3 block = b * damping_[entry];
    if (is_bent_) block += b * b * blocks_[entry];
    if (is_bent_ && with_curvature) block += b * b * curvature_[entry];
    return block;
  }

  double stiffness = 0.0;  // [N m], times the matrix of the Plan, for each component

 private:
  std::vector<glm::dmat3> damping_, blocks_, curvature_;
  bool is_damped_ = false, is_bent_ = false;
};

class ForceTangent {
 public:
  // Zero, for the points, hinges and enclosures of the plan.
  void reset(const Plan& plan) {
    stiffness_.assign(plan.points, glm::dmat3(0.0));
    damping_.assign(plan.points, glm::dmat3(0.0));
    hinges.reset(plan.force_data.hinges.column.size());
    volumes_.resize(plan.force_data.enclosures.enclosures.size());
    for (Volume& volume : volumes_) {
      volume.stiffness = 0.0;
      volume.gradient.assign(static_cast<std::size_t>(plan.points) * plan.dimensions, 0.0);
    }
    volume_curvature_.assign(plan.force_data.enclosures.edges.size(), Vec3(0.0));
    mean_stiffness_ = mean_damping_ = 0.0;
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
  // Of the volume V of an enclosure: `stiffness` [N/m^5] times dV/dx dV/dx^T.
  void add_volume(const Plan& plan, std::size_t enclosure, double stiffness, const double* x);
  // -pressure d2V/dx2, V the signed volume.
  void add_volume_curvature(const Plan& plan, const Enclosure& enclosure, double pressure, const double* x);

  struct Volume {
    double stiffness = 0.0;  // [N/m^5]
    Field gradient;          // [m^2], meaningful if there is a stiffness
  };

  // b D + b^2 K of a point, and of the mean the factor of m_i m_j.
  glm::dmat3 block(Index point, double b) const { return b * damping_[point] + b * b * stiffness_[point]; }
  double mean(double b) const { return b * mean_damping_ + b * b * mean_stiffness_; }
  const glm::dmat3& damping(Index point) const { return damping_[point]; }
  double mean_damping() const { return mean_damping_; }
  const Volume& volume(std::size_t enclosure) const { return volumes_[enclosure]; }
  // w of an edge of the enclosures, whose block, with the rows of its first point, is K r = w x r [N/m].
  const Vec3& volume_curvature(std::size_t edge) const { return volume_curvature_[edge]; }

  HingeTangent hinges;

 private:
  static void add(glm::dmat3& block, const Vec3& u, double axial, double transverse) {
    axial = axial > 0.0 ? axial : 0.0;
    transverse = transverse > 0.0 ? transverse : 0.0;
    block += (axial - transverse) * glm::outerProduct(u, u) + glm::dmat3(transverse);
  }

  std::vector<glm::dmat3> stiffness_, damping_;
  std::vector<Volume> volumes_;
  std::vector<Vec3> volume_curvature_;
  double mean_stiffness_ = 0.0, mean_damping_ = 0.0;
};

}  // namespace hooke
