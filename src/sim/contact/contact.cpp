#include "sim/contact/contact.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/contact/point_contact.h"
#include "sim/contact/resting_kernel.h"
#include "sim/forces/bands.h"
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

using Outcome = ContactWorkspace::Outcome;

// Points against the obstacles, each by itself: consecutive points may be solved on one thread, and others on another.
class PointPass {
 public:
  // [s], since the start of the substep, of the points solved; infinity: none
  struct Touches {
    double first_touch = std::numeric_limits<double>::infinity(), first_impact = std::numeric_limits<double>::infinity();
  };

  PointPass(const Plan& plan, std::span<const Obstacle> obstacles, ContactWorkspace& before, Motion& motion, double h)
      : plan_(plan), obstacles_(obstacles), before_(before), motion_(motion), h_(h), n_(static_cast<std::size_t>(plan.points)) {}

  // Points first .. end - 1. Leaves those Open that start inside an obstacle: they are solved by solve_open_point.
  void solve(std::size_t first, std::size_t end, Touches& touches) const {
    if (!plan_.pairs.on && !plan_.colliders_move)
      solve_resting(first, end, touches);
    else
      std::fill(before_.outcome.data() + first, before_.outcome.data() + end, Outcome::Open);
    for (std::size_t i = first; i < end; ++i)
      if (before_.outcome[i] == Outcome::Open) before_.outcome[i] = solve_point(i, nullptr, touches);
  }

  // After all others, in the order of the points.
  void solve_open_point(std::size_t i, Touches& touches) const { solve_point(i, &before_.pushed, touches); }

 private:
  // Most points that touch rest or slide: these at once.
  void solve_resting(std::size_t first, std::size_t end, Touches& touches) const {
    RestingPoints resting;
    for (std::size_t start = first; start < end; start += RestingPoints::max) {
      const std::size_t count = std::min(end - start, RestingPoints::max);
      solve_resting_points(plan_, h_, start, before_.x, before_.v, motion_.x, motion_.v, resting);
      for (std::size_t at = 0; at < count; ++at) {
        const bool is_solved = resting.outcome[at] == RestingPoints::Solved;
        before_.outcome[start + at] = is_solved                                    ? Outcome::Solved
                                      : resting.outcome[at] == RestingPoints::Free ? Outcome::Free
                                                                                   : Outcome::Open;
        if (!is_solved) continue;
        before_.work[start + at] = resting.work[at];
        touches.first_touch = 0.0;
      }
    }
  }

  Outcome solve_point(std::size_t i, std::vector<ContactWorkspace::Pushed>* pushed, Touches& touches) const {
    if (plan_.inverse_mass[i] == 0.0 || (plan_.pairs.on && before_.pairs.has_resolved(static_cast<Index>(i)))) return Outcome::Free;
    const int dimensions = plan_.dimensions;
    const Vec3 x0 = vector_at(before_.x, n_, i, dimensions), x1 = vector_at(motion_.x, n_, i, dimensions);
    const Vec3 v0 = vector_at(before_.v, n_, i, dimensions), v1 = vector_at(motion_.v, n_, i, dimensions);
    const double radius = plan_.radius[i], bulge = 0.125 * h_ * glm::length(v1 - v0);
    const auto is_near = [&](const Obstacle& obstacle) { return may_touch(obstacle, radius, x0, x1, bulge, h_); };
    if (std::ranges::none_of(obstacles_, is_near)) return Outcome::Free;

    // the parabola through both positions with the mean acceleration of the step: its velocity starts ahead of v0
    const Vec3 a = (v1 - v0) / h_, velocity_correction = (x1 - x0) / h_ - v0 - 0.5 * h_ * a;
    PointContactSolver solver(obstacles_, radius, x0, v0);
    if (!solver.advance(a, velocity_correction, h_)) return Outcome::Free;
    if (solver.push_out != Vec3(0.0)) {
      if (pushed == nullptr) return Outcome::Open;
      pushed->push_back({i, solver.x, solver.push_out});
    }

    touches.first_touch = std::min(touches.first_touch, solver.first_touch);
    touches.first_impact = std::min(touches.first_impact, solver.first_impact);
    before_.work[i] =
        plan_.mass[i] * (0.5 * (glm::dot(solver.v, solver.v) - glm::dot(v1, v1)) - glm::dot(a, solver.x - x1 - solver.push_out));
    for (int c = 0; c < dimensions; ++c) {
      motion_.x[c * n_ + i] = solver.x[c];
      motion_.v[c * n_ + i] = solver.v[c];
    }
    return Outcome::Solved;
  }

  const Plan& plan_;
  std::span<const Obstacle> obstacles_;
  ContactWorkspace& before_;
  Motion& motion_;
  double h_;
  std::size_t n_;
};

// Returns the work of the contact [J], in addition to the work of the forces.
double resolve_points(const Plan& plan, std::span<const Obstacle> obstacles, ContactWorkspace& before, Motion& motion, double h,
                      bool& touched) {
  if (obstacles.empty()) return 0.0;
  const auto n = static_cast<std::size_t>(plan.points);
  before.outcome.resize(n);
  before.work.resize(n);
  const PointPass pass(plan, obstacles, before, motion, h);

  // blocks of points on as many threads as there are
  constexpr std::size_t block = RestingPoints::max;
  constexpr Index min_blocks = 2;  // some microseconds
  std::array<PointPass::Touches, max_parts> touches;
  const int parts = for_parts(plan, static_cast<Index>((n + block - 1) / block), min_blocks, [&](int part, Index first, Index end) {
    pass.solve(static_cast<std::size_t>(first) * block, std::min(n, static_cast<std::size_t>(end) * block), touches[part]);
  });

  // sums in the order of the points
  double work = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (before.outcome[i] == Outcome::Free) continue;
    if (before.outcome[i] == Outcome::Open) pass.solve_open_point(i, touches[0]);
    touched = true;
    work += before.work[i];
  }
  for (int part = 0; part < parts; ++part) {
    before.first_touch = std::min(before.first_touch, touches[part].first_touch);
    before.first_impact = std::min(before.first_impact, touches[part].first_impact);
  }
  return work;
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
  bool touched = plan.pairs.on && before.pairs.resolve(plan, obstacles, before.x, before.v, h, motion);
  if (touched) {
    before.first_touch = before.pairs.first_touch();
    before.first_impact = before.pairs.first_impact();
  }
  const double contact_work = resolve_points(plan, obstacles, before, motion, h, touched);
  (plan.colliders_move ? motion.collider_work : motion.contact_work) += contact_work;
  if (!before.pushed.empty()) motion.collider_work += push_work(plan, before, h, motion);
  if (plan.surface.on && before.surface.resolve(plan, obstacles, before.x, before.v, h, motion)) {
    touched = true;
    before.first_touch = 0.0;
  }
  return touched;
}

}  // namespace hooke
