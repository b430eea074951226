// Projective dynamics and vertex block descent beside other methods, on the scenes of docs/evidence/accuracy.md. HOOKE_PRINT=1 prints the
// table of that page.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "sim/methods/rows.h"
#include "sim/methods/step_limits.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

constexpr double seconds = 0.5, frame_rate = 60.0;

struct Setting {
  const Integrator* method;
  int substeps, iterations = 1;
};

struct Outcome {
  State state;
  double cpu_ms = 0.0;
};

Outcome run(const TestSim& start, const Setting& setting) {
  TestSim sim = start;
  Plan plan = make_plan(sim.system);
  Frame frame;
  const std::clock_t from = std::clock();
  for (int n = 0; n < static_cast<int>(seconds * frame_rate); ++n) {
    const Settings settings{
        .integrator = setting.method, .frame_rate = frame_rate, .substeps = setting.substeps, .iterations = setting.iterations};
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
  }
  return {sim.state, 1e3 * static_cast<double>(std::clock() - from) / CLOCKS_PER_SEC};
}

// 200 links of 1 m in all and 1 kg, the last a thousand times as heavy as the others, swinging from a nail.
TestSim heavy_chain() {
  TestSim sim;
  constexpr int links = 200;
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= links; ++i) {
    const double s = static_cast<double>(i) / links, mass = (i == links ? 1000.0 : 1.0) / links;
    const PointId next = sim.add({0.0, -s, 0.0}, mass, {0.5 * s, 0.0, 0.0});
    sim.join(last, next, 1e6, 1.0 / links);
    last = next;
  }
  return sim;
}

// A horizontal sheet that falls, from two nailed corners, or onto a ball.
TestSim sheet_falling(bool onto_ball) {
  TestSim sim = curtain(16, 1e3, 0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i) {
    const Vec3 at = sim.state.position[i];
    sim.state.position[i] = {at.x, 0.02 * std::sin(3.0 * at.x), at.y};
    sim.state.velocity[i] = Vec3(0.0);
    sim.system.point(i).nailed = !onto_ball && (i == 0 || i == 15);
  }
  if (onto_ball)
    sim.system.colliders = {{.shape = Sphere{.center = {0.5, -0.35, -0.5}, .radius = 0.3}, .restitution = 0.0, .friction = 0.3}};
  return sim;
}

struct Case {
  const char* title;
  TestSim sim;
};
std::vector<Case> cases() {
  return {{"k = 1e2", net(16, 1e2, 0.0)},          {"k = 1e4", net(16, 1e4, 0.0)},     {"k = 1e6", net(16, 1e6, 0.0)},
          {"d = 1e3", net(16, 1e4, 1e3)},          {"mass ratio 1000", heavy_chain()}, {"falling sheet", sheet_falling(false)},
          {"sheet on a ball", sheet_falling(true)}};
}

State exact(const TestSim& sim) {
  const int limit = StepLimits(bound_spectrum(sim.system)).stable_substeps(velocity_verlet, frame_rate).value();
  return run(sim, {&velocity_verlet, std::max(4 * limit, 200)}).state;
}

std::vector<Setting> settings() {
  std::vector<Setting> all{{&xpbd, 4},          {&xpbd, 20},          {&xpbd, 80},         {&baraff_witkin, 1},
                           {&baraff_witkin, 4}, {&implicit_euler, 1}, {&implicit_euler, 4}};
  for (const Integrator* method : {&projective_dynamics, &vertex_block_descent})
    for (const auto& [substeps, iterations] : {std::pair{1, 10}, {1, 50}, {4, 10}, {20, 2}}) all.push_back({method, substeps, iterations});
  return all;
}

TEST(IteratingMethods, AreSolversOfImplicitEulerWithItsErrorAtBest) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  for (const Case& each : cases()) {
    const State reference = exact(each.sim);
    const auto error = [&](const Setting& setting) { return distance(run(each.sim, setting).state, reference); };
    const double implicit = error({&implicit_euler, 4});
    for (const Integrator* method : {&projective_dynamics, &vertex_block_descent}) {
      EXPECT_GT(error({method, 4, 10}), 0.7 * implicit) << each.title << ", " << method->id;
      EXPECT_LT(error({method, 4, 10}), 1.0) << each.title << ", " << method->id;
    }
    if (!prints) continue;
    const double unit = run(each.sim, {&xpbd, 20}).cpu_ms;
    const int explicit_steps = StepLimits(bound_spectrum(each.sim.system)).stable_substeps(velocity_verlet, frame_rate).value();
    std::vector<Setting> all = settings();
    all.insert(all.begin(), {&velocity_verlet, explicit_steps});
    for (const Setting& setting : all) {
      const Outcome outcome = run(each.sim, setting);
      std::printf("%-16s %-20s %4d x %2d  error %.1e  cost %.2g\n", each.title, std::string(setting.method->id).c_str(), setting.substeps,
                  setting.iterations, distance(outcome.state, reference), outcome.cpu_ms / unit);
    }
  }
}

// the weight of the last link reaches the first one in one solve, but not in ten sweeps
TEST(IteratingMethods, DifferWhereForcesMustPassThroughAChain) {
  const TestSim sim = heavy_chain();
  const State reference = exact(sim);
  const auto error = [&](const Integrator& method) { return distance(run(sim, {&method, 1, 10}).state, reference); };
  EXPECT_LT(error(projective_dynamics), 0.1 * error(vertex_block_descent));
}

}  // namespace
}  // namespace hooke
