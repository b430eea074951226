#include "sim/contact/touch_simulation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/contact/constants.h"

namespace hooke {
namespace {

// A touch may be at rest if its gap is below this multiple of the distance that the velocity change in the substep covers: that which it
// covers at the largest speed of approach.
constexpr double rest_reach = contact::rest_speed + 1.0;

}  // namespace

const Collider& TouchSimulation::shape_of(const Touch& touch) const {
  if (touch.obstacle != nullptr) return *touch.obstacle->collider;
  std::get<Sphere>(ball_.shape).radius = touch.distance;
  return ball_;
}

// Of the first, as seen from the second.
Parabola TouchSimulation::relative_path(const Touch& touch, double t) const {
  const PointPath &first = paths[touch.first], &second = paths[touch.second];
  return {first.position(t) - second.position(t), first.velocity(t) - second.velocity(t), first.a - second.a};
}

Vec3 TouchSimulation::relative_surface_velocity(const Touch& touch, const Vec3& normal, const Vec3& relative_position) const {
  return touch.obstacle != nullptr ? hooke::relative_surface_velocity(*touch.obstacle, normal, relative_position) : Vec3(0.0);
}

// A bound on what the accelerations change of the relative velocity during the substep [m/s].
double TouchSimulation::velocity_change(const Touch& touch) const {
  return paths[touch.first].velocity_change + paths[touch.second].velocity_change;
}

// Speeds of approach below this count as zero [m/s].
double TouchSimulation::quiet_speed(const Touch& touch) const {
  // the velocity of an obstacle that moves is known up to the rounding of the time
  constexpr double rounding = 1e-12, rounding_of_time = 1e-9;
  const double first = glm::length(paths[touch.first].v), second = glm::length(paths[touch.second].v);
  if (is_alone()) return rounding * (velocity_change(touch) + first) + rounding_of_time * (second + paths[touch.second].velocity_change);
  return contact::quiet_part * velocity_change(touch) + rounding * (first + second);
}

// The speed of approach below which there is no restitution [m/s]: all bounces from the rebound e v on take 2 e v / (a (1 - e)).
double TouchSimulation::rest_speed(const Touch& touch, const Gap& gap, const Parabola& path) const {
  const double e = touch.restitution;
  if (e == 0.0 || impacts_ > max_impacts()) return never;
  double change = velocity_change(touch);
  if (is_alone()) {
    const Vec3 along = tangential(gap.normal, path.v), a = paths[touch.first].free_acceleration - paths[touch.second].a;
    change = (h_ - time_) * std::max(0.0, -glm::dot(gap.normal, a) - gap.curvature * glm::dot(gap.curved * along, along));
  }
  return std::max(quiet_speed(touch), 0.5 * change * (1.0 - e) / e);
}

// The speed of approach at which there is no impact [m/s]. What is near at the start of the substep, and is pushed by an impact during it,
// waits for the next substep, which solves for all of it together.
double TouchSimulation::ignored_speed(const Touch& touch) const {
  return std::max(quiet_speed(touch), touch.waits ? velocity_change(touch) : 0.0);
}

void TouchSimulation::add_point(const Plan& plan, Index i, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double h) {
  PointPath& path = paths.emplace_back(PointPath{.point = i, .inverse_mass = plan.inverse_mass_in_contact()[i], .x = x0, .v = v0});
  if (path.inverse_mass == 0.0) return;
  const Vec3 change = v1 - v0;
  path.a = path.free_acceleration = change / h;
  path.velocity_correction = path.free_correction = without_rounding((x1 - x0) / h - v0 - 0.5 * change, x0, h);
  path.v += path.velocity_correction;
  path.velocity_change = glm::length(change);
  path.drag = plan.drag;
  path.adhesion = plan.force_data.sticky.strength * path.inverse_mass;
  path.start_x = x0;
  path.start_v = path.v;
}

void TouchSimulation::add_obstacles(std::span<const Obstacle> obstacles, double h) {
  first_obstacle_ = paths.size();
  Index number = -1;
  for (const Obstacle& obstacle : obstacles)
    paths.push_back({.point = --number,
                     .x = obstacle.offset,
                     .v = obstacle.velocity + obstacle.velocity_correction,
                     .a = obstacle.acceleration,
                     .velocity_correction = obstacle.velocity_correction,
                     .velocity_change = h * glm::length(obstacle.acceleration)});
}

void TouchSimulation::add_pair(std::size_t first, std::size_t second, double distance, double restitution, double friction) {
  const double response = paths[first].inverse_mass + paths[second].inverse_mass;
  touches.push_back({.first = first,
                     .second = second,
                     .distance = distance,
                     .restitution = restitution,
                     .law = {.mass = response > 0.0 ? 1.0 / response : 0.0, .friction = friction}});
}

void TouchSimulation::add_touch(std::size_t path, const Obstacle& obstacle, std::size_t number, double radius) {
  add_pair(path, first_obstacle_ + number, radius, obstacle.collider->restitution, obstacle.collider->friction);
  touches.back().obstacle = &obstacle;
}

void TouchSimulation::begin(const SurfacePlan& plan, double h) {
  soft_ = soft_constraint(plan, h);
  start_ = 0.0;
  first_touch_ = first_impact_ = never;
  counts_ = {};
  impacts_ = 0;
  start(h);
}

void TouchSimulation::start(double h) {
  h_ = h;
  time_ = 0.0;
  clear_changed();
  loads_.now.clear();
  separation_.clear();
  find_resting();
  if (!active_.empty()) rest();
  if (is_alone()) leave_balls();
  for (Touch& touch : touches) predict(touch);
  queue_impacts();
}

void TouchSimulation::queue_impacts() {
  queue_.clear();
  of_paths_.first.clear();
  for (std::size_t t = 0; t < touches.size(); ++t)
    if (touches[t].time <= h_) queue_.push_back({touches[t].time, t});
  std::ranges::make_heap(queue_, std::greater());
}

// What touches, or could within the substep, and does not approach so fast that it bounces.
void TouchSimulation::find_resting() {
  active_.clear();
  counts_.tests += static_cast<long>(touches.size());
  for (std::size_t t = 0; t < touches.size(); ++t) {
    Touch& touch = touches[t];
    Parabola path = relative_path(touch, 0.0);
    path.v -= paths[touch.first].velocity_correction - paths[touch.second].velocity_correction;
    const Gap gap = gap_to(shape_of(touch), touch.inflation(), path.x);
    const double change = velocity_change(touch);
    touch.is_near = gap.distance <= contact_tolerance(path.x) + (is_alone() ? 0.0 : rest_reach * h_ * change);
    if (!touch.is_near) continue;
    const double velocity = glm::dot(gap.normal, path.v), quiet = quiet_speed(touch);
    if (is_alone() ? std::abs(velocity) > quiet : velocity < -std::max(quiet, contact::rest_speed * change)) continue;
    touch.law.normal = gap.normal;
    touch.gap = is_alone() ? 0.0 : gap.distance;
    touch.curvature = gap.curvature;
    touch.curved = gap.curved;
    touch.is_at_rest = true;
    active_.push_back(t);
  }
}

// Solves for velocity_, of the motion at a time, or of the corrections if there is none. What then rests on an obstacle does so without
// rounding.
void TouchSimulation::solve_velocities(std::optional<double> time, double tolerance) {
  for (const std::size_t k : active_) {
    Touch& touch = touches[k];
    const PointPath &first = paths[touch.first], &second = paths[touch.second];
    touch.surface =
        time ? relative_surface_velocity(touch, touch.law.normal, first.x - second.x + *time * (first.v - second.v)) : Vec3(0.0);
  }
  solve_impulses(active_, tolerance, velocity_);
  constexpr double rounding = 1e-12;
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    if (touch.obstacle == nullptr) continue;
    const Vec3 rest = velocity_[touch.second] + touch.surface, slip = velocity_[touch.first] - rest;
    if (slip == Vec3(0.0) || glm::length(slip) > rounding * (velocity_change(touch) + glm::length(rest))) continue;
    velocity_[touch.first] = rest;
    change(touch.first);
  }
  change_pushed();
}

