// The part of TouchSimulation that solves impacts at the same time together.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/contact/settle.h"
#include "sim/contact/touch_simulation.h"

namespace hooke {

// Finds the impacts that are at the same time, within rounding, as that of a touch, and are linked to it by points that are not nailed.
void TouchSimulation::find_impacts_with(std::size_t touch) {
  constexpr double near = 1e-6;  // [1], of the substep: more than rounding, before the distance is measured
  together_.clear();
  together_of_.assign(1, touch);
  if (first_touch_of_path_.empty()) list_touches_of_paths();
  for (std::size_t k = 0; k < together_of_.size(); ++k) {
    Touch& next = touches[together_of_[k]];
    const Parabola path = relative_path(next, time_);
    const Gap gap = gap_to(shape_of(next), next.second != no_path ? 0.0 : next.distance, path.x);
    const double approach = -glm::dot(gap.normal, path.v);
    if (k > 0 && (approach <= ignored_speed(next) || approach * (next.time - time_) > contact_tolerance(path.x))) {
      together_of_.erase(together_of_.begin() + static_cast<std::ptrdiff_t>(k--));
      continue;
    }
    together_.push_back(next);
    together_.back().normal = gap.normal;
    if (approach <= rest_speed(next)) together_.back().restitution = 0.0;
    // as in `respond`
    const double hop = std::clamp(-0.5 * (h_ - time_) * glm::dot(gap.normal, path.a), 0.0, std::max(0.0, approach));
    together_.back().min_velocity = std::max(together_.back().restitution * approach, hop);
    together_.back().impulse = {};
    if (next.second == no_path)
      together_.back().surface =
          next.obstacle->velocity_at(time_) + next.obstacle->velocity_correction + relative_surface_velocity(next, gap.normal, path.x);
    for (const std::size_t p : {next.first, next.second}) {
      if (p == no_path || paths[p].inverse_mass == 0.0) continue;
      for (std::size_t l = first_touch_of_path_[p]; l < first_touch_of_path_[p + 1]; ++l) {
        const std::size_t other = touches_of_path_[l];
        if (touches[other].time - time_ > near * h_) continue;
        if (std::ranges::find(together_of_, other) == together_of_.end()) together_of_.push_back(other);
      }
    }
  }
}

// Each leaves with at least its restitution, and as one whose impulse is not negative.
void TouchSimulation::respond_to_all() {
  velocity_.resize(paths.size());
  double fastest = 0.0;
  for (const Touch& touch : together_)
    for (const std::size_t p : {touch.first, touch.second}) {
      if (p == no_path) continue;
      paths[p].advance(time_);
      velocity_[p] = paths[p].v;
      fastest = std::max(fastest, glm::length(paths[p].v));
    }
  all_together_.resize(together_.size());
  std::iota(all_together_.begin(), all_together_.end(), 0);
  constexpr double round_off = 1e-15;
  impulses_ += settle(together_, all_together_, paths, round_off * fastest, velocity_);
  first_impact_ = std::min(first_impact_, time_);
  for (std::size_t k = 0; k < together_.size(); ++k) {
    const Touch& touch = together_[k];
    touches[together_of_[k]].time = std::numeric_limits<double>::infinity();
    if (touch.restitution == 0.0) remove_correction(touch, touch.normal);
    for (const std::size_t p : {touch.first, touch.second}) {
      if (p == no_path) continue;
      if (paths[p].inverse_mass != 0.0) paths[p].v = velocity_[p];
      change(p);
    }
  }
}

// Without a rebound, the corrections of the method's path must not separate them either.
void TouchSimulation::remove_correction(const Touch& touch, const Vec3& normal) {
  PointPath& first = paths[touch.first];
  PointPath* second = touch.second != no_path ? &paths[touch.second] : nullptr;
  const Vec3 other = second != nullptr ? second->velocity_correction : touch.obstacle->velocity_correction;
  const double weight = first.inverse_mass + (second != nullptr ? second->inverse_mass : 0.0);
  const Vec3 correction = -glm::dot(normal, first.velocity_correction - other) / weight * normal;
  first.velocity_correction += first.inverse_mass * correction;
  if (second != nullptr) second->velocity_correction -= second->inverse_mass * correction;
}

}  // namespace hooke
