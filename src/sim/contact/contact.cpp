#include "sim/contact/contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/finite.h"
#include "sim/forces/bands.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/forces/spring_laws.h"
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

// The impulse of a dashpot is d times the change of its length. Where rebounds have changed that, so do the impulses on both ends. The
// factor `resolved` bounds them where h is long compared with the decay time of the dashpots.
void damp_impacts(const Plan& plan, std::span<Vec3> displaced, double h, Motion& motion) {
  if (std::ranges::all_of(displaced, [](const Vec3& by) { return by == Vec3(0.0); })) return;
  if (plan.has_dashpots()) {
    const double before = kinetic_energy(plan, motion.v), resolved = 1.0 / (1.0 + h * plan.spectrum.dashpot_rate);
    for_each_spring(plan, [&](Index i, Index j, Index s) {
      const Vec3 change = displaced[i] - displaced[j];
      if (change == Vec3(0.0)) return;
      const Vec3 along = difference_at(plan, motion.x, i, j);
      const double length = glm::length(along), damping = response_of(plan, s, motion.time, length).damping;
      if (length == 0.0 || damping == 0.0) return;
      const Vec3 impulse = resolved * damping * glm::dot(along, change) / (length * length) * along;
      add_vector(plan, motion.v, i, -plan.inverse_mass_in_contact()[i] * impulse);
      add_vector(plan, motion.v, j, plan.inverse_mass_in_contact()[j] * impulse);
    });
    motion.energy.add(EnergyCause::Dashpots, kinetic_energy(plan, motion.v) - before);
  }
  std::ranges::fill(displaced, Vec3(0.0));
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

// [J], bounds on the work of the hand and of colliders by contact in a substep. What exerts an impulse J while it moves at V does work of
// at most |J| |V|, whatever the method makes of the step.
struct SuppliedWork {
  double by_hand = 0.0, by_colliders = 0.0;
};
SuppliedWork max_supplied(const Plan& plan, const ContactWorkspace& before, double h, const Motion& motion) {
  SuppliedWork max;
  const double hand_speed = plan.hand.held ? glm::length(vector_at(plan, motion.v, *plan.hand.held)) : 0.0;
  if (hand_speed == 0.0 && !plan.collider_paths.any_moves) return max;
  for (Index i = 0; i < plan.points; ++i) {
    const double impulse = plan.mass[i] * glm::length(vector_at(plan, motion.v, i) - vector_at(plan, before.free_v, i));
    if (!(impulse > 0.0)) continue;
    double speed = 0.0;
    for (const Obstacle& obstacle : before.obstacles) speed = std::max(speed, max_surface_speed(obstacle, vector_at(plan, before.x, i), h));
    max.by_hand += impulse * hand_speed;
    max.by_colliders += impulse * speed;
  }
  return max;
}

// Adds the work [J] of contact to that of the hand and of colliders, as far as they can have done it, and the rest to that of contact.
// Without the bounds, the energy that an unstable motion gains where something moves would count as supplied.
void book_work(double work, const SuppliedWork& max, Motion& motion) {
  const double by_hand = std::clamp(work, -max.by_hand, max.by_hand);
  const double by_colliders = std::clamp(work - by_hand, -max.by_colliders, max.by_colliders);
  motion.energy.add(EnergyCause::Hand, by_hand);
  motion.energy.add(EnergyCause::Colliders, by_colliders);
  motion.energy.add(EnergyCause::Contact, work - by_hand - by_colliders);
}

// What touches obstacles among the points of one thread.
struct Touches {
  double first_touch = never, first_impact = never;  // [s], since the start of the substep
  bool any = false, any_pushed = false;
};

// A point among the obstacles, by itself.
void solve_point(const Plan& plan, Index i, double h, TouchSimulation& simulation, ContactWorkspace& before, Motion& motion,
                 Touches& touches) {
  const Vec3 x0 = vector_at(plan, before.x, i), v1 = vector_at(plan, motion.v, i);
  if (!is_finite(x0) || !is_finite(v1)) return;  // the run has diverged
  simulation.clear();
  simulation.begin_frame();
  simulation.add_point(plan, i, x0, vector_at(plan, before.v, i), vector_at(plan, motion.x, i), v1, h);
  simulation.add_obstacles(before.obstacles, h);
  for (std::size_t o = 0; o < before.obstacles.size(); ++o) simulation.add_touch(0, before.obstacles[o], o, plan.radius[i]);
  simulation.leave_obstacles();
  PointPath& path = simulation.paths.front();
  path.start_x = path.x;
  const Vec3 pushed = before.push_out[i] = path.x - x0;
  simulation.run_alone(plan.surface, h);
  if (!path.is_changed && pushed == Vec3(0.0)) return;

  touches.any = true;
  touches.any_pushed = touches.any_pushed || pushed != Vec3(0.0);
  touches.first_touch = std::min(touches.first_touch, pushed != Vec3(0.0) ? 0.0 : simulation.first_touch());
  touches.first_impact = std::min(touches.first_impact, simulation.first_impact());
  before.work[i] = path.contact_work();
  before.displaced[i] = path.displaced;
  set_vector(plan, motion.x, i, path.x);
  set_vector(plan, motion.v, i, path.v - path.velocity_correction);
}

constexpr std::size_t points_per_block = RestingPoints::max;

// Points against the obstacles, each by itself: blocks of consecutive points may be solved on several threads.
void solve_block(const Plan& plan, std::size_t number, double h, TouchSimulation& simulation, ContactWorkspace& before, Motion& motion,
                 Touches& touches) {
  const std::size_t first = number * points_per_block, end = std::min<std::size_t>(plan.points, first + points_per_block);
  RestingPoints resting{.outcome = before.outcome.data() + first, .work = before.work.data() + first};
  const char* involved = plan.pairs.on ? before.pairs.involved().data() : nullptr;
  solve_resting_points(plan, before.obstacles, h, before.friction_lag, involved, first, end, before.x, before.v, motion.x, motion.v,
                       resting);
  if (resting.any_solved) touches.first_touch = 0.0, touches.any = true;
  for (std::size_t i = first; resting.any_open && i < end; ++i)
    if (before.outcome[i] == RestingPoints::Open) solve_point(plan, static_cast<Index>(i), h, simulation, before, motion, touches);
}

// All points. Adds the work of contact in addition to that of the forces, and of pushes out of obstacles. Returns whether anything touched.
bool resolve_points(const Plan& plan, ContactWorkspace& before, Motion& motion, double h, double& work, double& push) {
  if (before.obstacles.empty()) return false;
  const auto n = static_cast<std::size_t>(plan.points);
  before.outcome.resize(n);
  before.work.resize(n);
  before.push_out.resize(n);

  // blocks of points on as many threads as there are
  constexpr Index min_blocks = 2;  // some microseconds
  const auto blocks = static_cast<Index>((n + points_per_block - 1) / points_per_block);
  std::array<Touches, max_parts> touches;
  before.alone.resize(max_parts);
  if (before.alone.back().paths.capacity() <= before.obstacles.size())
    for (TouchSimulation& each : before.alone) each.reserve_alone(before.obstacles.size());
  const int parts = for_parts(plan, blocks, min_blocks, [&](int part, Index first, Index end) {
    for (Index number = first; number < end; ++number)
      solve_block(plan, static_cast<std::size_t>(number), h, before.alone[part], before, motion, touches[part]);
  });
  Touches all;
  for (const Touches& each : std::span(touches).first(static_cast<std::size_t>(parts))) {
    all.any = all.any || each.any;
    all.any_pushed = all.any_pushed || each.any_pushed;
    before.first_touch = std::min(before.first_touch, each.first_touch);
    before.first_impact = std::min(before.first_impact, each.first_impact);
  }
  if (all.any_pushed) push += push_work(plan, before, h, motion);
  if (all.any) work += sum_of(before.work);
  return all.any;
}

// Adds the work of contact in addition to that of the forces, and of pushes out of obstacles.
bool resolve_all(const Plan& plan, ContactWorkspace& before, Motion& motion, double h, double& work, double& push) {
  before.displaced.resize(static_cast<std::size_t>(plan.points));
  bool touched = plan.pairs.on && before.pairs.resolve(plan, before.obstacles, before.x, before.v, h, motion, before.displaced);
  if (touched) {
    work += before.pairs.work();
    before.first_touch = before.pairs.first_touch();
    before.first_impact = before.pairs.first_impact();
  }
  touched = resolve_points(plan, before, motion, h, work, push) || touched;
  touched = rebound_from_walls(plan, before, h, motion, work) || touched;
  if (touched && !before.is_limited && before.works != nullptr) before.works->end_point_contact(plan, h, motion);
  const std::span<const PointPair> near = plan.pairs.on ? before.pairs.near() : std::span<const PointPair>();
  const SurfaceSolver::Start start{before.x, before.v, before.is_limited ? before.unlimited_v : before.free_v, before.velocity_lag};
  if (plan.surface.on && before.surface.resolve(plan, before.obstacles, near, start, h, motion)) {
    work += before.surface.work();
    // what the hand and colliders supply is part of the energy of the state
    if (!before.is_limited) motion.energy.add(EnergyCause::Contact, before.surface.lag_work());
    touched = true;
    before.first_touch = 0.0;
  }
  return touched;
}

}  // namespace

bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h) {
  const InPhase in(plan.execution.phases, Phase::Contact);
  before.free_v = motion.v;
  find_obstacles(plan, before.time, h, before.obstacles);
  before.first_touch = before.first_impact = never;
  keep_on_planes(plan, before.time + h, motion);
  const double energy = before.is_limited ? energy_of_limited(plan, before, h, motion) : 0.0;
  double work = 0.0, push = 0.0;
  if (!resolve_all(plan, before, motion, h, work, push)) return false;

  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at)
      motion.contact[at] += plan.mass[i] * (motion.v[at] - before.free_v[at]);
  if (std::isfinite(before.first_impact)) damp_impacts(plan, before.displaced, h, motion);
  if (before.is_limited) work = energy_of_limited(plan, before, h, motion) - energy - push;
  motion.energy.add(EnergyCause::Colliders, push);
  book_work(work, max_supplied(plan, before, h, motion), motion);
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
