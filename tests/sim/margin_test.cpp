// The margin below the linear stability limit that nets far from equilibrium need.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/divergence.h"
#include "sim/integrators/rows.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// Whether the mean energy of the third second exceeds that of the first by 20 % of the initial energy, or the run diverges.
bool gains_energy(const Integrator& method, std::uint64_t seed, double margin) {
  TestSim sim = rotating_net(seed);
  initialize_ledger(sim.system, sim.state);
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
  return last - first > 0.2 * sim.state.ledger.scale;
}

int count_gains(const Integrator& method, int nets, double margin) {
  int count = 0;
  for (int seed = 0; seed < nets; ++seed) count += gains_energy(method, static_cast<std::uint64_t>(seed), margin) ? 1 : 0;
  return count;
}

TEST(Margin, NoRandomNetGainsEnergyAtTheRecommendedStep) {
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet, &blanes_moan4})
    EXPECT_EQ(count_gains(*method, 120, recommended_margin), 0) << method->id;
}

TEST(Margin, ManyRandomNetsGainEnergyAtTheLinearLimitItself) {
  for (const Integrator* method : {&symplectic_euler, &velocity_verlet}) EXPECT_GT(count_gains(*method, 120, 1.0), 30) << method->id;
}

}  // namespace
}  // namespace hooke
