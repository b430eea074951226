#include "sim/forces/motion.h"

#include <algorithm>
#include <cmath>

#include "sim/forces/field_kernel.h"
#include "sim/forces/kick.h"
#include "sim/model/state.h"

namespace hooke {

void Workspace::size_fields(std::size_t count, const Motion& motion) {
  fields.resize(std::max(count, fields.size()));
  for (std::size_t i = 0; i < count; ++i) fields[i].resize(motion.x.size());
}

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
      const Index listed = plan.listed_index(i);
      x[i] = state.position[listed][c];
      v[i] = plan.inverse_mass[i] == 0.0 ? 0.0 : state.velocity[listed][c];
    }
  }
  motion.acceleration_is_current = false;
  motion.power.reset();
  motion.memory = state.memory;
  motion.counts = {};
  motion.crossings = 0;
  motion.collider_work = motion.break_work = motion.limit_work = motion.hand_work = motion.abs_hand_work = motion.force_work = 0.0;
  motion.local_error = motion.contact_work = motion.reversible_work = 0.0;
  motion.drag_work = motion.dashpot_work = motion.limit_gain = 0.0;
  motion.measures_damping = false;
  motion.breaks.clear();
}

void unpack(const Plan& plan, const Motion& motion, State& state) {
  state.time = motion.time;
  state.memory = motion.memory;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double* x = motion.x.data() + static_cast<std::size_t>(c) * plan.points;
    const double* v = motion.v.data() + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) {
      const Index listed = plan.listed_index(i);
      state.position[listed][c] = x[i];
      state.velocity[listed][c] = v[i];
    }
  }
}

namespace {

// A held point keeps the velocity of the hand, and nailed ones are at rest: their acceleration is zero.
void kick(const Plan& plan, const Field& a, double h, Field& v) {
  const Kick<double> kick = kick_over(plan.drag, h);
  if (plan.drag == 0.0) return add_scaled(v.data(), kick.weight, a.data(), v.size());

  Vec3 held{0.0};
  for (int c = 0; plan.hand.held && c < plan.dimensions; ++c) held[c] = v[static_cast<std::size_t>(c) * plan.points + *plan.hand.held];
  scale_and_add_scaled(v.data(), kick.decay, kick.weight, a.data(), v.size());
  for (int c = 0; plan.hand.held && c < plan.dimensions; ++c) v[static_cast<std::size_t>(c) * plan.points + *plan.hand.held] = held[c];
}

}  // namespace

void kick(const Plan& plan, Motion& motion, double h) { kick(plan, motion.a, h, motion.v); }

void predict_velocity(const Plan& plan, const Motion& motion, double h, Field& v) {
  v = motion.v;
  kick(plan, motion.a, h, v);
}

void drift(Motion& motion, double h) { add_scaled(motion.x.data(), h, motion.v.data(), motion.x.size()); }

double root_mean_square(const Plan& plan, const Field& field) {
  double sum = 0.0;
  for (const double value : field) sum += value * value;
  const auto moving = std::count_if(plan.inverse_mass.begin(), plan.inverse_mass.end(), [](double w) { return w != 0.0; });
  return moving == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(moving));
}

}  // namespace hooke
