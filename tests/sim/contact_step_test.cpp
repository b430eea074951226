// Step limits due to contact. Contact acts at the end of a step, on each point separately.

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/energy.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double radius = 0.35;  // [m], of the ball

// A sheet of 16 x 16 points, 1 m, 0.2 kg, falling onto a ball.
TestSim falling_sheet(double k) {
  constexpr int n = 16;
  constexpr double a = 1.0 / (n - 1);
  TestSim sim;
  std::vector<PointId> points;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) points.push_back(sim.add({column * a - 0.48, radius + 0.1, row * a - 0.47}, 0.2 / (n * n)));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const PointId here = points[row * n + column];
      if (column + 1 < n) sim.join(here, points[row * n + column + 1], k, a);
      if (row + 1 < n) sim.join(here, points[(row + 1) * n + column], k, a);
    }
  sim.system.colliders.push_back({.shape = Sphere{Vec3(0.0), radius}, .restitution = 0.1, .friction = 0.4});
  return sim;
}

// The largest rise of the energy above an earlier value within one second, relative to the weight times the size of the sheet [1].
double energy_rise(TestSim sim, const Integrator& method, double step) {
  double lowest = compute_energy(sim.system, sim.state).total(), rise = 0.0;
  const double floor = reference_energy(sim.system, sim.state);
  for (double time = 0.0; time < 1.0 && rise < 1e3; time += step) {
    sim.run(method, step, 1);
    const double energy = compute_energy(sim.system, sim.state).total();
    rise = std::isfinite(energy) ? std::max(rise, (energy - lowest) / floor) : 1e9;
    lowest = std::min(lowest, energy);
  }
  return rise;
}

const Integrator& method(const char* id) { return *find_integrator(id); }

TEST(ContactStep, IsLimitedEvenForUnconditionallyStableMethods) {
  const Spectrum with_contact = bound_spectrum(falling_sheet(60.0).system);
  Spectrum without_contact = with_contact;
  without_contact.contact = false;
  for (const char* id : {"dop853", "xpbd", "implicit_euler", "baraff_witkin", "implicit_midpoint", "tr_bdf2", "esdirk4"}) {
    EXPECT_TRUE(std::isinf(largest_stable_step(method(id), without_contact))) << id;
    EXPECT_EQ(largest_stable_step(method(id), with_contact), 3.0 / with_contact.omega) << id;
  }

  // colliders that are only drawn, or scenes without oscillation
  TestSim sim = falling_sheet(60.0);
  sim.system.colliders[0].solid = false;
  EXPECT_TRUE(std::isinf(largest_stable_step(method("tr_bdf2"), bound_spectrum(sim.system))));
  EXPECT_TRUE(std::isinf(largest_stable_step(method("tr_bdf2"), bound_spectrum(falling_sheet(0.0).system))));
}

TEST(ContactStep, EnergyDoesNotGrowWithinTheLimitAndGrowsFarBeyondIt) {
  const TestSim sim = falling_sheet(60.0);
  for (const char* id : {"dop853", "xpbd", "implicit_euler", "baraff_witkin", "tr_bdf2", "esdirk4"}) {
    const double limit = largest_stable_step(method(id), bound_spectrum(sim.system));
    EXPECT_LT(energy_rise(sim, method(id), limit), 0.01) << id;
  }
  const double limit = largest_stable_step(method("tr_bdf2"), bound_spectrum(sim.system));
  EXPECT_GT(energy_rise(sim, method("tr_bdf2"), 8.0 * limit), 1.0);
}

}  // namespace
}  // namespace hooke
