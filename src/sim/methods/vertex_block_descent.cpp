// Implicit Euler by descending from point to point     (A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, Vertex Block Descent, SIGGRAPH 2024)
//   M (V - v0) = phi f(x + h V, V),   v0 = E v + phi a_ext(x, v);   for every point, all others held:
//   V_i <- V_i - (m I + phi (h K + D))^-1 (m (V_i - v0_i) - phi f_i);   at the end v' = V,  x' = x + h V,
// E = e^(-c h), phi = (1 - E) / c (h when c = 0), f the springs, dashpots and the hand, a_ext gravity and the listed forces, K and D the
// blocks of stiffness.h with clamped curvature. Points of one color share no spring: their order, and a thread for each, make no
// difference. V starts from E v + phi s a_ext; s = 0..1 is the part of a_ext that is not supported, from the forces at x. (In the paper it
// is from the velocities of the step before, on which a state does not depend.) From the third sweep on, Chebyshev's acceleration (H. Wang,
// SIGGRAPH Asia 2015) with the largest contraction of the sweeps so far as the spectral radius, in place of a number to be tuned; where
// sweeps cease to contract, it ends. With fixed radii of 0.9 and 0.98, nets diverge.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <span>
#include <vector>

#include "sim/forces/field_kernel.h"
#include "sim/forces/forces.h"
#include "sim/forces/kick.h"
#include "sim/forces/spring_laws.h"
#include "sim/methods/linear_spring.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

// The springs of every point, and an order of the points: those of one color share no spring.
class PointColors final : public Structure {
 public:
  explicit PointColors(const Plan& plan);

