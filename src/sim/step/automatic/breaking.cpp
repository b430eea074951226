#include "sim/step/automatic/breaking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {

bool is_about_to_break(const Plan& plan, const State& state, double duration) {
  if (plan.spring.break_length.empty()) return false;
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      const double limit = plan.spring.break_length[run.begin + e];
      if (!std::isfinite(limit)) continue;
      const Index first = plan.listed_index(run.first + e), second = plan.listed_index(run.second + e);
      const Vec3 between = state.position[second] - state.position[first], relative = state.velocity[second] - state.velocity[first];
      const double length = glm::length(between), max_speed = glm::length(relative);
      if (length + duration * max_speed < limit) continue;
      const double speed = length > 0.0 ? glm::dot(between, relative) / length : max_speed;
      if (length + duration * speed >= limit) return true;
    }
  return false;
}

// The impulse F h / 2 of a point of mass m would move it by F h T / (2 m) until the end of the frame. A wave with the frequency omega of
// the spring carries it to omega T neighbors by then, each of which moves by F h / (2 m omega): in total less, by the root of omega T.
double breaking_error(const Plan& plan, const System& system, std::span<const Index> broken, double duration, double step) {
  double sum = 0.0;
  for (const Index s : broken) {
    const Spring& spring = system.springs()[s];
    const double w1 = plan.inverse_mass[plan.number_of(system.index_of(spring.first))],
                 w2 = plan.inverse_mass[plan.number_of(system.index_of(spring.second))];
    const double k = system.stiffness_of(spring), force = k * std::max(0.0, system.break_length_of(spring) - spring.rest_length);
    const double spread = 1.0 + std::sqrt(k * (w1 + w2)) * duration;
    const double moved = 0.5 * force * step * duration;
    sum += moved * moved * (w1 * w1 + w2 * w2) / spread;
  }
  return plan.points == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(plan.points));
}

}  // namespace hooke
