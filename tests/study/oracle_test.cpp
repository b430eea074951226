// Hooke's methods against SUNDIALS, which shares neither the forces nor the formulas nor the equation solver with them. Both get the same
// tolerance, and their difference converges with it.
#include "study/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

#include "formats/scene_file.h"
#include "study/analytic_scenes.h"
#include "support/nets.h"

namespace hooke {
namespace {

TestSim start_of(const std::string& scene) {
  if (scene == "rope_64" || scene == "drum_32") {
    const Scene shipped = load_scene(find_scene(scene)).scene;
    return {shipped.system, shipped.state};
  }
  const InitialState start = make_net(16, 1e4, scene == "net_W4d" ? 0.9 : 1e3);
  return {start.system, start.state};
}

// The steps of a non-adaptive method are halved until the sum of its estimated errors is within the tolerance.
State follow(const Integrator& method, const TestSim& start, double seconds, double tolerance) {
  Plan plan = make_plan(start.system);
  Frame frame;
  for (int steps = method.stability == Stability::Adaptive ? 1 : 16;; steps *= 2) {
    State state = start.state;
    frame.begin(plan, start.system, {.integrator = &method, .frame_rate = 1.0 / seconds, .substeps = steps, .tolerance = tolerance}, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
    if (method.stability == Stability::Adaptive || frame.motion().local_error <= tolerance) return state;
  }
}

struct Case {
  const char* scene;
  Oracle oracle;
  const char* method;
  double seconds;
};

std::string name_of(const testing::TestParamInfo<Case>& info) {
  const auto [scene, oracle, method, seconds] = info.param;
  return std::string(scene) + (oracle == Oracle::Bdf ? "_bdf_" : oracle == Oracle::Explicit ? "_erk_" : "_dirk_") + method;
}

void PrintTo(const Case& which, std::ostream* out) { *out << which.seconds << " s of " << which.scene << " by " << which.method; }

class OracleTest : public testing::TestWithParam<Case> {};

// The two nets have 16 x 16 points and k = 1e4 N/m: W4d with d = 0.9 N s/m, WE with 1e3, whose dashpots would require 3e5 steps per second
// of explicit methods. The rope and the drum vibrate undamped: the local errors of some thousand steps accumulate, for which a factor of a
// hundred is allowed.
INSTANTIATE_TEST_SUITE_P(Scenes, OracleTest,
                         testing::Values(Case{"net_W4d", Oracle::Bdf, "dop853", 0.25}, Case{"net_W4d", Oracle::Explicit, "dop853", 0.25},
                                         Case{"net_WE", Oracle::Bdf, "dop853", 0.03}, Case{"net_WE", Oracle::Bdf, "esdirk4", 0.1},
                                         Case{"net_WE", Oracle::Implicit, "tr_bdf2", 0.1}, Case{"rope_64", Oracle::Bdf, "dop853", 0.25},
                                         Case{"rope_64", Oracle::Explicit, "dop853", 0.25}, Case{"drum_32", Oracle::Bdf, "dop853", 0.06},
                                         Case{"drum_32", Oracle::Explicit, "dop853", 0.06}),
                         name_of);

TEST_P(OracleTest, AgreesWithinTheCommonTolerance) {
  const auto [scene, oracle, id, seconds] = GetParam();
  const TestSim start = start_of(scene);
  const auto gap = [&, oracle = oracle, id = id, seconds = seconds](double tolerance) {
    return distance(ask_oracle(oracle, start.system, start.state, seconds, tolerance),
                    follow(*find_integrator(id), start, seconds, tolerance));
  };
  const double loose = gap(1e-6), tight = gap(1e-8);
  EXPECT_LT(loose, 100.0 * 1e-6);
  EXPECT_LT(tight, 100.0 * 1e-8);
  // stability may require smaller steps than any tolerance here: then the difference is round-off and does not converge
  EXPECT_LT(tight, std::max(0.1 * loose, 1e-11));

  // check that there is motion to compare
  EXPECT_GT(distance(follow(*find_integrator(id), start, seconds, 1e-6), start.state), 1e-3);
}

}  // namespace
}  // namespace hooke
