#include "sim/contact/surface/surface_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/pair_solver.h"

namespace hooke {
namespace {

constexpr double round_off = 1e-12;  // [m]
// The part of what features are closer than their thickness by which they separate in a substep, and the time for most of it [s].
constexpr double max_separation = 0.2, separation_time = 0.02;
// At the end of a substep, the velocities of what is at rest have to vanish.
constexpr int velocity_turns = 4;

Vec3 point_in(const Plan& plan, const Field& field, Index i) {
  const auto n = static_cast<std::size_t>(plan.points);
  return {field[i], field[n + i], plan.dimensions == 3 ? field[2 * n + i] : 0.0};
}

Vec3 mean_of(std::span<const Vec3> field) {
  Vec3 sum(0.0);
  for (const Vec3& v : field) sum += v;
  return sum / static_cast<double>(field.size());
}

// The longest difference of two fields, apart from a common translation.
double max_difference(std::span<const Vec3> a, std::span<const Vec3> b) {
  const Vec3 mean = mean_of(a) - mean_of(b);
  double max = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec3 d = a[i] - b[i] - mean;
    max = std::max(max, glm::dot(d, d));
  }
  return std::sqrt(max);
}

}  // namespace

void SurfaceSolver::begin_substep(const Plan& plan, const Motion& motion) {
  free_velocity_.resize(plan.surface.points.size());
  for (std::size_t k = 0; k < free_velocity_.size(); ++k) free_velocity_[k] = point_in(plan, motion.v, plan.surface.points[k]);
}

bool SurfaceSolver::resolve(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                            Motion& motion) {
  tests_ = impulses_ = 0;
  const bool touches = correct(plan, obstacles, x0, v0, h, motion);
  motion.contact_tests += tests_;
  motion.contact_impulses += impulses_;
  return touches;
}

bool SurfaceSolver::correct(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                            Motion& motion) {
  has_failed_ = false;
  // a motion that is not finite has diverged
  if (!load(plan, x0, h, motion)) return false;
  if (!tree_.is_built()) start_frame(plan);
  elapsed_ += h;

  const double approach = 2.0 * h * max_speed(u_), reach = plan.surface.max_thickness + approach;
  if (!find_near(plan, reach, approach, h)) return false;
  if (near_.empty()) return false;
  make_contacts(plan, reach, h);
  add_obstacles(plan, obstacles, approach, h, motion);
  free_u_ = u_;
  const auto contacts = static_cast<long>(contacts_.surface.size());
  impulses_ += 2 * contacts;
  const bool touches = contacts_.settle(inverse_mass_, plan.surface.friction, u_);
  note_pressed(plan, h);
  const bool is_separated = separate(h);
  separated_ = path_;
  const bool hits = prevent_crossings(plan, h);
  if (has_failed_ || !(touches || is_separated || hits)) return false;
  write(plan, v0, h, motion);
  return true;
}

// Returns whether all are finite.
bool SurfaceSolver::load(const Plan& plan, const Field& x0, double h, const Motion& motion) {
  const std::size_t n = plan.surface.points.size();
  for (auto* field : {&x_, &end_, &u_}) field->resize(n);
  Vec3 sum(0.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Index i = plan.surface.points[k];
    x_[k] = point_in(plan, x0, i);
    end_[k] = point_in(plan, motion.x, i);
    u_[k] = (end_[k] - x_[k]) / h;
    sum += u_[k];
  }
  return std::isfinite(sum.x + sum.y + sum.z);
}

void SurfaceSolver::start_frame(const Plan& plan) {
  const std::size_t n = plan.surface.points.size();
  inverse_mass_.resize(n);
  for (std::size_t k = 0; k < n; ++k) inverse_mass_[k] = plan.inverse_mass[plan.surface.points[k]];
  tree_.build(plan.surface, x_);
  is_pierced_.assign(n, 0);
  for (const Crossing& crossing : tree_.find_crossings(plan.surface, x_).found) {
    for (const Index i : plan.surface.edges[crossing.edge]) is_pierced_[i] = 1;
    for (const Index i : plan.surface.pieces[crossing.face].points) is_pierced_[i] = 1;
  }
  pairs_.clear();
  found_reach_ = elapsed_ = 0.0;
  last_ = x_;
  travel_ = 0.0;
  searches_ = impacts_ = 0;
}

// Relative to the mean.
double SurfaceSolver::max_speed(std::span<const Vec3> velocity) const {
  const Vec3 mean = mean_of(velocity);
  double max = 0.0;
  for (const Vec3& v : velocity) max = std::max(max, glm::dot(v - mean, v - mean));
  return std::sqrt(max);
}

// Whether pairs_ contains all that are closer than `reach` [m] at the start of the substep.
bool SurfaceSolver::is_covered(double reach) const {
  if (found_reach_ == 0.0 || elapsed_ > horizon_) return false;
  const Vec3 mean = mean_of(x_) - mean_of(found_at_) - elapsed_ * mean_of(drift_);
  double max = 0.0;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Vec3 deviation = x_[k] - found_at_[k] - elapsed_ * drift_[k] - mean;
    max = std::max(max, glm::dot(deviation, deviation));
  }
  return reach + 2.0 * std::sqrt(max) + round_off <= found_reach_;
}

