// The part of TouchSimulation that solves what touches at the same time together.
#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"
#include "sim/contact/touch_simulation.h"

namespace hooke {
namespace {

void apply(const Touch& touch, const Vec3& impulse, std::span<const PointPath> paths, std::span<Vec3> v) {
  v[touch.first] += paths[touch.first].inverse_mass * impulse;
  v[touch.second] -= paths[touch.second].inverse_mass * impulse;
}

// Returns the change of the relative velocity [m/s].
double relax(Touch& touch, std::span<Vec3> v, std::span<const PointPath> paths) {
  if (touch.law.mass == 0.0) return 0.0;
  const Vec3 impulse = touch.law.solve(v[touch.first] - v[touch.second] - touch.surface);
  if (impulse == Vec3(0.0)) return 0.0;
  apply(touch, impulse, paths, v);
  return glm::length(impulse) / touch.law.mass;
}

}  // namespace

// Changes the velocities v, one per path, by the impulses of the touches: along the normal the minimum for which no touch is slower than
// its target, friction of up to its coefficient times that against the rest of the relative velocity. Impulses are equal and
// opposite, so that momentum is conserved, and so is angular momentum without friction. Starts from the impulses of the touches, and leaves
// the result there. Projected Gauss-Seidel, forward and backward in turn, until no relative velocity changes by more than `tolerance`
// [m/s].
void TouchSimulation::solve_impulses(std::span<const std::size_t> together, double tolerance, std::span<Vec3> v) {
  for (const std::size_t t : together) {
    const Touch& touch = touches[t];
    if (touch.law.impulse.normal > 0.0) apply(touch, touch.law.impulse.total(touch.law.normal), paths, v);
  }
  for (int sweep = 0; sweep < contact::max_sweeps; ++sweep) {
    double change = 0.0;
    counts_.impulses += static_cast<long>(together.size());
    for (std::size_t k = 0; k < together.size(); ++k)
      change = std::max(change, relax(touches[together[sweep % 2 == 0 ? k : together.size() - 1 - k]], v, paths));
    if (!(change > tolerance)) break;
  }
}

// Finds the impacts that are at the same time, within rounding, as that of a touch, and are linked to it by points that are not nailed.
void TouchSimulation::find_impacts_with(std::size_t touch) {
  constexpr double near = 1e-6;  // [1], of the substep: more than rounding, before the distance is measured
  together_.assign(1, touch);
  if (of_paths_.first.empty()) list_touches_of_paths();
  for (std::size_t k = 0; k < together_.size(); ++k) {
    Touch& next = touches[together_[k]];
    const Parabola path = relative_path(next, time_);
    const Gap gap = gap_to(shape_of(next), next.inflation(), path.x);
    const double approach = -glm::dot(gap.normal, path.v);
    if (k == 0) next.time = never;
    if (approach <= ignored_speed(next) || (k > 0 && approach * (next.time - time_) > contact_tolerance(path.x))) {
      together_.erase(together_.begin() + static_cast<std::ptrdiff_t>(k--));
      continue;
    }
    next.law.normal = gap.normal;
    next.rebounds = approach > rest_speed(next, gap, path);
    // what does not rebound leaves so slowly that the accelerations bring it back at the end of the substep
    const double hop = is_alone() ? 0.0 : std::clamp(-0.5 * (h_ - time_) * glm::dot(gap.normal, path.a), 0.0, std::max(0.0, approach));
    next.law.target = std::max(next.rebounds ? next.restitution * approach : 0.0, hop);
    next.law.impulse = {};
    next.surface = relative_surface_velocity(next, gap.normal, path.x);
    for (const std::size_t p : {next.first, next.second}) {
      if (paths[p].inverse_mass == 0.0) continue;
      for (std::size_t l = of_paths_.first[p]; l < of_paths_.first[p + 1]; ++l) {
        const std::size_t other = of_paths_.touches[l];
        if (touches[other].time - time_ > near * h_) continue;
        if (std::ranges::find(together_, other) == together_.end()) together_.push_back(other);
      }
    }
  }
}

// Each leaves with at least its restitution, and as one whose impulse is not negative.
void TouchSimulation::respond() {
  if (together_.empty()) return;
  velocity_.resize(paths.size());
  double fastest = 0.0;
  for (const std::size_t t : together_)
    for (const std::size_t p : {touches[t].first, touches[t].second}) {
      paths[p].advance(time_);
      velocity_[p] = paths[p].v;
      fastest = std::max(fastest, glm::length(paths[p].v));
    }
  constexpr double round_off = 1e-15;
  solve_impulses(together_, round_off * fastest, velocity_);
  first_impact_ = std::min(first_impact_, start_ + time_);
  for (const std::size_t t : together_) {
    Touch& touch = touches[t];
    touch.time = never;
    if (!touch.rebounds) {
      remove_correction(touch);
      adhere(touch);
    }
    for (const std::size_t p : {touch.first, touch.second}) {
      if (touch.rebounds) paths[p].displaced += (h_ - time_) * (velocity_[p] - paths[p].v);
      if (paths[p].inverse_mass != 0.0) paths[p].rebound(velocity_[p], h_);
      change(p);
    }
  }
}

// A sticky plane balances what pulls a point off it, up to its strength, for the rest of the substep.
void TouchSimulation::adhere(const Touch& touch) {
  PointPath& path = paths[touch.first];
  if (touch.obstacle == nullptr || !std::holds_alternative<Plane>(touch.obstacle->collider->shape)) return;
  const double pull = glm::dot(touch.law.normal, path.free_acceleration - paths[touch.second].a);
  if (!(pull > 0.0 && pull <= path.adhesion)) return;
  path.held = pull * touch.law.normal;
  path.a -= path.held;
}

// Without a rebound, the corrections of the method's path must not separate them either.
void TouchSimulation::remove_correction(const Touch& touch) {
  PointPath &first = paths[touch.first], &second = paths[touch.second];
  const double weight = first.inverse_mass + second.inverse_mass;
  const Vec3 correction = -glm::dot(touch.law.normal, first.velocity_correction - second.velocity_correction) / weight * touch.law.normal;
  first.velocity_correction += first.inverse_mass * correction;
  second.velocity_correction -= second.inverse_mass * correction;
}

}  // namespace hooke
