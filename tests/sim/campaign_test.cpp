// Random scenes with every kind of force, grab and collider under all methods: a run either stays bounded or is reported.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/random_force_scene.h"

namespace hooke {
namespace {

class Campaign : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Campaign, testing::ValuesIn(every_method()), method_name);

// one second at 300 steps per second, which is far too few for some scenes
TEST_P(Campaign, NoRunFailsSilently) {
  constexpr double far = 1e4;  // [m], for scenes of 2 m whose forces do not drive points away indefinitely
  constexpr std::uint64_t scenes = 200;
  int reported = 0;
  for (std::uint64_t seed = 0; seed < scenes; ++seed) {
    TestSim sim = random_force_scene(seed, ForceSceneKind::Any);
    initialize_supply(sim.system, sim.state);
    Plan plan = make_plan(sim.system);
    const Settings settings{.integrator = &method(), .substeps = 5};
    Frame frame;
    bool is_reported = false;
    for (int i = 0; i < 60 && !is_reported; ++i) {
      frame.begin(plan, sim.system, settings, sim.state);
      while (!frame.done()) frame.substep(plan);
      frame.end(plan, sim.state);
      is_reported = find_divergence(sim.system, sim.state, compute_energy(sim.system, sim.state), frame.failure()).has_value();
    }
    reported += is_reported ? 1 : 0;
    if (is_reported || !std::isfinite(plausible_reach(sim.system, plan.spectrum, 1.0, 1.0, 1.0))) continue;
    for (const Vec3& x : sim.state.position) ASSERT_LT(glm::length(x), far) << "scene " << seed;
  }
  if (method().is_implicit()) {
    EXPECT_LT(reported, static_cast<int>(scenes) / 50);
  }
}

}  // namespace
}  // namespace hooke