// False: there are too many.
bool SurfaceSolver::find_pairs(const Plan& plan, double reach, double approach, double h) {
  ++searches_;
  const double edge = plan.surface.edge_length, margin = std::max({relative_margin_ * edge, 2.0 * approach, 0.1 * reach});
  found_reach_ = std::max(reach, plan.surface.max_thickness) + margin;
  found_at_ = x_;
  drift_ = u_;
  travel_ = elapsed_ = 0.0;

  // points move on as long as they leave neither their surroundings nor their neighbors
  double stretching = 0.0;
  for (const auto& [i, j] : plan.surface.edges) stretching += glm::dot(u_[i] - u_[j], u_[i] - u_[j]);
  stretching = std::sqrt(stretching / static_cast<double>(std::max<std::size_t>(1, plan.surface.edges.size())));
  horizon_ = 32.0 * h;
  if (edge * h < horizon_ * approach) horizon_ = edge * h / approach;
  if (0.5 * margin < horizon_ * stretching) horizon_ = 0.5 * margin / stretching;
  const Vec3 mean = mean_of(u_);
  displacement_.resize(x_.size());
  for (std::size_t k = 0; k < x_.size(); ++k) displacement_[k] = horizon_ * (u_[k] - mean);

  tree_.refit(plan.surface, x_, displacement_);
  pairs_.clear();
  has_failed_ = !tree_.find_pairs(plan.surface, x_, found_reach_, is_pierced_, pairs_, PairSolver::max_pairs);
  tests_ += tree_.examined();
  if (has_failed_) found_reach_ = 0.0;
  keys_.clear();
  for (const SurfacePair& pair : pairs_) keys_.push_back(pair.key);
  return !has_failed_;
}

// Fills near_ with all pairs closer than `reach` [m] at the start, if points approach by up to `approach` in a substep of h. False: there
// are too many.
bool SurfaceSolver::find_near(const Plan& plan, double reach, double approach, double h) {
  if (last_ != x_) {
    travel_ += 2.0 * max_difference(x_, last_) + round_off;
    last_ = x_;
  }
  if (!is_covered(reach) && !find_pairs(plan, reach, approach, h)) return false;

  // without branches, which would be mispredicted
  woken_.resize(pairs_.size() + 1);
  const double limit = reach + travel_ + round_off;
  std::size_t count = 0;
  for (std::size_t p = 0; p < keys_.size(); ++p) {
    woken_[count] = static_cast<Index>(p);
    count += keys_[p] < limit ? 1 : 0;
  }
  woken_.resize(count);
  tests_ += static_cast<long>(count);
  if (evaluated_.size() < count) evaluated_.resize(count);
  for (std::size_t w = 0; w < count; ++w) {
    const SurfacePair& pair = pairs_[woken_[w]];
    const auto kind = static_cast<std::size_t>(pair.kind);
    FeatureBlock& block = block_[kind];
    place_[kind][block.count] = static_cast<Index>(w);
    block.points[block.count++] = pair.points;
    if (block.count == FeatureBlock::capacity) evaluate(pair.kind, reach);
  }
  for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges}) evaluate(kind, reach);

  near_.resize(count + 1);
  near_reach_ = reach;
  std::size_t near_count = 0;
  for (std::size_t w = 0; w < count; ++w) {
    const double distance = evaluated_[w].distance;
    near_[near_count] = {woken_[w], static_cast<Index>(w), distance};
    near_count += distance < reach && distance >= coincident ? 1 : 0;
  }
  near_.resize(near_count);
  return true;
}

void SurfaceSolver::evaluate(FeaturePair kind, double reach) {
  FeatureBlock& block = block_[static_cast<std::size_t>(kind)];
  find_closest(kind, x_, block);
  for (int i = 0; i < block.count; ++i) {
    const Index place = place_[static_cast<std::size_t>(kind)][i];
    keys_[woken_[place]] = block.distance[i] + travel_;
    if (block.distance[i] < reach)
      evaluated_[place] = block.closest(i);
    else
      evaluated_[place].distance = block.distance[i];
  }
  block.count = 0;
}

// Where the closest point of an edge of a face is its end, other pairs touch in the same place.
void SurfaceSolver::make_contacts(const Plan& plan, double reach, double h) {
  contacts_.surface.clear();
  contacts_.obstacles.clear();
  const SurfacePlan& surface = plan.surface;
  for (const Near& near : near_) {
    const SurfacePair& pair = pairs_[near.pair];
    const Closest& closest = evaluated_[near.evaluated];
    const auto& [i, j, k, l] = pair.points;
    if (closest.is_at_end && !pair.has_spring) continue;
    const double thickness = std::min({surface.thickness[i], surface.thickness[j], surface.thickness[k], surface.thickness[l]});
    const double gap = near.distance - thickness;
    if (gap >= reach - surface.max_thickness) continue;
    SurfaceContact contact{.points = pair.points, .weight = closest.weight, .gap = gap};
    for (int c = 0; c < 4; ++c) contact.response += contact.weight[c] * contact.weight[c] * inverse_mass_[contact.points[c]];
    if (contact.response == 0.0) continue;
    contact.normal = closest.separation / near.distance;
    contact.target = std::min(0.0, -gap / h);
    contacts_.surface.push_back(contact);
  }
}

