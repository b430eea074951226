// The method `auto` where springs break: it keeps the tolerance or reports that it does not.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "support/accuracy_scenes.h"
#include "support/automatic_runs.h"
#include "support/convergence.h"

namespace hooke {
namespace {

// A net that flies into the sky at 10 m/s from the nails of its upper row, until it tears.
TestSim net_torn_off() {
  TestSim sim = net(6, 2e3, 0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i)
    if (!sim.system.points()[i].nailed) sim.state.velocity[i] = {0.5 * i / 36.0, -10.0, 0.1 * (i % 5)};
  sim.system.break_strain = 0.12;
  return sim;
}

// A rope that is level and slack in the middle, from which a heavy weight falls, until it snaps.
TestSim rope_snapped_by_weight() {
  TestSim sim;
  constexpr int links = 16;
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i <= links; ++i) {
    const PointId next = sim.add({0.05 * i, -0.02 * i, 0.003 * (i % 3)}, i == links ? 2.0 : 0.01);
    sim.join(last, next, 5e3, 0.054);
    last = next;
  }
  sim.system.break_strain = 0.1;
  return sim;
}

// A ball of eight times the mass of the net hits it.
TestSim net_hit_by_ball() {
  TestSim sim = net(6, 2e3, 0.05);
  sim.system.gravity = Vec3(0.0);
  for (Vec3& v : sim.state.velocity) v = Vec3(0.0);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = i < 6 || i >= 30 || i % 6 == 0 || i % 6 == 5;
  const PointId ball = sim.add({0.52, -0.55, -0.21}, 8.0, {0.0, 0.0, 12.0});
  sim.system.point(sim.system.index_of(ball)).radius = 0.16;
  for (Index i = 0; i < 36; ++i) sim.system.point(i).radius = 0.02;
  sim.system.contact = {.points = true, .restitution = 0.2};
  sim.system.break_strain = 0.3;
  return sim;
}

// A cloth nailed at two corners whose opposite side is pulled away by heavy points.
TestSim cloth_pulled_apart() {
  TestSim sim = cloth(7);
  for (Index i = 42; i < 49; ++i) {
    sim.system.point(i).mass = 0.3 + 0.05 * (i - 42);
    sim.state.velocity[i] = {0.3 * (i - 45), -6.0, 0.5};
  }
  sim.system.break_strain = 0.25;
  return sim;
}

void remove_broken(System& system, std::span<const Index> broken) {
  std::vector<Spring> springs = system.springs();
  for (auto s = broken.rbegin(); s != broken.rend(); ++s) springs.erase(springs.begin() + *s);
  system.set_springs(std::move(springs));
}

struct BreakingRun {
  int frames = 0, with_breaks = 0, within = 0, silent = 0;  // silent: beyond the tolerance, and reported as within
  int broken = 0, reported = 0;
  int explained = 0;                // frames in which springs break whose explanation says so
  double worst = 0.0;               // [1], of the silent frames, relative to the tolerance
  double max_cost = 0.0, cost = 0;  // [ms], by the model, with the trials, of a frame and of all
};

// Frame by frame against the frame from the same state in much shorter steps of two methods. Their distance is the error of the reference,
// within which nothing is judged.
BreakingRun run_until_broken(TestSim sim, double tolerance, int frames, int substeps) {
  const Settings settings = automatic(tolerance);
  const Settings exact{.integrator = find_integrator("velocity_verlet"), .substeps = substeps};
  const Settings other{.integrator = find_integrator("runge_kutta4"), .substeps = substeps + substeps / 3};
  Plan plan = make_plan(sim.system);
  Frame frame, exact_frame;
  BreakingRun run;
  for (; run.frames < frames; ++run.frames) {
    const double before = frame.trial_cost();
    const State after = next_frame(plan, frame, sim.system, settings, sim.state);
    const double cost = frame.cost(plan) + frame.trial_cost() - before;
    Plan exact_plan = plan;
    const State truth = next_frame(exact_plan, exact_frame, sim.system, exact, sim.state);
    const State check = next_frame(exact_plan, exact_frame, sim.system, other, sim.state);
    const double allowed = tolerance / settings.frame_rate, error = distance(after, truth) - distance(truth, check);
    const bool is_reported = !is_tolerance_met(*after.memory.choice, settings);
    run.within += error <= allowed ? 1 : 0;
    run.reported += is_reported ? 1 : 0;
    if (error > allowed && !is_reported) {
      ++run.silent;
      run.worst = std::max(run.worst, error / allowed);
    }
    run.max_cost = std::max(run.max_cost, cost);
    run.cost += cost;
    run.broken += static_cast<int>(frame.broken().size());
    run.with_breaks += frame.broken().empty() ? 0 : 1;
    const bool is_explained = describe(*after.memory.choice, settings).find("springs") != std::string::npos;
    run.explained += !frame.broken().empty() && is_explained ? 1 : 0;
    sim.state = after;
    if (frame.broken().empty()) continue;
    remove_broken(sim.system, frame.broken());
    plan = make_plan(sim.system);
  }
  return run;
}

struct BreakingScene {
  const char* name;
  TestSim (*make)();
};

class AutomaticBreaking : public testing::TestWithParam<BreakingScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, AutomaticBreaking,
                         testing::Values(BreakingScene{"net_torn_off", net_torn_off}, BreakingScene{"rope_snapped", rope_snapped_by_weight},
                                         BreakingScene{"net_hit_by_ball", net_hit_by_ball},
                                         BreakingScene{"cloth_pulled", cloth_pulled_apart}),
                         [](const auto& scene) { return std::string(scene.param.name); });

TEST_P(AutomaticBreaking, KeepsTheToleranceOrReportsAtABoundedCost) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  for (const double tolerance : {1e-2, 1e-3}) {
    const BreakingRun run = run_until_broken(GetParam().make(), tolerance, prints ? 60 : 24, prints ? 20000 : 6000);
    if (prints)
      std::printf(
          "%-16s %g: %d springs break in %d frames; %d of %d frames within, %d reported as beyond, %d beyond in silence (%.2g); "
          "a frame costs up to %.3g ms, all %.3g ms\n",
          GetParam().name, tolerance, run.broken, run.with_breaks, run.within, run.frames, run.reported, run.silent, run.worst,
          run.max_cost, run.cost);
    EXPECT_GE(run.with_breaks, 1) << tolerance;
    EXPECT_EQ(run.silent, 0) << tolerance;
    EXPECT_EQ(run.explained, run.with_breaks) << tolerance;
  }
}

}  // namespace
}  // namespace hooke
