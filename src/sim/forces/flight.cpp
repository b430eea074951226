#include "sim/forces/flight.h"

#include <algorithm>
#include <array>
#include <span>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/grid_kernel.h"
#include "sim/forces/single_precision.h"
#include "sim/forces/spring_kernel.h"
#include "sim/forces/spring_limits.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// v' = decay v + weight a of a kick over h, as in motion.h.
struct Kick {
  double decay, weight;
  Kick(const Plan& plan, double h)
      : decay(plan.drag == 0.0 ? 1.0 : portable::exp(-plan.drag * h)),
        weight(plan.drag == 0.0 ? h : -portable::expm1(-plan.drag * h) / plan.drag) {}
};

GridPass pass_of(const Plan& plan, double kick, double drift, const PassDashpots& dashpots) {
  const Kick now(plan, kick), ahead(plan, dashpots.ahead);
  return {.decay = now.decay,
          .weight = now.weight,
          .drift = drift,
          .damped = dashpots.velocity != nullptr,
          .dashpot_velocity = dashpots.velocity != nullptr ? dashpots.velocity->data() : nullptr,
          .predicted = dashpots.predicted != nullptr ? dashpots.predicted->data() : nullptr,
          .predicted_decay = ahead.decay,
          .predicted_weight = ahead.weight};
}

// Adds the forces of the springs outside grids to the external ones, if there are any, for a pass that adds those of grids.
void set_other_forces(const Plan& plan, double time, const PassDashpots& dashpots, Motion& motion, GridPass& pass) {
  if (plan.spring.loose_runs.empty() && plan.forces.empty()) return;
  compute_external_forces(plan, time, motion.x, motion.v, motion.a);
  add_loose_spring_forces(plan, motion.x.data(), dashpots.velocity != nullptr ? dashpots.velocity->data() : nullptr, motion.a.data());
  pass.f = motion.a.data();
}

// As many passes over all points as there are watches. Grids do not act on each other.
void advance_all(const Plan& plan, const GridPass& pass, Motion& motion, std::span<GridWatch> watches) {
  double *const x = motion.x.data(), *const v = motion.v.data();
  Index next = 0;
  for (const Grid& grid : plan.spring.grids) {
    for (GridWatch& watch : watches) advance_points(plan, next, grid.first, pass, x, v, watch);
    advance_grid(plan, grid, pass, x, v, watches);
    next = grid.first + grid.points();
  }
  for (GridWatch& watch : watches) advance_points(plan, next, plan.points, pass, x, v, watch);
}

void record(const GridWatch& watch, double drift, Flight& flight) {
  const double speed = std::sqrt(watch.max_speed_squared);
  // some methods also drift backward
  flight.travel += std::abs(drift) * speed;
  flight.max_speed = std::max(flight.max_speed, speed);
  flight.max_drift = std::max(flight.max_drift, std::abs(drift));
  flight.any_at_limit = flight.any_at_limit || watch.any_at_limit;
}

}  // namespace

bool can_fly(const Plan& plan) {
  return !plan.hand.held && !plan.hand.pull && !plan.collider_paths.any_moves && !plan.collider_paths.grabbed &&
         std::ranges::all_of(plan.forces, [](const Force& force) {
           const ForceTerm& term = *force.term;
           return term.potential != nullptr && !force.depends_on_velocity() &&
                  (term.depends_on_time == nullptr || !term.depends_on_time(force.values));
         });
}

void kick_and_drift(const Plan& plan, Motion& motion, double kick, double drift, const PassDashpots& dashpots, Flight& flight) {
  GridPass pass = pass_of(plan, kick, drift, dashpots);
  set_other_forces(plan, motion.time, dashpots, motion, pass);
  motion.acceleration_is_current = false;

  GridWatch watch{.any_at_limit = any_reaches_limit(plan, plan.spring.loose_runs, motion.x)};
  advance_all(plan, pass, motion, {&watch, 1});
  record(watch, drift, flight);
}

namespace {

// At most max_grid_passes steps at once: the threads need not wait for each other after every step. What was reached is known afterwards.
// Of an interrupted flight, which is repeated, the steps beyond the interruption do not count.
void advance_at_once(const Plan& plan, const GridPass& pass, Motion& motion, int steps, Flight& flight) {
  std::array<GridWatch, max_grid_passes> watches;
  advance_all(plan, pass, motion, {watches.data(), static_cast<std::size_t>(steps)});
  for (int i = 0; i < steps && !flight.was_interrupted(); ++i) {
    record(watches[i], pass.drift, flight);
    ++motion.counts.force_evaluations;
    motion.time += pass.drift;
  }
}

}  // namespace