// Displacements without a velocity, as far as what touches does not exert the force of the spring already.
void TouchSimulation::separate(double tolerance) {
  separation_.clear();
  separation_.reserve(paths.size());
  bool any = false;
  for (const std::size_t k : active_) {
    Touch& touch = touches[k];
    const double depth = touch.obstacle != nullptr ? 0.0 : std::max(0.0, -touch.gap);
    const double weight = paths[touch.first].inverse_mass + paths[touch.second].inverse_mass;
    const double spare = h_ * soft_.stiffness * depth - weight * touch.law.impulse.normal;
    touch.law.target = h_ * std::max(0.0, std::min(soft_.rate * depth, spare));
    touch.law.impulse = {};
    touch.surface = Vec3(0.0);
    any = any || touch.law.target > h_ * tolerance;
  }
  if (!any) return;
  separation_.assign(paths.size(), Vec3(0.0));
  solve_impulses(active_, h_ * tolerance, separation_);
  change_pushed();
}

// Starts from the forces of the last substep, which are nearly the same.
void TouchSimulation::recall_loads() {
  for (const std::size_t k : active_) {
    Touch& touch = touches[k];
    const std::array points = points_of(touch);
    const auto load = std::ranges::lower_bound(loads_.last, points, {}, &TouchLoads::Load::points);
    if (load == loads_.last.end() || load->points != points) continue;
    touch.law.impulse = load->impulse.scaled(h_ / loads_.last_h, touch.law.normal);
  }
}