// The obstacles that the points of contacts may be pressed into. They are convex: outside the plane that touches one where it is nearest,
// nothing is in it.
void SurfaceSolver::add_obstacles(const Plan& plan, std::span<const Obstacle> obstacles, double reach, double h, const Motion& motion) {
  if (obstacles.empty()) return;
  is_marked_.assign(plan.surface.points.size(), 0);
  for (const SurfaceContact& contact : contacts_.surface)
    for (const Index k : contact.points) is_marked_[k] = 1;
  for (std::size_t k = 0; k < is_marked_.size(); ++k) {
    if (is_marked_[k] == 0 || inverse_mass_[k] == 0.0) continue;
    const Index i = plan.surface.points[k];
    const Vec3 end = point_in(plan, motion.x, i);
    for (const Obstacle& obstacle : obstacles) {
      const Vec3 position = end - obstacle.offset_at(h);
      const Gap gap = gap_to(*obstacle.collider, plan.radius[i], position);
      if (gap.distance > reach) continue;
      const Vec3 velocity = obstacle.velocity_at(h);
      contacts_.obstacles.push_back({.point = static_cast<Index>(k),
                                     .normal = gap.normal,
                                     .target = glm::dot(gap.normal, u_[k]) - std::max(0.0, gap.distance) / h,
                                     .end_target = glm::dot(gap.normal, velocity),
                                     .friction = obstacle.collider->friction,
                                     .surface = velocity + relative_surface_velocity(obstacle, gap.normal, position)});
    }
  }
}

// What touches at the end of the substep.
void SurfaceSolver::note_pressed(const Plan& plan, double h) {
  const double tolerance = 1e-6 * plan.surface.max_thickness;
  for (SurfaceContact& contact : contacts_.surface) {
    Vec3 relative(0.0);
    for (int c = 0; c < 4; ++c) relative += contact.weight[c] * u_[contact.points[c]];
    contact.is_pressed = contact.impulse > 0.0 || contact.gap + h * glm::dot(contact.normal, relative) <= tolerance;
  }
  for (ObstacleContact& contact : contacts_.obstacles) contact.is_pressed = contact.impulse > 0.0;
}

// Displacements, without velocities, that separate what is closer than its thickness. Returns whether there are any.
bool SurfaceSolver::separate(double h) {
  path_ = u_;
  bool any = false;
  const double part = std::min(max_separation, h / separation_time);
  for (SurfaceContact& contact : contacts_.surface)
    if (contact.gap < 0.0) {
      contact.target = -part * contact.gap / h;
      any = true;
    }
  return any && contacts_.settle(inverse_mass_, 0.0, path_);
}

// Positions and velocities at the end, and the work of contact in addition to that of the forces.
void SurfaceSolver::write(const Plan& plan, const Field& v0, double h, Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  velocity_.resize(x_.size());
  for (std::size_t k = 0; k < x_.size(); ++k)
    velocity_[k] = point_in(plan, motion.v, plan.surface.points[k]) + (u_[k] - free_u_[k]) + (path_[k] - separated_[k]);
  // what was kept from approaching does not at the end either: the second half of a step of the method accelerates it again
  std::erase_if(contacts_.surface, [](const SurfaceContact& contact) { return !contact.is_pressed; });
  std::erase_if(contacts_.obstacles, [](const ObstacleContact& contact) { return !contact.is_pressed; });
  for (SurfaceContact& contact : contacts_.surface) contact.target = 0.0;
  for (ObstacleContact& contact : contacts_.obstacles) contact.target = contact.end_target;
  for (int turn = 0; turn < velocity_turns && contacts_.settle(inverse_mass_, plan.surface.friction, velocity_); ++turn)
    impulses_ += 2 * static_cast<long>(contacts_.surface.size());

  double work = 0.0;
  for (std::size_t k = 0; k < x_.size(); ++k) {
    const Index i = plan.surface.points[k];
    const Vec3 v1 = point_in(plan, motion.v, i);
    const bool is_moved = path_[k] != free_u_[k];
    if (inverse_mass_[k] == 0.0 || (!is_moved && velocity_[k] == v1)) continue;
    const Vec3 end = is_moved ? x_[k] + h * path_[k] : end_[k], force = plan.mass[i] / h * (free_velocity_[k] - point_in(plan, v0, i));
    work += 0.5 * plan.mass[i] * (glm::dot(velocity_[k], velocity_[k]) - glm::dot(v1, v1)) - glm::dot(force, end - end_[k]);
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = end[c];
      motion.v[c * n + i] = velocity_[k][c];
    }
  }
  // what pushes may supply energy: the hand, or obstacles
  (plan.held ? motion.hand_work : plan.colliders_move ? motion.collider_work : motion.contact_work) += work;
  if (plan.held) motion.abs_hand_work += std::abs(work);
}

}  // namespace hooke