  struct Spring {
    Index other, packed;
  };
  std::span<const Spring> springs_of(Index point) const {
    return std::span(springs_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
  }
  const std::vector<Index>& order() const { return order_; }

 private:
  std::vector<Index> begin_, order_;
  std::vector<Spring> springs_;
};

PointColors::PointColors(const Plan& plan) : Structure(plan), begin_(plan.points + 1, 0), order_(plan.points) {
  const auto for_each = [&](const auto& use) {
    for_each_spring(plan, [&](Index i, Index j, Index s) {
      use(i, Spring{j, s});
      use(j, Spring{i, s});
    });
  };
  for_each([&](Index point, const Spring&) { ++begin_[point + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  springs_.resize(begin_.back());
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for_each([&](Index point, const Spring& spring) { springs_[next[point]++] = spring; });

  // greedily, in the order of the points
  std::vector<Index> color(plan.points, no_index), used_by(1, no_index);
  for (Index i = 0; i < plan.points; ++i) {
    for (const auto& [other, packed] : springs_of(i)) {
      if (color[other] == no_index) continue;
      if (used_by.size() <= static_cast<std::size_t>(color[other])) used_by.resize(color[other] + 1, no_index);
      used_by[color[other]] = i;
    }
    color[i] = static_cast<Index>(std::ranges::find_if(used_by, [&](Index user) { return user != i; }) - used_by.begin());
    if (static_cast<std::size_t>(color[i]) == used_by.size()) used_by.push_back(no_index);
  }
  std::iota(order_.begin(), order_.end(), Index{0});
  std::ranges::stable_sort(order_, {}, [&](Index i) { return color[i]; });
}

// What the descent of a step works on.
struct Descent {
  const Plan& plan;
  double time, h, phi;
  const Field& target;  // v0
  Field& x;             // x + h V
  Field& v;             // V
};

// Adds the hand's part of the force on a point, and of its derivative.
void add_hand(const Descent& step, Index i, Vec3& force, glm::dmat3& stiffness) {
  const PlannedPull& hand = *step.plan.hand.pull;
  for (const auto& [point, weight] : hand.points()) {
    if (point != i) continue;
    force -= hand.stiffness * weight * pull_stretch(step.plan, step.x, step.time);
    stiffness += glm::dmat3(hand.stiffness * weight * weight);
  }
}

void descend(const Descent& step, const PointColors& colors, Index i) {
  const Plan& plan = step.plan;
  const Vec3 x = vector_at(plan, step.x, i), v = vector_at(plan, step.v, i);
  Vec3 force(0.0);
  glm::dmat3 matrix(0.0);  // K + D / h
  for (const auto& [other, packed] : colors.springs_of(i)) {
    const Vec3 along = x - vector_at(plan, step.x, other);
    const double length = glm::length(along);
    const auto [of, damping] = response_of(plan, packed, step.time, length);
    if (length == 0.0) {
      matrix += glm::dmat3(of.stiffness);
      continue;
    }
    const Vec3 u = along / length;
    const double tension = of.tension + damping * glm::dot(u, v - vector_at(plan, step.v, other));
    const double transverse = std::max(0.0, tension / length);
    force -= tension * u;
    matrix += (of.stiffness + damping / step.h - transverse) * glm::outerProduct(u, u) + glm::dmat3(transverse);
  }
  if (plan.hand.pull) add_hand(step, i, force, matrix);

  const Vec3 residual = plan.mass[i] * (v - vector_at(plan, step.target, i)) - step.phi * force;
  matrix = glm::dmat3(plan.mass[i]) + step.phi * step.h * matrix;
  for (int c = 0; c < plan.dimensions; ++c) matrix[c][c] += fixed_mass(plan, i, c);
  const Vec3 change = free_part(plan, i, -(glm::inverse(matrix) * residual));
  add_vector(plan, step.v, i, change);
  add_vector(plan, step.x, i, step.h * change);
}

void sweep(const Descent& step, const PointColors& colors) {
  for (const Index i : colors.order())
    if (step.plan.inverse_mass[i] != 0.0) descend(step, colors, i);
}

void prepare(const Plan& plan, double, const Motion& motion, Workspace& work) {
  work.size_fields(4, motion);
  make_structure<PointColors>(plan, work);
}

// v0 in `target`; the velocity becomes E v + phi s a_ext.
void predict(const Plan& plan, Motion& motion, double h, Field& target, Field& f) {
  compute_external_forces(plan, motion.time, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  motion.acceleration_is_current = false;
  compute_position_forces(plan, motion.time, motion.x, motion.v, f);
  divide_by_mass(plan, f);
  ++motion.counts.force_evaluations;

  const auto [decay, phi] = kick_over(plan.drag, h);
  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 external = vector_at(plan, motion.a, i);
    const double squared = glm::dot(external, external);
    const double part = squared > 0.0 ? std::clamp(glm::dot(vector_at(plan, f, i), external) / squared, 0.0, 1.0) : 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const std::size_t at = static_cast<std::size_t>(c) * plan.points + i;
      if (plan.inverse_mass[i] != 0.0) motion.v[at] *= decay;
      target[at] = motion.v[at] + phi * external[c];
      motion.v[at] += part * phi * external[c];
    }
  }
}

// Chebyshev's acceleration of a sequence of velocities.
class Acceleration {
 public:
  // V is the result of sweep n = 0, 1, ... from `last`, and `before` the velocities before that sweep. Returns whether V was changed.
  bool apply(int n, const Field& before, const Field& last, Field& V) {
    double change = 0.0;
    for (std::size_t at = 0; at < V.size(); ++at) change += (V[at] - last[at]) * (V[at] - last[at]);
    const double contraction = n > 0 ? std::sqrt(change / change_before_) : 0.0;
    change_before_ = change;
    is_on_ = is_on_ && contraction < 1.0;
    radius_ = std::max(radius_, std::min(contraction, max_spectral_radius));
    if (n < 2 || !is_on_) return false;
    omega_ = n == 2 ? 2.0 / (2.0 - radius_ * radius_) : 4.0 / (4.0 - radius_ * radius_ * omega_);
    for (std::size_t at = 0; at < V.size(); ++at) V[at] = omega_ * (V[at] - before[at]) + before[at];
    return true;
  }

 private:
  bool is_on_ = true;
  double change_before_ = 0.0, radius_ = 0.0, omega_ = 1.0;
};

void step(const Plan& plan, Motion& motion, Workspace& work, double h) {
  Field &target = work.fields[0], &x = work.fields[1], &before = work.fields[2], &last = work.fields[3];
  predict(plan, motion, h, target, x);
  const auto set_positions = [&] {
    std::ranges::copy(motion.x, x.begin());
    add_scaled(x.data(), h, motion.v.data(), x.size());
  };
  set_positions();

  const Descent descent{plan, motion.time + h, h, kick_over(plan.drag, h).weight, target, x, motion.v};
  Acceleration acceleration;
  for (int n = 0; n < work.iterations; ++n) {
    before.swap(last);
    std::ranges::copy(motion.v, last.begin());
    sweep(descent, structure_of<PointColors>(work));
    ++motion.counts.sweeps;
    if (acceleration.apply(n, before, last, motion.v)) set_positions();
  }
  drift(motion, h);
}

}  // namespace

constinit const Integrator vertex_block_descent{
    .id = "vertex_block_descent",
    .label = "Vertex block descent",
    .summary = "Implicit Euler by a few sweeps over the points, for comparison: bounded at large steps, too soft where sweeps are few.",
    .cost = "for each iteration, one sweep over the points per step",
    .formula =
        "V = E v + phi s a_ext,   E = e^(-c h), phi = (1 - E) / c, s = 0..1,   v0 = E v + phi a_ext\n"
        "for every point:  V_i = V_i - (m I + phi (h K + D))^-1 (m (V_i - v0_i) - phi f_i(x + h V, V))\n"
        "from the third sweep on:  V = omega (V - V_before) + V_before\n"
        "v' = V,  x' = x + h V",
    .source = "A. H. Chen, Z. Liu, Y. Yang, C. Yuksel, Vertex Block Descent, ACM Trans. Graph. 43 (2024) 116",
    .order = 1,
    .order_with = {.drag = 1, .damped = 1, .contact = 1, .force_terms = 1},
    .stability = Stability::EachSpring,
    .energy = EnergyTrend::Falls,
    .implicit_solve = ImplicitSolve::Repeated,
    .for_production = false,
    .velocity_lag = 0.5,
    .prepare = prepare,
    .step = step,
    .amplification = amplification_of_linear_spring,
};

}  // namespace hooke
