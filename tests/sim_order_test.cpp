// What the table of methods declares, measured: orders on a swinging net, limits of stability, symplecticity.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "convergence.h"
#include "nets.h"

namespace hooke {
namespace {

class Row : public EveryMethod {
 protected:
  // Steps for a quarter of a second of the net: below the limit of stability where there is one, and within the range of
  // the order.
  int steps(double order) const {
    if (method().stability == Stability::Absolute || method().stability == Stability::Stiff)
      return order < 1.5 ? 100 : order < 2.5 ? 40 : 60;
    return order < 1.5 ? 1000 : order < 2.5 ? 250 : order < 4.5 ? 120 : 26;
  }

  State after(const Trial& start, int count) const {
    Trial trial = start;
    trial.run(method(), 0.25, count);
    return trial.state;
  }

  // How the change falls when the step is halved, in positions and velocities: a method may be better in one of them.
  void expect_measured(const Trial& start, int order) const {
    const State coarse = after(start, steps(order)), middle = after(start, 2 * steps(order)), fine = after(start, 4 * steps(order));
    const double first = change(coarse, middle), second = change(middle, fine);
    EXPECT_NEAR(std::log2(first / second), order, std::max(0.15, 0.06 * order)) << "changes " << first << " and " << second;
  }

  static double change(const State& first, const State& second) {
    double sum = 0.0;
    for (std::size_t i = 0; i < first.position.size(); ++i) {
      const Vec3 dx = first.position[i] - second.position[i], dv = 0.1 * (first.velocity[i] - second.velocity[i]);
      sum += glm::dot(dx, dx) + glm::dot(dv, dv);
    }
    return std::sqrt(sum);
  }
};
// One sweep over constraints is in the range of its order only at steps far shorter than these; it has its own test.
std::vector<const Integrator*> measured_methods() {
  std::vector<const Integrator*> methods = every_method();
  std::erase_if(methods, [](const Integrator* row) { return row->id == "xpbd"; });
  return methods;
}
INSTANTIATE_TEST_SUITE_P(Methods, Row, testing::ValuesIn(measured_methods()), method_name);

// net W2 of the accuracy tables: 16 x 16 points, k = 100 N/m, swinging in tension
TEST_P(Row, MeetsItsOrder) { expect_measured(net(16, 1e2, 0.0), method().order); }

TEST_P(Row, MeetsItsOrderWithDashpots) { expect_measured(net(16, 1e2, 0.03), method().order_damped); }

TEST_P(Row, MeetsItsOrderWithDrag) {
  Trial trial = net(16, 1e2, 0.0);
  trial.system.drag = 3.0;
  expect_measured(trial, method().order_drag);
}

TEST_P(Row, MeetsItsOrderWithDashpotsAndDrag) {
  Trial trial = net(16, 1e2, 0.03);
  trial.system.drag = 3.0;
  expect_measured(trial, std::min(method().order_damped, method().order_drag));
}

// The modulus of the greater eigenvalue of one step: what a mode grows by.
double growth(const Integrator& method, const Oscillator& oscillator) {
  const auto [trace, determinant] = method.amplification(oscillator);
  const double discriminant = 0.25 * trace * trace - determinant;
  return discriminant < 0.0 ? std::sqrt(determinant) : 0.5 * std::abs(trace) + std::sqrt(discriminant);
}

// x'' = -w^2 x - lambda x' - c x', a spring without rest length on a nail: how much longer (x, v / w) is after `count` steps.
double growth_after(const Integrator& method, double omega, double lambda, double drag, double h, int count) {
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  trial.system.drag = drag;
  const PointId point = trial.add({1.0, 0.0, 0.0});
  trial.join(point, trial.nail(Vec3(0.0)), omega * omega, 0.0, lambda);
  trial.run(method, h * count, count);
  return std::hypot(trial.position(point).x, trial.velocity(point).x / omega);
}

// just below the limit the motion stays bounded, just above it grows; what is stated for a whole scene is not above it
TEST_P(Row, HoldsUpToItsLimitAndNotBeyond) {
  if (method().stability != Stability::Conditional && method().stability != Stability::None) return;
  const double omega = 20.0;
  for (const double lambda : {0.0, 5.0, 30.0, 300.0})
    for (const double drag : {0.0, 4.0}) {
      SCOPED_TRACE(testing::Message() << "lambda = " << lambda << ", c = " << drag);
      const auto growth_at = [&](double h) { return growth(method(), {h * h * omega * omega, h * lambda, h * drag}); };
      double limit = 1e-5;
      while (growth_at(limit) <= 1.0 + 1e-12 && limit < 10.0) limit *= 1.0001;

      const Spectrum spectrum{.omega = omega, .dashpot_rate = lambda, .drag_rate = drag, .least_dashpot_ratio = lambda / (omega * omega)};
      const double stated = largest_stable_step(method(), spectrum);
      EXPECT_LE(stated, limit * 1.001);
      if (limit > 1e-5) {
        EXPECT_LT(growth_after(method(), omega, lambda, drag, 0.995 * limit, 5000), 50.0);
        if (lambda == 0.0) {
          EXPECT_NEAR(stated, limit, 1e-3 * limit);
        }
      }

      // some methods hold again a little beyond: where it grows most nearby
      double beyond = std::max(limit, 1e-3);
      for (double h = beyond; h < 1.02 * std::max(limit, 1e-3); h *= 1.0001)
        if (growth_at(h) > growth_at(beyond)) beyond = h;
      const int count = std::min(20000, static_cast<int>(std::log(1e6) / std::log(growth_at(beyond))) + 1);
      EXPECT_GT(growth_after(method(), omega, lambda, drag, beyond, count), 0.01 * std::pow(growth_at(beyond), count)) << count << " steps";
    }
}

// the determinant of an undamped step is 1 just if the method is symplectic
TEST_P(Row, KeepsAreasJustIfItIsSymplectic) {
  const double determinant = method().amplification({.h_omega_squared = 1.44}).determinant;
  if (method().symplectic) {
    EXPECT_NEAR(determinant, 1.0, 1e-14);
  } else {
    EXPECT_GT(std::abs(determinant - 1.0), 1e-7);
  }
}

}  // namespace
}  // namespace hooke