// Marks the paths of touches with an impulse as changed.
void TouchSimulation::change_pushed() {
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    if (touch.law.impulse.normal == 0.0) continue;
    change(touch.first);
    change(touch.second);
  }
}

// First velocities change at once, so that nothing is closed before the end of the substep. Then forces act during it, so that nothing
// overlaps at its end. The correction of the method's path must not lead into what touches either: it comes from forces that are balanced.
void TouchSimulation::rest() {
  const std::size_t n = paths.size();
  velocity_.resize(n);
  const auto reset = [&](std::size_t k, double min_velocity) {
    touches[k].law.target = min_velocity;
    touches[k].law.impulse = {};
  };
  double scale = 0.0;
  for (const std::size_t k : active_) scale = std::max({scale, velocity_change(touches[k]), quiet_speed(touches[k])});
  // what remains of velocities is removed by the forces, and what remains of those moves the points; a point alone is solved exactly
  const double rough = (is_alone() ? 1e-14 : contact::quiet_part) * scale, fine = (is_alone() ? 1e-14 : 1e-2 * contact::quiet_part) * scale;

  for (std::size_t p = 0; p < n; ++p) velocity_[p] = paths[p].v - paths[p].velocity_correction;
  for (const std::size_t k : active_) reset(k, -std::max(0.0, touches[k].gap) / h_);
  solve_velocities(0.0, rough);
  for (const std::size_t p : changed_) paths[p].v = velocity_[p] + paths[p].velocity_correction;

  for (std::size_t p = 0; p < n; ++p) velocity_[p] = paths[p].velocity_correction;
  for (const std::size_t k : active_) reset(k, 0.0);
  if (is_alone()) leave_corrections();
  solve_velocities(std::nullopt, rough);
  for (const std::size_t p : changed_) {
    const Vec3 change = velocity_[p] - paths[p].velocity_correction;
    paths[p].v += change;
    paths[p].start_v += change;
    paths[p].velocity_correction = velocity_[p];
  }

  // gap + h (v + v') / 2 >= 0 along the normal in the middle of the path, across which a slide on a ball leads: the force does no work
  for (const std::size_t k : active_) {
    Touch& touch = touches[k];
    const Vec3 v =
        paths[touch.first].v - paths[touch.first].velocity_correction - paths[touch.second].v + paths[touch.second].velocity_correction;
    const Vec3 along = touch.curved * tangential(touch.law.normal, v + 0.5 * h_ * relative_path(touch, 0.0).a);
    touch.law.normal = glm::normalize(touch.law.normal + 0.5 * h_ * touch.curvature * along);
    reset(k, std::min(0.0, -2.0 * std::max(0.0, touch.gap) / h_ - glm::dot(touch.law.normal, v)));
  }
  recall_loads();
  for (std::size_t p = 0; p < n; ++p) velocity_[p] = paths[p].v - paths[p].velocity_correction + h_ * paths[p].a;
  solve_velocities(h_, fine);
  for (const std::size_t p : changed_) paths[p].a = (velocity_[p] - (paths[p].v - paths[p].velocity_correction)) / h_;
  for (const std::size_t k : active_) {
    const Touch& touch = touches[k];
    if (touch.law.impulse.normal > 0.0) loads_.now.push_back({points_of(touch), touch.law.impulse});
  }
  if (!is_alone()) separate(rough);
}