void kick_and_drift_steps(const Plan& plan, Motion& motion, double h, int steps, const PassDashpots& dashpots, Flight& flight) {
  const GridPass pass = pass_of(plan, h, h, dashpots);
  if (plan.execution.single != nullptr) {
    plan.execution.single->advance(plan, pass, steps, motion);
    motion.acceleration_is_current = false;
    motion.counts.force_evaluations += steps;
    motion.time += steps * h;
  } else if (plan.execution.team != nullptr && plan.spring.loose_runs.empty() && plan.forces.empty()) {
    motion.acceleration_is_current = false;
    for (int done = 0; done < steps && !flight.was_interrupted(); done += max_grid_passes)
      advance_at_once(plan, pass, motion, std::min(steps - done, max_grid_passes), flight);
  } else {
    for (int i = 0; i < steps && !flight.was_interrupted(); ++i) {
      kick_and_drift(plan, motion, h, h, dashpots, flight);
      ++motion.counts.force_evaluations;
      motion.time += h;
    }
  }
}

void kick_and_drift_with_known(const Plan& plan, Motion& motion, double kick, double drift, const PassDashpots& dashpots, Flight& flight) {
  GridPass pass = pass_of(plan, kick, drift, dashpots);
  pass.a = motion.a.data();
  pass.is_known = true;
  motion.acceleration_is_current = false;
  GridWatch watch;
  advance_points(plan, 0, plan.points, pass, motion.x.data(), motion.v.data(), watch);
  record(watch, drift, flight);
}

void kick_and_drift_with_forces(const Plan& plan, Motion& motion, const Field& f, double kick, double drift, const PassDashpots& dashpots) {
  GridPass pass = pass_of(plan, kick, drift, dashpots);
  pass.f = f.data();
  GridWatch watch;
  advance_points(plan, 0, plan.points, pass, motion.x.data(), motion.v.data(), watch);
}

namespace {

// The rows of a grid on whose points the forces have changed.
RowRange changed_rows(const Grid& grid, const Motion::Moved& moved) {
  const Index first = std::max(moved.first - grid.first, Index{0}), end = std::min(moved.end - grid.first, grid.points());
  if (first >= end) return {0, 0};
  return {std::max(first / grid.columns - 1, Index{0}), std::min((end - 1) / grid.columns + 2, grid.rows)};
}

// A pass that computes the forces of grids only where they have changed, with `a` known elsewhere. The rows beside changed ones are read
// before they are advanced.
void advance_changed(const Plan& plan, const GridPass& pass, const Motion::Moved& moved, Motion& motion) {
  GridPass known = pass;
  known.is_known = true;
  double *const x = motion.x.data(), *const v = motion.v.data();
  GridWatch watch;
  Index next = 0;
  for (const Grid& grid : plan.spring.grids) {
    advance_points(plan, next, grid.first, pass, x, v, watch);
    next = grid.first + grid.points();
    const RowRange rows = changed_rows(grid, moved);
    if (rows.begin < rows.end) advance_grid(plan, grid, pass, x, v, {&watch, 1}, rows);
    advance_points(plan, grid.first, grid.first + rows.begin * grid.columns, known, x, v, watch);
    advance_points(plan, grid.first + rows.end * grid.columns, next, known, x, v, watch);
  }
  advance_points(plan, next, plan.points, pass, x, v, watch);
}

}  // namespace

bool can_accelerate_and_kick(const Plan& plan) { return can_accelerate_and_kick_with(plan) && plan.forces.empty(); }
bool can_accelerate_and_kick_with(const Plan& plan) { return !plan.spring.grids.empty() && !plan.hand.pull; }

void accelerate_and_kick(const Plan& plan, double time, Motion& motion, double kick, double drift, const PassDashpots& dashpots,
                         const Motion::Moved& moved) {
  GridPass pass = pass_of(plan, kick, drift, dashpots);
  pass.a = motion.a.data();
  set_other_forces(plan, time, dashpots, motion, pass);
  if (moved.first < moved.end && plan.spring.loose_runs.empty()) return advance_changed(plan, pass, moved, motion);
  GridWatch watch;
  advance_all(plan, pass, motion, {&watch, 1});
}

void accelerate_and_kick_with(const Plan& plan, const Field& external, Motion& motion, double kick, double drift,
                              const PassDashpots& dashpots) {
  GridPass pass = pass_of(plan, kick, drift, dashpots);
  pass.a = motion.a.data();
  pass.f = external.data();
  if (!plan.spring.loose_runs.empty()) {
    std::ranges::copy(external, motion.a.begin());
    add_loose_spring_forces(plan, motion.x.data(), pass.dashpot_velocity, motion.a.data());
    pass.f = motion.a.data();
  }
  GridWatch watch;
  advance_all(plan, pass, motion, {&watch, 1});
}

}  // namespace hooke
