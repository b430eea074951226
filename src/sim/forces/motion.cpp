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
      x[i] = state.position[i][c];
      v[i] = plan.inverse_mass[i] == 0.0 ? 0.0 : state.velocity[i][c];
    }
  }
  clear_fixed_axes(plan, motion.v.data());
  motion.acceleration_is_current = false;
  motion.power.reset();
  motion.memory = state.memory;
  motion.counts = {};
  motion.crossings = 0;
  motion.energy = {};
  motion.contact.assign(plan.has_contact() ? size : 0, 0.0);
  motion.local_error = 0.0;
}

void unpack(const Plan& plan, const Motion& motion, State& state) {
  state.time = motion.time;
  state.memory = motion.memory;
  for (int c = 0; c < plan.dimensions; ++c) {
    const double* x = motion.x.data() + static_cast<std::size_t>(c) * plan.points;
    const double* v = motion.v.data() + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) {
      state.position[i][c] = x[i];
      state.velocity[i][c] = v[i];
    }
  }
}

namespace {

// A held point keeps the velocity of the hand, and nailed ones are at rest: their acceleration is zero.
void kick(const Plan& plan, const Field& a, double h, Field& v) {
  const Kick<double> kick = kick_over(plan.drag, h);
  if (plan.drag == 0.0) return add_scaled(v.data(), kick.weight, a.data(), v.size());

  const Vec3 held = plan.hand.held ? vector_at(plan, v, *plan.hand.held) : Vec3(0.0);
  scale_and_add_scaled(v.data(), kick.decay, kick.weight, a.data(), v.size());
  if (plan.hand.held) set_vector(plan, v, *plan.hand.held, held);
}

}  // namespace

void kick(const Plan& plan, Motion& motion, double h) { kick(plan, motion.a, h, motion.v); }

void predict_velocity(const Plan& plan, const Motion& motion, double h, Field& v) {
  v = motion.v;
  kick(plan, motion.a, h, v);
}

void drift(Motion& motion, double h) { add_scaled(motion.x.data(), h, motion.v.data(), motion.x.size()); }

double dot(const Field& a, const Field& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double root_mean_square(const Plan& plan, const Field& field) {
  const auto moving = std::count_if(plan.inverse_mass.begin(), plan.inverse_mass.end(), [](double w) { return w != 0.0; });
  return moving == 0 ? 0.0 : std::sqrt(dot(field, field) / static_cast<double>(moving));
}

}  // namespace hooke
