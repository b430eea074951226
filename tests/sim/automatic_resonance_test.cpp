// The method `auto` uses blanes_moan4 beyond its resonance, where modes in resonance grow slowly, and keeps them small.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/forces/energy/energy.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/rows.h"
#include "sim/step/automatic/resonance.h"
#include "support/automatic_runs.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// Logarithm of the growth of a mode in a step, of the larger eigenvalue of z^2 - trace z + determinant.
double growth_at(double h_omega, double h_drag) {
  const Amplification step = blanes_moan4.amplification({.h_omega_squared = h_omega * h_omega, .h_drag = h_drag});
  const double discriminant = 0.25 * step.trace * step.trace - step.determinant;
  return discriminant < 0.0 ? 0.5 * std::log(step.determinant) : std::log(0.5 * std::abs(step.trace) + std::sqrt(discriminant));
}

TEST(AutomaticResonance, IsAsNarrowAndAsSlowAsAssumed) {
  double max = 0.0;
  for (const double h_drag : {0.0, 1e-4, 1e-3, 1e-2, 0.1, 1.0})
    for (double h_omega = 0.1; h_omega < 4.97; h_omega += 1e-4) {
      const bool is_in_resonance = h_omega > 3.163 && h_omega < 3.1693;
      const double growth = growth_at(h_omega, h_drag);
      EXPECT_LT(growth, is_in_resonance ? 0.0024 : 1e-9) << h_omega << ", drag " << h_drag;
      max = std::max(max, growth);
    }
  EXPECT_GT(max, 0.0023);
}

// Vibrations along three springs: of the fastest mode that 20 substeps are used for; of one that is then in resonance, displaced by
// `displacement`; and of a slow one with a large amplitude.
constexpr double fastest = 4.97 * 20.0 * 60.0 * (1.0 - 1e-9), resonant = 3.166 / 4.97 * fastest;  // [rad/s]

TestSim modes_in_resonance(double displacement) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  PointId before{};
  double z = 0.0;
  for (const auto& [omega, amplitude] : {std::pair{fastest, 0.0}, {resonant, displacement}, {0.1 * fastest, 0.1}}) {
    const PointId nail = sim.nail({0.0, 0.0, z}), point = sim.add({1.0 + amplitude, 0.0, z});
    sim.join(nail, point, omega * omega, 1.0);
    if (z > 0.0) sim.join(before, nail, 0.0, 1.0);  // one part
    before = nail;
    z += 1.0;
  }
  return sim;
}

double amplitude_of_resonance(const State& state) { return std::hypot(state.position[3].x - 1.0, state.velocity[3].x / resonant); }

TEST(AutomaticResonance, WouldAmplifyRoundingErrorsWithoutControl) {
  TestSim sim = modes_in_resonance(1e-10);
  Plan plan = make_plan(sim.system);
  Frame frame;
  for (int i = 0; i < 600; ++i) sim.state = next_frame(plan, frame, sim.system, {.integrator = &blanes_moan4, .substeps = 20}, sim.state);
  EXPECT_GT(amplitude_of_resonance(sim.state), 0.1);
}

TEST(AutomaticResonance, IsNoticedWhileItsModesAreSmall) {
  constexpr double tolerance = 1e-3;
  TestSim sim = modes_in_resonance(1e-10);
  Plan plan = make_plan(sim.system);
  Frame frame;
  const double energy = compute_energy(sim.system, sim.state).total();
  int beyond = 0;
  for (int i = 0; i < 1800; ++i) {
    sim.state = next_frame(plan, frame, sim.system, automatic(tolerance), sim.state);
    const MethodChoice& choice = *sim.state.memory.choice;
    beyond += choice.method == &blanes_moan4 && choice.substeps < 31 ? 1 : 0;
    ASSERT_TRUE(is_tolerance_met(choice, automatic(tolerance))) << i;
    ASSERT_LT(amplitude_of_resonance(sim.state), tolerance) << i;
  }
  EXPECT_GT(beyond, 900);
  EXPECT_NEAR(compute_energy(sim.system, sim.state).total(), energy, 2e-3 * energy);
}

TEST(AutomaticResonance, IsLeftAloneWhereItMayDoHarm) {
  const TestSim net = modes_in_resonance(0.0);
  const auto is_allowed = [](const TestSim& sim, double target = 1e-9) {
    return may_step_beyond_resonance(make_plan(sim.system), target, 1.0);
  };
  EXPECT_TRUE(is_allowed(net));
  EXPECT_FALSE(is_allowed(net, 1e-2));
  TestSim damped = net, touching = net, attracted = net, breaking = net, limited = net;
  damped.system.spring(0)->damping = 0.1;
  touching.system.colliders.push_back({.shape = Plane{}});
  attracted.system.forces.push_back({&force_terms()[0], true, default_values(force_terms()[0])});
  breaking.system.break_strain = 0.5;
  limited.system.strain_limit = 0.1;
  for (const TestSim* sim : {&damped, &touching, &attracted, &breaking, &limited}) EXPECT_FALSE(is_allowed(*sim));
}

TEST(AutomaticResonance, AllowsFewerSubstepsOfOneMethodAndAsksForMoreEstimates) {
  const Spectrum spectrum{.omega = fastest};
  constexpr int stable = 32;
  EXPECT_EQ(substeps_beyond_resonance(blanes_moan4, spectrum, 60.0, 1.0, stable), 20);
  EXPECT_EQ(substeps_beyond_resonance(velocity_verlet, spectrum, 60.0, 1.0, stable), stable);
  EXPECT_EQ(substeps_beyond_resonance(blanes_moan4, {.omega = 10.0 * fastest}, 60.0, 1.0, 320), 320);
  EXPECT_EQ(max_frames_in_resonance(blanes_moan4, spectrum, 60.0, 1.0, 20), 41);
  EXPECT_EQ(max_frames_in_resonance(blanes_moan4, spectrum, 60.0, 1.0, stable), std::numeric_limits<int>::max());
  // every mode that is in resonance has grown by e^2 at most until the next estimate
  EXPECT_LE(41 * 20 * 0.0024, 2.0);
}

}  // namespace
}  // namespace hooke
