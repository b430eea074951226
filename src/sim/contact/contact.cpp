#include "sim/contact/contact.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/contact/point_contact.h"
#include "sim/contact/resting_kernel.h"
#include "sim/plan_energy.h"

namespace hooke {
namespace {

// of point i, whose components are `n` apart
Vec3 vector_at(const Field& field, std::size_t n, std::size_t i, int dimensions) {
  return {field[i], field[n + i], dimensions == 3 ? field[2 * n + i] : 0.0};
}

// [J], the potentials of the listed forces included.
double potential_energy(const Plan& plan, double time, const Field& x) {
  double energy = stored_energy(plan, x);
  for (const Force& force : plan.forces)
    if (force.term->potential != nullptr) energy += force.term->potential(plan, force.values, time, x.data());
  return energy;
}

// [J], that moved points out of colliders: the difference of the energy with and without these displacements.
double push_work(const Plan& plan, const ContactWorkspace& before, double h, Motion& motion) {
  const auto n = static_cast<std::size_t>(plan.points);
  const double middle = before.time + 0.5 * h;  // as in ForceWork
  const double energy = potential_energy(plan, middle, motion.x);
  for (const ContactWorkspace::Pushed& each : before.pushed)
    for (int c = 0; c < plan.dimensions; ++c) motion.x[c * n + each.point] -= each.displacement[c];
  const double without = potential_energy(plan, middle, motion.x);
  for (const ContactWorkspace::Pushed& each : before.pushed)
    for (int c = 0; c < plan.dimensions; ++c) motion.x[c * n + each.point] = each.position[c];
  return energy - without;
}

}  // namespace

bool has_contact(const System& system) { return system.contact.any() || std::ranges::any_of(system.colliders, &Collider::solid); }

bool resolve_contacts(const Plan& plan, ContactWorkspace& before, Motion& motion, double h) {
  const auto n = static_cast<std::size_t>(plan.points);
  const std::span<const Obstacle> obstacles = find_obstacles(plan, before.time, h, before.obstacles);
  before.first_touch = before.first_impact = std::numeric_limits<double>::infinity();
  before.pushed.clear();
  before.pushed.reserve(n);
  if (plan.surface.on) before.surface.begin_substep(plan, motion);
  const bool has_pairs = plan.pairs.on;
  bool touched = has_pairs && before.pairs.resolve(plan, obstacles, before.x, before.v, h, motion);
  if (touched) {
    before.first_touch = before.pairs.first_touch();
    before.first_impact = before.pairs.first_impact();
  }
  // most points that touch rest or slide: these at once, and the others one by one
  const bool has_resting = !has_pairs && !plan.colliders_move && !obstacles.empty();
  RestingPoints resting;
  double contact_work = 0.0;  // [J], in addition to the work of the forces
  for (std::size_t i = 0; i < n && !obstacles.empty(); ++i) {
    if (has_resting) {
      const std::size_t at = i % RestingPoints::max;
      if (at == 0) solve_resting_points(plan, h, i, before.x, before.v, motion.x, motion.v, resting);
      if (resting.outcome[at] == RestingPoints::Free) continue;
      if (resting.outcome[at] == RestingPoints::Solved) {
        touched = true;
        before.first_touch = 0.0;
        contact_work += resting.work[at];
        continue;
      }
    }
    if (plan.inverse_mass[i] == 0.0 || (has_pairs && before.pairs.has_resolved(static_cast<Index>(i)))) continue;
    const Vec3 x0 = vector_at(before.x, n, i, plan.dimensions), x1 = vector_at(motion.x, n, i, plan.dimensions);
    const Vec3 v0 = vector_at(before.v, n, i, plan.dimensions), v1 = vector_at(motion.v, n, i, plan.dimensions);
    const double radius = plan.radius[i], bulge = 0.125 * h * glm::length(v1 - v0);
    if (std::ranges::none_of(obstacles, [&](const Obstacle& obstacle) { return may_touch(obstacle, radius, x0, x1, bulge, h); })) continue;

    // the parabola through both positions with the mean acceleration of the step: its velocity starts ahead of v0
    const Vec3 a = (v1 - v0) / h, velocity_correction = (x1 - x0) / h - v0 - 0.5 * h * a;
    PointContactSolver solver(obstacles, radius, x0, v0);
    if (!solver.advance(a, velocity_correction, h)) continue;

    touched = true;
    before.first_touch = std::min(before.first_touch, solver.first_touch);
    before.first_impact = std::min(before.first_impact, solver.first_impact);
    if (solver.push_out != Vec3(0.0)) before.pushed.push_back({i, solver.x, solver.push_out});
    contact_work += plan.mass[i] * (0.5 * (glm::dot(solver.v, solver.v) - glm::dot(v1, v1)) - glm::dot(a, solver.x - x1 - solver.push_out));
    for (int c = 0; c < plan.dimensions; ++c) {
      motion.x[c * n + i] = solver.x[c];
      motion.v[c * n + i] = solver.v[c];
    }
  }
  (plan.colliders_move ? motion.collider_work : motion.contact_work) += contact_work;
  if (!before.pushed.empty()) motion.collider_work += push_work(plan, before, h, motion);
  if (plan.surface.on && before.surface.resolve(plan, obstacles, before.x, before.v, h, motion)) {
    touched = true;
    before.first_touch = 0.0;
  }
  return touched;
}

}  // namespace hooke
