#include "sim/contact/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/finite.h"
#include "sim/contact/contact_work.h"
#include "sim/contact/one_way.h"
#include "sim/forces/bands.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/spring_limits.h"
#include "sim/forces/terms/sticking.h"
#include "sim/plan/phase_times.h"

namespace hooke {
namespace {

// [J], that moved points out of colliders: the difference of the energy with and without these displacements.
double push_work(const Plan& plan, ContactWorkspace& before, double h, const Motion& motion) {
  before.without_push = motion.x;
  for (Index i = 0; i < plan.points; ++i)
    if (before.outcome[i] == RestingPoints::Open) add_vector(plan, before.without_push, i, -before.push_out[i]);
  const double middle = before.time + 0.5 * h;  // as in PowerWork
  return potential_energy(plan, middle, motion.x) - potential_energy(plan, middle, before.without_push);
}

// [J], by how much more kinetic energy points with the velocities v have at the velocity that belongs to their position, up to a constant.
// Without it, a weight that hangs on its strain limit would seem to gain energy from it in each substep, and lose it again to the method.
double lag_energy(const Plan& plan, const ContactWorkspace& before, const Field& v) {
  if (before.velocity_lag == 0.0) return 0.0;
  double energy = 0.0;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      if (plan.inverse_mass[i] != 0.0) energy += plan.mass[i] * before.velocity_lag * (before.unlimited_v[at] - before.v[at]) * v[at];
  return energy;
}

// [J], whose change by contact is its work, where the strain limit has moved points: contact moves them back, against springs whose force
// changes on the way. Impulses act at the velocity that belongs to the position (surface_step.cpp).
double energy_of_limited(const Plan& plan, const ContactWorkspace& before, double h, const Motion& motion) {
  return mechanical_energy(plan, before.time + 0.5 * h, motion) + lag_energy(plan, before, motion.v);
}

// In a fixed order, as eight sums side by side.
double sum_of(std::span<const double> numbers) {
  std::array<double, 8> sums{};
  std::size_t i = 0;
  for (; i + sums.size() <= numbers.size(); i += sums.size())
    for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += numbers[i + lane];
  for (std::size_t lane = 0; i < numbers.size(); ++i, ++lane) sums[lane] += numbers[i];
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

// Points against the obstacles, each by itself: consecutive points may be solved on one thread, and others on another.
class PointPass {
 public:
  struct Touches {
    // [s], since the start of the substep, of the points solved; infinity: none
    double first_touch = never, first_impact = never;
    bool any = false, any_pushed = false;
  };

  PointPass(const Plan& plan, std::span<const Obstacle> obstacles, ContactWorkspace& before, Motion& motion, double h)
      : plan_(plan), obstacles_(obstacles), before_(before), motion_(motion), h_(h) {}

  static constexpr std::size_t block = RestingPoints::max;

  void solve_block(std::size_t number, TouchSimulation& simulation, Touches& touches) const {
    const std::size_t first = number * block, end = std::min<std::size_t>(plan_.points, first + block);
    RestingPoints resting{.outcome = before_.outcome.data() + first, .work = before_.work.data() + first};
    if (plan_.collider_paths.any_moves) resting.supplied = before_.supplied.data() + first;
    const char* involved = plan_.pairs.on ? before_.pairs.involved().data() : nullptr;
    solve_resting_points(plan_, obstacles_, h_, before_.friction_lag, involved, first, end, before_.x, before_.v, motion_.x, motion_.v,
                         resting);
    if (resting.any_solved) touches.first_touch = 0.0, touches.any = true;
    for (std::size_t i = first; resting.any_open && i < end; ++i)
      if (before_.outcome[i] == RestingPoints::Open) solve_point(static_cast<Index>(i), simulation, touches);
  }

 private:
  void solve_point(Index i, TouchSimulation& simulation, Touches& touches) const {
    const Vec3 x0 = vector_at(plan_, before_.x, i), v1 = vector_at(plan_, motion_.v, i);
    if (!is_finite(x0) || !is_finite(v1)) return;  // the run has diverged
    const double radius = plan_.radius[i];
    simulation.clear();
    simulation.begin_frame();
    simulation.add_point(plan_, i, x0, vector_at(plan_, before_.v, i), vector_at(plan_, motion_.x, i), v1, h_);
    simulation.add_obstacles(obstacles_, h_);
    for (std::size_t o = 0; o < obstacles_.size(); ++o) simulation.add_touch(0, obstacles_, o, radius);
    simulation.leave_obstacles();
    PointPath& path = simulation.paths.front();
    path.start_x = path.x;
    const Vec3 pushed = before_.push_out[i] = path.x - x0;
    simulation.run_alone(plan_.surface, h_);
    if (!path.is_changed && pushed == Vec3(0.0)) return;

    touches.any = true;
    touches.any_pushed = touches.any_pushed || pushed != Vec3(0.0);
    touches.first_touch = std::min(touches.first_touch, pushed != Vec3(0.0) ? 0.0 : simulation.first_touch());
    touches.first_impact = std::min(touches.first_impact, simulation.first_impact());
    before_.work[i] = path.contact_work();
    const Vec3 v = path.v - path.velocity_correction;
    if (plan_.collider_paths.any_moves) {
      double speed = 0.0;
      for (const Obstacle& obstacle : obstacles_) speed = std::max(speed, max_surface_speed(obstacle, x0, h_));
      before_.supplied[i] = speed * plan_.mass[i] * (glm::length(v - v1) + h_ * glm::length(path.free_acceleration));
    }
    set_vector(plan_, motion_.x, i, path.x);
    set_vector(plan_, motion_.v, i, v);
  }

  const Plan& plan_;
  std::span<const Obstacle> obstacles_;
  ContactWorkspace& before_;
  Motion& motion_;
  double h_;
};

// Points that sticky planes accelerate at the start of the substep. Methods whose velocities lag lead them behind planes that move, by half
// of what these are accelerated within it, where contact would count as an impact what is none.
void follow_planes(const Plan& plan, const ContactWorkspace& before, double h, Motion& motion) {
  for (const StickyContact& contact : plan.force_data.sticky.held) {
    const Index i = contact.point;
    const auto k = static_cast<std::size_t>(contact.collider);
    const auto& plane = std::get<Plane>(plan.colliders[k].shape);
    const double acceleration = glm::dot(plane.normal, plan.colliders[k].path.acceleration(before.time));
    const double own = glm::dot(plane.normal, vector_at(plan, motion.a, i));
    if (std::abs(own - acceleration) > 1e-9 * std::abs(acceleration)) continue;
    const double end = before.time + h, height = glm::dot(plane.normal, plane.point + plan.offset_of(k, end)) + plan.radius[i];
    const double distance = height - glm::dot(plane.normal, vector_at(plan, motion.x, i));
    const double speed = glm::dot(plane.normal, plan.velocity_of(k, end) - vector_at(plan, motion.v, i));
    add_vector(plan, motion.x, i, distance * plane.normal);
    add_vector(plan, motion.v, i, speed * plane.normal);
  }
}

// Adds the work of the contact, in addition to the work of the forces. Returns whether anything touched.
bool resolve_points(const Plan& plan, std::span<const Obstacle> obstacles, ContactWorkspace& before, Motion& motion, double h) {
  if (obstacles.empty()) return false;
  const auto n = static_cast<std::size_t>(plan.points);
  before.outcome.resize(n);
  before.work.resize(n);
  before.push_out.resize(n);
  if (plan.collider_paths.any_moves) before.supplied.assign(n, 0.0);
  const PointPass pass(plan, obstacles, before, motion, h);
  const double energy = before.is_limited ? energy_of_limited(plan, before, h, motion) : 0.0;

  // blocks of points on as many threads as there are
  constexpr Index min_blocks = 2;  // some microseconds
  const auto blocks = static_cast<Index>((n + PointPass::block - 1) / PointPass::block);
  std::array<PointPass::Touches, max_parts> touches;
  before.alone.resize(max_parts);
  if (before.alone.back().paths.capacity() <= obstacles.size())
    for (TouchSimulation& each : before.alone) each.reserve_alone(obstacles.size());
  const int parts = for_parts(plan, blocks, min_blocks, [&](int part, Index first, Index end) {
    for (Index number = first; number < end; ++number)
      pass.solve_block(static_cast<std::size_t>(number), before.alone[part], touches[part]);
  });
  PointPass::Touches all;
  for (const PointPass::Touches& each : std::span(touches).first(static_cast<std::size_t>(parts))) {
    all.any = all.any || each.any;
    all.any_pushed = all.any_pushed || each.any_pushed;
    before.first_touch = std::min(before.first_touch, each.first_touch);
    before.first_impact = std::min(before.first_impact, each.first_impact);
  }
  if (!all.any) return false;

  const double pushed = all.any_pushed ? push_work(plan, before, h, motion) : 0.0;
  motion.energy.add(EnergyCause::Colliders, pushed);
  const double work = before.is_limited ? energy_of_limited(plan, before, h, motion) - pushed - energy : sum_of(before.work);
  book_contact_work(work, {.by_colliders = plan.collider_paths.any_moves ? sum_of(before.supplied) : 0.0}, motion);
  return true;
}

bool resolve_all(const Plan& plan, ContactWorkspace& before, Motion& motion, double h) {
  const std::span<const Obstacle> obstacles = find_obstacles(plan, before.time, h, before.obstacles);
  before.first_touch = before.first_impact = never;
  if (before.velocity_lag != 0.0 && plan.collider_paths.any_moves) follow_planes(plan, before, h, motion);
  keep_on_planes(plan, before.time + h, motion);
  if (plan.surface.on) before.surface.begin_substep(plan, before.velocity_lag, before.is_limited ? &before.unlimited_v : nullptr, motion);
  const double energy = plan.pairs.on && before.is_limited ? energy_of_limited(plan, before, h, motion) : 0.0;
  bool touched = plan.pairs.on && before.pairs.resolve(plan, obstacles, before.x, before.v, h, motion);
  if (touched) {
    const double work = before.is_limited ? energy_of_limited(plan, before, h, motion) - energy : before.pairs.work();
    book_contact_work(work, before.pairs.supplied(), motion);
    before.first_touch = before.pairs.first_touch();
    before.first_impact = before.pairs.first_impact();
  }
  touched = resolve_points(plan, obstacles, before, motion, h) || touched;
  touched = rebound_from_walls(plan, before, h, motion) || touched;
  if (touched && !before.is_limited && before.works != nullptr) before.works->end_point_contact(plan, h, motion);
  const std::span<const PointPair> near = plan.pairs.on ? before.pairs.near() : std::span<const PointPair>();
  if (plan.surface.on && before.surface.resolve(plan, obstacles, near, before.x, before.v, h, motion)) {
    touched = true;
    before.first_touch = 0.0;
  }
  return touched;
}

}  // namespace

bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h) {
  const InPhase in(plan.execution.phases, Phase::Contact);
  before.free_v = motion.v;
  if (!resolve_all(plan, before, motion, h)) return false;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      motion.contact[at] += plan.mass[i] * (motion.v[at] - before.free_v[at]);
  return true;
}

bool limit_strain(const Plan& plan, ContactWorkspace& before, Motion& motion) {
  before.is_limited = false;
  if (plan.spring.max_length.empty()) return false;
  if (before.velocity_lag != 0.0 || plan.has_contact()) before.unlimited_v = motion.v;
  before.is_limited = limit_strain(plan, motion);
  if (before.is_limited)
    motion.energy.add(EnergyCause::StrainLimit, lag_energy(plan, before, motion.v) - lag_energy(plan, before, before.unlimited_v));
  return before.is_limited;
}

}  // namespace hooke
