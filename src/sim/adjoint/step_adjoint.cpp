// Written q' for the derivative of the weighted sum by q, a step y1 = F(y0, p) is passed by y0' = (dF/dy)^T y1', p' += (dF/dp)^T y1'
// (A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., 2008, ch. 3); of a Runge-Kutta method, W. W. Hager, Numer. Math. 87 (2000)
// 247-282.
#include "sim/adjoint/step_adjoint.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/sweep_runs.h"
#include "sim/methods/rows.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// y = s a + t b
void set_sum(double s, const Field& a, double t, const Field& b, Field& y) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = s * a[i] + t * b[i];
}

// In the order of a sweep over the dashpots.
std::vector<Link> links_of(const Plan& plan) {
  std::vector<Link> links;
  for (const SpringRun& run : plan.spring.runs)
    for (Index p = 0; p < count_sweep_parts(run); ++p)
      for (Index n = 0; n < sweep_part(run, p).count; ++n) {
        const SweepRun part = sweep_part(run, p);
        links.push_back({part.first + n * part.step, part.second + n * part.step, part.begin + n * part.step});
      }
  return links;
}

}  // namespace

StepAdjoint::Back StepAdjoint::find(const Integrator& method) {
  if (&method == &velocity_verlet) return &StepAdjoint::pass_verlet;
  if (&method == &runge_kutta4) return &StepAdjoint::pass_runge_kutta4;
  return nullptr;
}

StepAdjoint::StepAdjoint(const Plan& plan, const Integrator& method, double h)
    : plan_(plan),
      back_(find(method)),
      h_(h),
      links_(links_of(plan)),
      reversed_(links_.rbegin(), links_.rend()),
      first_(links_.size()),
      last_(links_.size()),
      fields_(13, Field(static_cast<std::size_t>(plan.points) * plan.dimensions)) {
  if (plan.has_dashpots()) plan_dashpot_decay(plan, 0.5 * h, decay_);
}

// The force on the first point is t u, with r from it to the second, u = r / |r|, t = k (|r| - l0) + d u.w and w the difference of the
// velocities. With f' = a' / m, q = f1' - f2' and s = u.q, the sum changes by t s.
void StepAdjoint::pass_acceleration(const Field& x, const Field* v, const Field& of_a, Adjoint& to, Field& to_x, Field* to_v) const {
  for (const auto& [i, j, s] : links_) {
    const double m1 = plan_.inverse_mass[i], m2 = plan_.inverse_mass[j];
    if (m1 == 0.0 && m2 == 0.0) continue;
    const Vec3 a1 = vector_at(plan_, of_a, i), a2 = vector_at(plan_, of_a, j), q = m1 * a1 - m2 * a2;
    const Vec3 r = difference_at(plan_, x, i, j);
    const double length = glm::length(r), k = plan_.spring.stiffness[s], extension = length - plan_.spring.rest_length[s];
    const Vec3 u = length > 0.0 ? r / length : Vec3(0.0);
    const double along = glm::dot(u, q);
    double tension = k * extension;
    Vec3 of_r = k * along * u;
    if (v != nullptr && plan_.has_dashpots() && length > 0.0) {
      const Vec3 w = difference_at(plan_, *v, i, j);
      const double d = plan_.spring.damping[s], speed = glm::dot(u, w);
      tension += d * speed;
      to.damping[s] += speed * along;
      of_r += d * along / length * (w - speed * u);
      add_vector(plan_, *to_v, j, d * along * u);
      add_vector(plan_, *to_v, i, -d * along * u);
    }
    // at zero length, a spring without rest length acts alike in all directions
    of_r += (length > 0.0 ? tension / length : k) * (q - along * u);
    add_vector(plan_, to_x, j, of_r);
    add_vector(plan_, to_x, i, -of_r);
    to.stiffness[s] += extension * along;
    to.rest_length[s] -= k * along;
    to.inverse_mass[i] += tension * glm::dot(u, a1);
    to.inverse_mass[j] -= tension * glm::dot(u, a2);
  }
  for (const auto& [i, load] : plan_.force_data.load) to.inverse_mass[i] += glm::dot(load, vector_at(plan_, of_a, i));
}

// Like decay_dashpots, but keeps the difference of the velocities of each spring before it acts.
void StepAdjoint::sweep(SweepDirection direction, const Field& x, Field& v, std::vector<Vec3>& before) const {
  for (const auto& [i, j, s] : direction == SweepDirection::Forward ? links_ : reversed_) {
    const Vec3 a = difference_at(plan_, x, j, i), w = before[s] = difference_at(plan_, v, j, i);
    const double square = glm::dot(a, a);
    if (square < min_dashpot_length_squared) continue;
    const Vec3 impulse = decay_[s] / square * glm::dot(a, w) * a;
    add_vector(plan_, v, i, -plan_.inverse_mass[i] * impulse);
    add_vector(plan_, v, j, plan_.inverse_mass[j] * impulse);
  }
}

