// The margin below the linear stability limit that nets far from equilibrium need. With HOOKE_PRINT set, the tables of
// docs/reference/methods.md are printed, from more nets.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// Whether the mean energy of the third second exceeds that of the first by 20 % of the initial energy, or the run diverges.
bool gains_energy(const Integrator& method, TestSim sim, double margin) {
  initialize_supply(sim.system, sim.state);
  Plan plan = make_plan(sim.system);
  const double step = largest_stable_step(method, plan.spectrum) / margin;
  // exactly this step, in frames of about 1/60 s
  const int substeps = std::max(1, static_cast<int>(std::ceil(1.0 / (60.0 * step))));
  const Settings settings{.integrator = &method, .frame_rate = 1.0 / (step * substeps), .substeps = substeps};
  double first = 0.0, last = 0.0;
  Frame frame;
  constexpr int seconds = 3, frames = 60;
  for (int i = 0; i < seconds * frames; ++i) {
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    const Energy energy = compute_energy(sim.system, sim.state);
    if (find_divergence(sim.system, sim.state, energy)) return true;
    if (i < frames) first += energy.total() / frames;
    if (i >= (seconds - 1) * frames) last += energy.total() / frames;
  }
  return last - first > 0.2 * sim.state.supply.scale;
}

using MakeNet = TestSim (*)(std::uint64_t seed);

int count_gains(const Integrator& method, MakeNet make_net, int nets, double margin) {
  int count = 0;
  for (int seed = 0; seed < nets; ++seed) count += gains_energy(method, make_net(static_cast<std::uint64_t>(seed)), margin) ? 1 : 0;
  return count;
}

bool prints() { return std::getenv("HOOKE_PRINT") != nullptr; }

void print_gains(MakeNet make_net, int nets, std::initializer_list<double> margins) {
  if (!prints()) return;
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet, &blanes_moan4}) {
    std::printf("%s:", std::string(method->id).c_str());
    for (const double margin : margins) std::printf(" %d of %d at %g,", count_gains(*method, make_net, nets, margin), nets, margin);
    std::printf("\n");
    std::fflush(stdout);
  }
}

TEST(Margin, NoRandomNetGainsEnergyAtTheRecommendedStep) {
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet, &blanes_moan4})
    EXPECT_EQ(count_gains(*method, rotating_net, 120, default_margin), 0) << method->id;
  print_gains(rotating_net, 120, {1.0, 1.5, 2.0, 3.0, 4.0});
}

TEST(Margin, ManyRandomNetsGainEnergyAtTheLinearLimitItself) {
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet})
    EXPECT_GT(count_gains(*method, rotating_net, 120, 1.0), 30) << method->id;
}

TEST(Margin, IsLargerWhereSpringsPassThroughZeroLength) {
  const std::uint64_t nets = prints() ? 2000 : 60;
  std::uint64_t collapsing = 0, others = 0;
  for (std::uint64_t seed = 0; seed < nets; ++seed) {
    const TestSim sim = collapsing_net(seed);
    collapsing += recommended_margin(sim.system, sim.state) == collapse_margin ? 1 : 0;
    const TestSim rotating = rotating_net(seed);
    others += recommended_margin(rotating.system, rotating.state) == collapse_margin ? 1 : 0;
  }
  if (prints())
    std::printf("%d of %d nets can collapse, and %d of the others\n", static_cast<int>(collapsing), static_cast<int>(nets),
                static_cast<int>(others));
  print_gains(collapsing_net, static_cast<int>(nets), {4.0, 8.0, 16.0});
  EXPECT_GT(collapsing, nets / 2);
  EXPECT_LT(others, nets / 10);
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet}) {
    EXPECT_GT(count_gains(*method, collapsing_net, 60, default_margin), 0) << method->id;
    EXPECT_EQ(count_gains(*method, collapsing_net, 60, collapse_margin), 0) << method->id;
  }
}

// two masses of 1 kg at 2 m on a spring of 1 m, at rest or with a relative speed of w l0
TEST(Margin, ASpringCollapsesFromTwiceItsLengthOrFromTheSpeedThatCorresponds) {
  for (const double fraction : {0.99, 1.01}) {
    TestSim stretched, moving;
    stretched.join(stretched.add(Vec3(0.0)), stretched.add({1.0 + fraction, 0.0, 0.0}), 50.0, 1.0);
    moving.join(moving.add(Vec3(0.0)), moving.add({1.0, 0.0, 0.0}, 1.0, {10.0 * fraction, 0.0, 0.0}), 50.0, 1.0);
    for (const TestSim& sim : {stretched, moving}) EXPECT_EQ(can_collapse(sim.system, sim.state), fraction > 1.0);
  }
}

}  // namespace
}  // namespace hooke
