#include "sim/motion.h"

#include "sim/state.h"

namespace hooke {

void pack(const Plan& plan, const State& state, Motion& motion) {
  const auto size = static_cast<std::size_t>(plan.points) * plan.dimensions;
  motion.time = state.time;
  motion.x.resize(size);
  motion.v.resize(size);
  motion.a.resize(size);
  for (int c = 0; c < plan.dimensions; ++c) {
    double* x = motion.x.data() + static_cast<std::size_t>(c) * plan.points;
    double* v = motion.v.data() + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) {
      x[i] = state.position[i][c];
      v[i] = state.velocity[i][c];
    }
  }
  motion.acceleration_is_current = false;
  motion.force_evaluations = 0;
  motion.factorizations = 0;
}

void unpack(const Plan& plan, const Motion& motion, State& state) {
  state.time = motion.time;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double* x = motion.x.data() + static_cast<std::size_t>(c) * plan.points;
    const double* v = motion.v.data() + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) {
      state.position[i][c] = x[i];
      state.velocity[i][c] = v[i];
    }
  }
}

}  // namespace hooke
