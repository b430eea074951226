#include "sim/step/automatic/turning.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {

double turning_of(const Plan& plan, const State& state, double frame_cost) {
  constexpr double ms_per_spring = 4e-6, max_part = 0.03;
  constexpr double min_springs = 64.0;
  const double affordable = std::max(min_springs, max_part * frame_cost / ms_per_spring);
  const Index stride = std::max<Index>(1, static_cast<Index>(std::ceil(plan.springs / affordable)));
  double max = 0.0;  // of the square
  Index next = 0;    // of all springs
  for (const SpringRun& run : plan.spring.runs) {
    for (; next < run.begin + run.count; next += stride) {
      const Index e = next - run.begin;
      const Index first = plan.listed_index(run.first + e), second = plan.listed_index(run.second + e);
      const Vec3 between = state.position[second] - state.position[first];
      const Vec3 relative = state.velocity[second] - state.velocity[first];
      const double length_squared = glm::dot(between, between);
      if (length_squared > 0.0) max = std::max(max, glm::dot(relative, relative) / length_squared);
    }
  }
  return std::sqrt(max);
}

}  // namespace hooke