// v1 -= b a / m1, v2 += b a / m2, b = decay (a.w) / |a|^2, a = x1 - x2, w = v1 - v2
void StepAdjoint::pass_sweep(SweepDirection direction, const Field& x, const std::vector<Vec3>& before, Adjoint& to) const {
  for (const auto& [i, j, s] : direction == SweepDirection::Forward ? reversed_ : links_) {
    const Vec3 a = difference_at(plan_, x, j, i), w = before[s];
    const double square = glm::dot(a, a), along = glm::dot(a, w);
    if (square < min_dashpot_length_squared) continue;
    const Vec3 v1 = vector_at(plan_, to.v, i), v2 = vector_at(plan_, to.v, j);
    const Vec3 of_impulse = plan_.inverse_mass[j] * v2 - plan_.inverse_mass[i] * v1;
    const double g = decay_[s] / square, b = g * along, of_b = glm::dot(a, of_impulse);
    to.decay[s] += of_b * along / square;
    to.inverse_mass[i] -= b * glm::dot(a, v1);
    to.inverse_mass[j] += b * glm::dot(a, v2);
    const Vec3 of_w = g * of_b * a, of_a = b * of_impulse + g * of_b * (w - 2.0 * along / square * a);
    add_vector(plan_, to.v, i, of_w);
    add_vector(plan_, to.v, j, -of_w);
    add_vector(plan_, to.x, i, of_a);
    add_vector(plan_, to.x, j, -of_a);
  }
}

// methods/velocity_verlet.cpp. Without dashpots the velocities are not needed: everything is linear in them.
void StepAdjoint::pass_verlet(const Field& x, const Field& v, const Field& next_x, Adjoint& to) {
  Field &w = fields_[0], &a = fields_[1];
  const auto [decay, weight] = kick_over(plan_.drag, 0.5 * h_);
  if (plan_.has_dashpots()) {
    w = v;
    sweep(SweepDirection::Forward, x, w, first_);
    for (const Field* at : {&x, &next_x}) {
      compute_position_forces(plan_, 0.0, *at, w, a);
      divide_by_mass(plan_, a);
      set_sum(decay, w, weight, a, w);
    }
    sweep(SweepDirection::Backward, next_x, w, last_);
    pass_sweep(SweepDirection::Backward, next_x, last_, to);
  }
  for (const Field* at : {&next_x, &x}) {
    set_sum(weight, to.v, 0.0, to.v, a);
    set_sum(decay, to.v, 0.0, to.v, to.v);
    pass_acceleration(*at, nullptr, a, to, to.x, nullptr);
    if (at == &next_x) set_sum(1.0, to.v, h_, to.x, to.v);
  }
  if (plan_.has_dashpots()) pass_sweep(SweepDirection::Forward, x, first_, to);
}

// methods/runge_kutta4.cpp, with the slopes (V, A) of the stages.
void StepAdjoint::pass_runge_kutta4(const Field& x, const Field& v, const Field&, Adjoint& to) {
  constexpr std::array node{0.0, 0.5, 0.5, 1.0}, weight{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  const std::span<Field, 4> stage_x(&fields_[0], 4), stage_v(&fields_[4], 4);
  Field &a = fields_[8], &of_slope_x = fields_[9], &of_slope_v = fields_[10], &of_x = fields_[11], &of_v = fields_[12];
  for (std::size_t i = 0; i < 4; ++i) {
    set_sum(1.0, x, h_ * node[i], i == 0 ? v : stage_v[i - 1], stage_x[i]);
    set_sum(1.0, v, h_ * node[i], i == 0 ? v : a, stage_v[i]);
    if (i < 3) compute_accelerations(plan_, 0.0, stage_x[i], stage_v[i], a);
  }
  const Field end_x = to.x, end_v = to.v;
  for (std::size_t i = 4; i-- > 0;) {
    const double next = i < 3 ? h_ * node[i + 1] : 0.0;
    set_sum(h_ * weight[i], end_x, next, of_x, of_slope_x);
    set_sum(h_ * weight[i], end_v, next, of_v, of_slope_v);
    std::ranges::fill(of_x, 0.0);
    set_sum(1.0, of_slope_x, -plan_.drag, of_slope_v, of_v);
    pass_acceleration(stage_x[i], &stage_v[i], of_slope_v, to, of_x, &of_v);
    set_sum(1.0, to.x, 1.0, of_x, to.x);
    set_sum(1.0, to.v, 1.0, of_v, to.v);
  }
}

// decay = (1 - e^-z) / m, z = d h/2 m, m = 1/m1 + 1/m2
void StepAdjoint::finish(Adjoint& to) const {
  if (!plan_.has_dashpots()) return;
  const double half = 0.5 * h_;
  for (const auto& [i, j, s] : links_) {
    const double m = plan_.inverse_mass[i] + plan_.inverse_mass[j], d = plan_.spring.damping[s], z = d * half * m;
    if (m == 0.0) continue;
    to.damping[s] += to.decay[s] * half * portable::exp(-z);
    // (e^-z (1 + z) - 1) / z^2, by its series where it loses digits
    const double ratio = z < 1e-3 ? -0.5 + z * (1.0 / 3.0 - z / 8.0) : (portable::expm1(-z) + z * portable::exp(-z)) / (z * z);
    const double of_m = to.decay[s] * ratio * d * d * half * half;
    to.inverse_mass[i] += of_m;
    to.inverse_mass[j] += of_m;
  }
}

}  // namespace hooke