void TouchSimulation::change(std::size_t path) {
  first_touch_ = std::min(first_touch_, start_ + time_);
  if (paths[path].inverse_mass == 0.0 || paths[path].is_listed) return;
  paths[path].is_changed = paths[path].is_listed = true;
  changed_.push_back(path);
}

void TouchSimulation::clear_changed() {
  for (const std::size_t p : changed_) paths[p].is_listed = false;
  changed_.clear();
}

// Sets the time of its next impact.
void TouchSimulation::predict(Touch& touch) const {
  ++counts_.tests;
  touch.time = never;
  touch.waits = !is_alone() && touch.is_near && impacts_ > 0;
  if (touch.is_at_rest) return;
  const Parabola path = relative_path(touch, time_);
  const Collider& shape = shape_of(touch);
  const Gap gap = gap_to(shape, touch.inflation(), path.x);
  const double left = h_ - time_;
  if (gap.distance > left * (glm::length(path.v) + 0.5 * left * glm::length(path.a)) + contact_tolerance(path.x)) return;

  const double velocity = glm::dot(gap.normal, path.v), ignored = ignored_speed(touch);
  if (gap.distance <= contact_tolerance(path.x) && velocity <= ignored) {
    if (velocity < -ignored) touch.time = time_;
    return;
  }
  if (const auto impact = hooke::first_impact(shape, touch.inflation(), path, left)) touch.time = time_ + *impact;
}

bool TouchSimulation::advance() {
  clear_changed();
  while (!queue_.empty() && touches[queue_.front().touch].time != queue_.front().time) {
    std::ranges::pop_heap(queue_, std::greater());
    queue_.pop_back();
  }
  if (queue_.empty() || impacts_ > 2 * max_impacts()) {
    for (PointPath& path : paths) path.advance(h_);
    for (std::size_t p = 0; p < separation_.size(); ++p) paths[p].x += separation_[p];
    if (is_alone()) follow_balls();
    time_ = h_;
    // impacts that are left out, of which there are too many
    for (const auto& left_out : queue_) paths[touches[left_out.touch].first].is_changed = true;
    leave_obstacles();
    std::ranges::sort(loads_.now, {}, &TouchLoads::Load::points);
    std::swap(loads_.last, loads_.now);
    loads_.last_h = h_;
    return false;
  }
  time_ = queue_.front().time;
  ++impacts_;
  find_impacts_with(queue_.front().touch);
  respond();
  if (!is_alone()) predict_changed();
  return true;
}

// Predicts the next impacts of the touches of paths that changed.
void TouchSimulation::predict_changed() {
  if (changed_.empty()) return;
  if (of_paths_.first.empty()) list_touches_of_paths();
  for (const std::size_t p : changed_)
    for (std::size_t k = of_paths_.first[p]; k < of_paths_.first[p + 1]; ++k) {
      const std::size_t t = of_paths_.touches[k];
      Touch& touch = touches[t];
      // once, if both of its paths changed
      if (touch.second == p && paths[touch.first].is_listed) continue;
      touch.is_at_rest = false;
      predict(touch);
      if (touch.time > h_) continue;
      queue_.push_back({touch.time, t});
      std::ranges::push_heap(queue_, std::greater());
    }
}

void TouchSimulation::list_touches_of_paths() {
  std::vector<std::size_t>& first = of_paths_.first;
  first.assign(paths.size() + 1, 0);
  for (const Touch& touch : touches) ++first[touch.first], ++first[touch.second];
  std::partial_sum(first.begin(), first.end(), first.begin());
  of_paths_.touches.resize(first.back());
  // from the end of the touches of each path down to the first
  for (std::size_t t = touches.size(); t-- > 0;)
    for (const std::size_t p : {touches[t].first, touches[t].second}) of_paths_.touches[--first[p]] = t;
}

}  // namespace hooke
