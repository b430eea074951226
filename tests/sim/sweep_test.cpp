// The sweeps over dashpots: spring by spring as the formula says, to the last bit at every vector width; the backward sweep undoes the
// forward one.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>

#include "sim/forces/dashpots/dashpot.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

struct Swept {
  Plan plan;
  Motion motion;
  std::vector<double> decay;
  Swept(const TestSim& sim, double duration) : plan(make_plan(sim.system)) {
    pack(plan, sim.state, motion);
    plan_dashpot_decay(plan, duration, decay);
  }
  Field velocities_after(SweepDirection sweep) const {
    Field v = motion.v;
    decay_dashpots(plan, decay, sweep, motion.x, v);
    return v;
  }
};

// Packed springs with their ends, in the order of a forward sweep.
struct SweptSpring {
  Index index, first, second;
};
std::vector<SweptSpring> swept_springs(const Plan& plan) {
  std::vector<SweptSpring> result;
  for (const SpringRun& run : plan.spring.runs) {
    const Index step = run.second == run.first + 1 ? 2 : 1;  // in a run along a row, every other spring first
    for (Index start = 0; start < step; ++start)
      for (Index e = start; e < run.count; e += step) result.push_back({run.begin + e, run.first + e, run.second + e});
  }
  return result;
}

// `order` is that of the forward sweep.
Field plain_velocities_after(const Swept& swept, SweepDirection sweep, std::vector<SweptSpring> order) {
  const Plan& plan = swept.plan;
  const Field& x = swept.motion.x;
  Field v = swept.motion.v;
  if (sweep == SweepDirection::Backward) std::reverse(order.begin(), order.end());
  for (const SweptSpring& spring : order) {
    double length_squared = 0.0, approach = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const Index i = c * plan.points + spring.first, j = c * plan.points + spring.second;
      length_squared += (x[i] - x[j]) * (x[i] - x[j]);
      approach += (x[i] - x[j]) * (v[i] - v[j]);
    }
    if (length_squared == 0.0) continue;
    const double p = swept.decay[spring.index] / length_squared * approach;
    for (int c = 0; c < plan.dimensions; ++c) {
      const Index i = c * plan.points + spring.first, j = c * plan.points + spring.second;
      const double along = x[i] - x[j];
      v[i] -= plan.inverse_mass[spring.first] * p * along;
      v[j] += plan.inverse_mass[spring.second] * p * along;
    }
  }
  return v;
}

Field plain_velocities_after(const Swept& swept, SweepDirection sweep) {
  return plain_velocities_after(swept, sweep, swept_springs(swept.plan));
}

// `count` springs, each from point i to point i + `stride`: one run. Some points are nailed, some ends coincide.
TestSim band(Index stride, Index count, int dimensions) {
  TestSim sim = random_sim(100 * static_cast<std::uint64_t>(stride) + static_cast<std::uint64_t>(count), count + stride, 0, dimensions);
  Random random(5);
  for (Index e = 0; e < count; ++e) {
    if (random.one_in(7)) sim.state.position[e + stride] = sim.state.position[e];
    sim.join(sim.system.points()[e].id, sim.system.points()[e + stride].id, 1.0, 1.0, random.uniform(0.0, 20.0));
  }
  return sim;
}

// runs shorter and longer than any vector, at strides below, at and above the number of lanes, and any graph
std::vector<TestSim> assorted_nets() {
  std::vector<TestSim> sims;
  for (const int dimensions : {2, 3}) {
    for (Index stride = 1; stride <= 10; ++stride)
      for (const Index count : {1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 30, 33, 70}) sims.push_back(band(stride, count, dimensions));
    for (std::uint64_t seed = 0; seed < 10; ++seed) sims.push_back(random_sim(seed, 30, 90, dimensions, 20.0));
  }
  for (const int n : {2, 3, 5, 9, 16, 33}) {
    sims.push_back(curtain(n, 1.0, 0.9));
    for (Vec3& velocity : sims.back().state.velocity) velocity = velocity.z * Vec3(1.0, -2.0, 3.0);
  }
  return sims;
}

constexpr double duration = 0.05;

TEST(DashpotSweep, EqualsAPlainLoopBitForBitOnEveryVectorTarget) {
  const std::vector<TestSim> sims = assorted_nets();
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    for (const TestSim& sim : sims) {
      const Swept swept(sim, duration);
      for (const SweepDirection sweep : {SweepDirection::Forward, SweepDirection::Backward})
        EXPECT_EQ(swept.velocities_after(sweep), plain_velocities_after(swept, sweep))
            << hwy::TargetName(target) << ", " << swept.plan.points << " points, " << swept.plan.springs << " springs, "
            << (sweep == SweepDirection::Forward ? "forward" : "backward");
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

// over a negative duration; round-off grows by the factor of the damping
TEST(DashpotSweep, BackwardUndoesForward) {
  for (const TestSim& sim : assorted_nets()) {
    Swept swept(sim, 1e-4);
    const Field start = swept.motion.v;
    swept.motion.v = swept.velocities_after(SweepDirection::Forward);
    plan_dashpot_decay(swept.plan, -1e-4, swept.decay);
    const Field back = swept.velocities_after(SweepDirection::Backward), astray = swept.velocities_after(SweepDirection::Forward);
    double error = 0.0, without = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      error = std::max(error, std::abs(back[i] - start[i]));
      without = std::max(without, std::abs(astray[i] - start[i]));
    }
    EXPECT_LT(error, 1e-12) << swept.plan.points << " points, " << swept.plan.springs << " springs";
    if (swept.plan.springs > 70) {
      EXPECT_GT(without, 1e-9);
    }
  }
}

TEST(DashpotSweep, OfAlmostCoincidentPointsIsFinite) {
  for (const double distance : {0.0, 1e-300, 1e-160, 1e-150, 1e-139, 1e-100, 1e-12}) {
    TestSim sim;
    const PointId first = sim.add(Vec3(0.0), 1e3, {1.0, 0.0, 2.0}), second = sim.add({distance, 0.0, 0.0}, 1e3);
    sim.join(first, second, 1.0, 1.0, 1e9);
    const Field v = Swept(sim, 1.0).velocities_after(SweepDirection::Forward);
    // moving as one body along the spring or, if it is too short to have a direction, as if there were no dashpot
    const double expected = distance < 1e-140 ? 1.0 : 0.5;
    EXPECT_NEAR(v[0], expected, 1e-15) << "distance " << distance;
    EXPECT_NEAR(v[1], 1.0 - expected, 1e-15) << "distance " << distance;
    EXPECT_EQ(v[4], 2.0);
  }
}

}  // namespace
}  // namespace hooke
