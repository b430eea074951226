#include "sim/control/error_estimator.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "sim/control/constants.h"
#include "sim/control/frame_error.h"
#include "sim/forces/spring_laws.h"
#include "sim/forces/spring_limits.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

bool acts(const Plan& plan, const LawSpring& spring, const State& state) {
  const double length = glm::distance(state.position[spring.first], state.position[spring.second]);
  return response_of(spring, plan.spring.laws.clock, state.time, length).of.acts;
}

// Whether the ends of a spring passed each other within a step: its force jumped to the opposite direction.
bool has_flipped(const Vec3& before, const Vec3& after, int substeps) {
  const Vec3 path = after - before;
  if (!(glm::dot(before, after) < 0.0)) return false;
  const Vec3 closest = before - glm::dot(before, path) / glm::dot(path, path) * path;
  return glm::length(closest) < glm::length(path) / substeps;
}

// Whether a spring went slack or taut.
bool have_laws_switched(const Plan& plan, const State& start, const State& end) {
  const auto has_switched = [&](const LawSpring& spring) { return acts(plan, spring, start) != acts(plan, spring, end); };
  return std::ranges::any_of(plan.spring.laws.springs, has_switched);
}

bool has_any_flipped(const Plan& plan, const State& start, const State& end, int substeps) {
  return any_spring(plan, [&](Index i, Index j, Index s) {
    return carries_force(plan, s) && has_flipped(start.position[j] - start.position[i], end.position[j] - end.position[i], substeps);
  });
}

}  // namespace

void set_end(FrameEnd& end, const Frame& frame, const Plan& plan, const State& start, State& scratch) {
  scratch = start;
  frame.end(plan, scratch);
  end.position = scratch.position;
  end.velocity = scratch.velocity;
  end.broken.assign(frame.broken().begin(), frame.broken().end());
  end.has_touched = frame.has_touched() || have_laws_switched(plan, start, scratch);
  end.has_flipped = has_any_flipped(plan, start, scratch, frame.substeps_done());
  end.has_impact = frame.has_impact();
  end.is_finite = frame.failure() == StepFailure::None && is_finite(scratch);
}

int order_of(const System& system, const Integrator& method, const FrameEnd& end) {
  const bool is_smooth = end.is_finite && !end.has_touched && !end.has_flipped && end.broken.empty() && system.strain_limit == 0.0;
  return is_smooth ? free_order(system, method) : 1;
}

int first_substeps(int substeps) { return (substeps + 1) / 2; }

FrameEnd& FrameRuns::add() {
  std::swap(ends_[0], ends_[1]);
  ++count_;
  return ends_[0];
}

bool FrameRuns::have_contacts() const {
  return std::ranges::any_of(all(), [](const FrameEnd& end) { return end.has_touched || !end.broken.empty(); });
}

bool FrameRuns::have_events() const { return have_contacts() || std::ranges::any_of(all(), &FrameEnd::has_flipped); }

bool FrameRuns::have_jumps() const {
  return std::ranges::any_of(all(), [](const FrameEnd& end) { return end.has_impact || end.has_flipped || !end.broken.empty(); });
}

double FrameRuns::error(const System& system, const Integrator& method) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double reduction = std::ldexp(1.0, have_events() ? 1 : order_of(system, method, ends_[0]));
  const auto distance = [&](const FrameEnd& coarse, const FrameEnd& fine) {
    const bool agree = coarse.is_finite && fine.is_finite && coarse.broken == fine.broken;
    if (!agree) return infinity;
    const double of_positions = weighted_distance(system, coarse.position, fine.position, 1.0).rms;
    if (frequency_ == 0.0) return of_positions;
    const double of_velocities = weighted_distance(system, coarse.velocity, fine.velocity, 1.0).rms / frequency_;
    return std::sqrt(of_positions * of_positions + of_velocities * of_velocities);
  };
  return distance(ends_[1], ends_[0]) / (std::min(reduction, control::max_assumed_reduction) - 1.0);
}

double FrameRuns::velocity_error(const System& system) const {
  if (!ends_[0].is_finite || !ends_[1].is_finite) return std::numeric_limits<double>::infinity();
  return weighted_distance(system, ends_[1].velocity, ends_[0].velocity, 1.0).rms;
}

bool is_calm(const Plan& plan, const State& state, double duration) {
  const bool has_events = plan.has_contact() || !plan.spring.break_length.empty() || !plan.spring.max_length.empty() || plan.hand.held ||
                          plan.hand.pull || plan.collider_paths.grabbed || !plan.forces.empty() || !plan.spring.laws.empty();
  if (has_events) return false;
  return !any_spring(plan, [&](Index i, Index j, Index) {
    const double length = glm::distance(state.position[i], state.position[j]), speed = glm::distance(state.velocity[i], state.velocity[j]);
    return !(speed * duration <= control::max_turn * length);
  });
}

// m v^2 / 2 + U(l) >= U((l0 + L) / 2), m the reduced mass of both ends, U of a linear spring k (l - l0)^2 / 2
bool may_break(const Plan& plan, const State& state) {
  return !plan.spring.break_length.empty() && any_spring(plan, [&](Index i, Index j, Index s) {
    const double limit = plan.spring.break_length[s], w = plan.inverse_mass[i] + plan.inverse_mass[j];
    if (!std::isfinite(limit) || w == 0.0 || !carries_force(plan, s)) return false;
    const auto energy_at = [&](double length) { return response_of(plan, s, state.time, length).of.energy; };
    const Vec3 relative = state.velocity[i] - state.velocity[j];
    const double supplied = 0.5 * glm::dot(relative, relative) / w + energy_at(glm::distance(state.position[i], state.position[j]));
    return supplied >= energy_at(0.5 * (plan.spring.rest_length[s] + limit));
  });
}

}  // namespace hooke
