// The part of TouchSimulation about one point among obstacles, which is exact.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/constants.h"
#include "sim/contact/touch_simulation.h"

namespace hooke {

void TouchSimulation::reserve_alone(std::size_t obstacles) {
  const std::size_t path_count = obstacles + 1;
  paths.reserve(path_count);
  touches.reserve(obstacles);
  loads_.now.reserve(obstacles);
  loads_.last.reserve(obstacles);
  queue_.reserve(obstacles);
  of_paths_.first.reserve(path_count + 1);
  of_paths_.touches.reserve(2 * obstacles);
  for (auto* list : {&active_, &together_, &changed_}) list->reserve(path_count);
  velocity_.reserve(path_count);
}

void TouchSimulation::run_alone(const SurfacePlan& plan, double h) {
  begin(plan, h);
  // after each impact, the rest of the substep counts as one of its own
  while (advance()) {
    const double left = h_ - time_;
    start_ += time_;
    for (PointPath& path : paths) path.advance(time_);
    follow_balls();
    for (PointPath& path : paths) path.time = 0.0;
    paths.front().a = paths.front().free_acceleration - paths.front().held;
    for (Touch& touch : touches) touch.is_at_rest = false;
    start(left);
  }
}

// Corrections of what presses on an obstacle come from forces that are balanced, whatever their direction; so do those along the surface
// under friction.
void TouchSimulation::leave_corrections() {
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    const PointPath &path = paths[touch.first], &obstacle = paths[touch.second];
    const Vec3 v = path.v - path.velocity_correction - obstacle.v + obstacle.velocity_correction;
    if (!(glm::dot(touch.law.normal, path.a - obstacle.a) + touch.curvature * glm::dot(touch.curved * v, v) < 0.0)) continue;
    const Vec3 correction = velocity_[touch.first] - velocity_[touch.second];
    velocity_[touch.first] -= touch.law.friction > 0.0 ? correction : glm::dot(touch.law.normal, correction) * touch.law.normal;
    change(touch.first);
  }
}

// What leaves a ball ends as in a flight: otherwise the correction of the next step, along the acceleration, leads back onto it.
void TouchSimulation::leave_balls() {
  PointPath& path = paths.front();
  const auto is_loaded = [&](std::size_t k) { return touches[k].law.impulse.normal > 0.0; };
  const auto is_on_ball = [&](std::size_t k) { return touches[k].curvature > 0.0; };
  if (glm::dot(path.free_correction, path.a) > 0.0 && std::ranges::any_of(active_, is_on_ball) && std::ranges::none_of(active_, is_loaded))
    path.velocity_correction = path.free_correction;
}

// What presses on a ball moves on to its surface, and along it.
void TouchSimulation::follow_balls() {
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    if (touch.curvature == 0.0 || touch.law.impulse.normal == 0.0) continue;
    PointPath& path = paths[touch.first];
    const PointPath& ball = paths[touch.second];
    const Gap gap = gap_to(shape_of(touch), touch.inflation(), path.x - ball.x);
    const double moved = h_ * (glm::length(path.v - ball.v) + h_ * glm::length(path.a - ball.a));
    if (std::abs(gap.distance) > touch.curvature * moved * moved) continue;
    path.x -= gap.distance * gap.normal;
    path.v -= glm::dot(gap.normal, path.v - ball.v) * gap.normal;
    path.velocity_correction -= glm::dot(gap.normal, path.velocity_correction - ball.velocity_correction) * gap.normal;
  }
}

void TouchSimulation::leave_obstacles() {
  constexpr int max_rounds = 8;
  bool is_outside = false;
  for (int round = 0; round < max_rounds && !is_outside; ++round) {
    is_outside = true;
    for (const Touch& touch : touches) {
      if (touch.obstacle == nullptr) continue;
      const Vec3 position = paths[touch.first].x - paths[touch.second].x;
      const Gap gap = gap_to(shape_of(touch), touch.inflation(), position);
      if (gap.distance >= -contact_tolerance(position)) continue;
      paths[touch.first].x -= gap.distance * gap.normal;
      is_outside = false;
    }
  }
}

}  // namespace hooke
