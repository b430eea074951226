// Velocity Verlet with weak forces that depend on velocity, evaluated once per step: order, error, work, and where they are evaluated
// twice.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "sim/forces/field_kernel.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/next_frame.h"

namespace hooke {
namespace {

constexpr double wind_frame_rate = 60.0;
constexpr ForceValues breeze{2.0, 1.0, -3.0, 0.6, 0.1, 0.0, 1.0, 1.0}, storm{12.0, 5.0, -20.0, 1.2, 0.2, 0.0, 1.0, 1.0};

// A swinging net with faces in wind.
TestSim net_in_wind(double damping, const ForceValues& wind) {
  constexpr int n = 17;
  TestSim sim = net(n, 500.0, damping);
  const auto id = [&](int row, int column) { return sim.system.points()[sheet::at(n, row, column)].id; };
  for (int row = 0; row + 1 < n; ++row)
    for (int column = 0; column + 1 < n; ++column) {
      sim.system.faces.push_back({{id(row, column), id(row + 1, column), id(row, column + 1)}});
      sim.system.faces.push_back({{id(row, column + 1), id(row + 1, column), id(row + 1, column + 1)}});
    }
  sim.system.forces = {{.term = &wind_force, .values = wind}};
  return sim;
}

struct WindRun {
  State state;
  long evaluations = 0, sweeps = 0;
  double work = 0.0;  // [J], of the wind
};

WindRun run_in_wind(const TestSim& start, int frames, const Settings& settings) {
  Plan plan = make_plan(start.system);
  Frame frame;
  WindRun result{.state = start.state};
  for (int i = 0; i < frames; ++i) {
    result.state = next_frame(plan, frame, start.system, settings, result.state);
    result.evaluations += frame.motion().counts.force_evaluations;
    result.sweeps += frame.motion().counts.dashpot_sweeps;
    result.work += frame.motion().energy.forces();
  }
  return result;
}

WindRun exact_run(const TestSim& start, int frames) { return run_in_wind(start, frames, {.integrator = &dop853, .tolerance = 1e-12}); }
WindRun verlet_run(const TestSim& start, int frames, int substeps) {
  return run_in_wind(start, frames, {.integrator = &velocity_verlet, .substeps = substeps});
}

TEST(WeakForces, AreEvaluatedOncePerStep) {
  for (const double damping : {0.0, 0.1}) {
    const WindRun swinging = verlet_run(net_in_wind(damping, breeze), 1, 40);
    // and once at the start of the frame
    EXPECT_EQ(swinging.evaluations, 41) << damping;
    EXPECT_EQ(swinging.sweeps, 0) << damping;
  }
}

TEST(WeakForces, KeepTheDeclaredOrder) {
  for (const double damping : {0.0, 0.1})
    for (const ForceValues& wind : {breeze, storm}) {
      TestSim sim = net_in_wind(damping, wind);
      for (const double drag : {0.0, 4.0}) {
        sim.system.drag = drag;
        const WindRun exact = exact_run(sim, 4);
        const auto error = [&](int substeps) { return distance(verlet_run(sim, 4, substeps).state, exact.state); };
        EXPECT_NEAR(measured_order(error, 60), velocity_verlet.order_with.force_terms, 0.1) << damping << ' ' << wind[0] << ' ' << drag;
      }
    }
}

// The state after 1/15 s of `count` steps, with two evaluations per step if the plan says that the wind is strong.
State state_after(const TestSim& start, int count, bool twice) {
  Plan plan = make_plan(start.system);
  if (twice) plan.spectrum.estimated_rate = 1e30;
  const double h = 4.0 / wind_frame_rate / count;
  Motion motion;
  Workspace work;
  pack(plan, start.state, motion);
  velocity_verlet.prepare(plan, h, motion, work);
  for (int i = 0; i < count; ++i, motion.time += h) velocity_verlet.step(plan, motion, work, h);
  EXPECT_EQ(motion.counts.force_evaluations > count + 1, twice);
  State state = start.state;
  unpack(plan, motion, state);
  return state;
}

TEST(WeakForces, AreAsAccurateAsTwoEvaluationsPerStep) {
  for (const ForceValues& wind : {breeze, storm}) {
    const TestSim start = net_in_wind(0.0, wind);
    const State exact = exact_run(start, 4).state;
    for (const int count : {120, 240, 960}) {
      const double once = distance(state_after(start, count, false), exact), twice = distance(state_after(start, count, true), exact);
      if (std::getenv("HOOKE_PRINT") != nullptr)
        std::printf("%g m/s, %d steps: %.3g m, two evaluations %.3g m\n", wind[0], count, once, twice);
      EXPECT_LT(once, 1.1 * twice) << wind[0] << ", " << count << " steps";
    }
  }
}

// What the balance of energy records as supplied by the wind. Its error is of the second order, like that of the motion.
TEST(WeakForces, SupplyTheWorkOfTheExactMotion) {
  for (const ForceValues& wind : {breeze, storm}) {
    const TestSim start = net_in_wind(0.0, wind);
    const double exact = exact_run(start, 4).work;
    const auto error = [&](int substeps) { return std::abs(verlet_run(start, 4, substeps).work - exact); };
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("%g m/s: %.6g J, error %.2g J with 60 substeps\n", wind[0], exact, error(60));
    EXPECT_LT(error(60), 2e-3 * std::abs(exact)) << wind[0];
    EXPECT_NEAR(measured_order(error, 60), 2.0, 0.2) << wind[0];
  }
}

TEST(WeakForces, AreEvaluatedTwiceWhereTheyAreStrongOrDashpotsAreSwept) {
  TestSim strong = net_in_wind(0.0, storm), swept = net_in_wind(0.5, breeze);
  for (Index i = 0; i < strong.system.point_count(); ++i) strong.system.point(i).mass *= 0.02;
  EXPECT_GE(verlet_run(strong, 1, 100).evaluations, 200);
  EXPECT_GE(verlet_run(swept, 1, 100).evaluations, 200);
}

TEST(WeakForces, ChangeVelocitiesAndAccelerationsToTheSameBitsForAnyWidth) {
  constexpr std::size_t size = 29;
  std::vector<double> before(size), after(size), mass(size), inverse(size), v(size), a(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double t = static_cast<double>(i);
    before[i] = std::sin(t), after[i] = std::cos(2.0 * t), mass[i] = 1.0 + 0.1 * t, v[i] = std::sin(3.0 * t), a[i] = std::cos(t);
    inverse[i] = i % 7 == 3 ? 0.0 : 1.0 / mass[i];
  }
  std::vector<double> expected_v = v, expected_a = a;
  std::array<double, partial_sums> expected{}, power{};
  for (std::size_t i = 0; i < size; ++i) {
    const double change = (after[i] - before[i]) * inverse[i];
    expected_v[i] += 0.01 * change;
    expected_a[i] += change;
    if (inverse[i] != 0.0) expected[i < size / 8 * 8 ? i % 8 : i - size / 8 * 8] += (after[i] - -9.81 * mass[i]) * expected_v[i];
  }
  change_forces(
      {.before = before.data(), .after = after.data(), .mass = mass.data(), .inverse_mass = inverse.data(), .weight = 0.01, .g = -9.81},
      v.data(), a.data(), power, size);
  EXPECT_EQ(v, expected_v);
  EXPECT_EQ(a, expected_a);
  EXPECT_EQ(power, expected);
}

}  // namespace
}  // namespace hooke
