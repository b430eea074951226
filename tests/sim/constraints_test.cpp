// The sweep of XPBD over springs as constraints: color by color as the formula says, to the last bit at every vector width.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "sim/forces/constraints.h"
#include "sim/methods/integrator.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double step = 0.01, phi = 0.009;

struct ConstrainedSpring {
  Index packed, first, second, color = 0;
};

std::vector<ConstrainedSpring> constrained_springs(const Plan& plan) {
  std::vector<ConstrainedSpring> springs;
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) springs.push_back({run.begin + e, run.first + e, run.second + e});
  std::stable_sort(springs.begin(), springs.end(), [](const auto& a, const auto& b) { return a.second - a.first < b.second - b.first; });
  return springs;
}

// The first color that no earlier spring of either end has; springs of grids have had theirs before.
std::vector<ConstrainedSpring> greedy_colors(const Plan& plan, const std::map<Index, Index>& color_of_packed) {
  std::vector<ConstrainedSpring> springs = constrained_springs(plan);
  std::vector<std::set<Index>> used(plan.points);
  const auto take = [&](ConstrainedSpring& spring, Index color) {
    spring.color = color;
    used[spring.first].insert(color);
    used[spring.second].insert(color);
  };
  for (ConstrainedSpring& spring : springs)
    if (const auto known = color_of_packed.find(spring.packed); known != color_of_packed.end()) take(spring, known->second);
  for (ConstrainedSpring& spring : springs) {
    if (color_of_packed.contains(spring.packed)) continue;
    Index color = 0;
    while (used[spring.first].contains(color) || used[spring.second].contains(color)) ++color;
    take(spring, color);
  }
  std::stable_sort(springs.begin(), springs.end(), [](const auto& a, const auto& b) { return a.color < b.color; });
  return springs;
}

// Of a net of n x n points: along rows, then down to the left, down, and down to the right, each from even columns or rows first.
std::map<Index, Index> grid_colors(const Plan& plan, Index n) {
  std::map<Index, Index> color_of_packed;
  for (const ConstrainedSpring& spring : constrained_springs(plan)) {
    const Index offset = spring.second - spring.first, row = spring.first / n, column = spring.first % n;
    if (offset == 1) color_of_packed[spring.packed] = column % 2;
    for (const Index direction : {-1, 0, 1})
      if (offset == n + direction) color_of_packed[spring.packed] = 2 * (direction + 2) + row % 2;
  }
  return color_of_packed;
}

Field plain_velocities_after(const Plan& plan, const Motion& motion, const std::vector<ConstrainedSpring>& order) {
  const Field& x = motion.x;
  Field v = motion.v;
  for (const ConstrainedSpring& spring : order) {
    const double k = plan.spring.stiffness[spring.packed], d = plan.has_dashpots() ? plan.spring.damping[spring.packed] : 0.0;
    const double w1 = plan.inverse_mass[spring.first], w2 = plan.inverse_mass[spring.second];
    const double factor = phi / (1.0 + phi * (step * k + d) * (w1 + w2));
    double along[3], length_squared = 0.0, approach = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const Index i = c * plan.points + spring.first, j = c * plan.points + spring.second;
      along[c] = x[i] - x[j] + step * (v[i] - v[j]);
      length_squared += along[c] * along[c];
      approach += along[c] * (v[i] - v[j]);
    }
    if (length_squared == 0.0) continue;
    const double length = std::sqrt(length_squared);
    const double tension = factor * k * (length - plan.spring.rest_length[spring.packed]) + factor * d * approach / length;
    for (int c = 0; c < plan.dimensions; ++c) {
      v[c * plan.points + spring.first] -= w1 * (tension / length) * along[c];
      v[c * plan.points + spring.second] += w2 * (tension / length) * along[c];
    }
  }
  return v;
}

Field velocities_after_sweep(const Plan& plan, const Motion& motion) {
  Constraints constraints(plan);
  constraints.prepare(plan, step, phi);
  Field v = motion.v;
  constraints.sweep(plan, step, motion.x, v);
  return v;
}

void expect_equal_on_every_target(const TestSim& sim, Index grid_columns = 0) {
  const Plan plan = make_plan(sim.system);
  EXPECT_EQ(plan.spring.grids.size(), grid_columns > 0 ? 1u : 0u);
  Motion motion;
  pack(plan, sim.state, motion);
  const auto order = greedy_colors(plan, grid_columns > 0 ? grid_colors(plan, grid_columns) : std::map<Index, Index>{});
  const Field expected = plain_velocities_after(plan, motion, order);
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    EXPECT_EQ(velocities_after_sweep(plan, motion), expected)
        << hwy::TargetName(target) << ", " << plan.points << " points, " << plan.springs << " springs";
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TestSim moving_cloth(int n, double damping) {
  TestSim sim = curtain(n, 100.0, damping);
  Random random(3);
  for (std::size_t i = 0; i < sim.state.velocity.size(); ++i)
    if (!sim.system.points()[i].nailed)
      sim.state.velocity[i] = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  return sim;
}

TEST(Constraints, AreSolvedColorByColorOnEveryVectorTarget) {
  for (const int dimensions : {2, 3})
    for (std::uint64_t seed = 0; seed < 10; ++seed)
      expect_equal_on_every_target(random_sim(seed, 30, 90, dimensions, seed % 2 ? 20.0 : 0.0));
  // some springs longer than a block of points
  expect_equal_on_every_target(random_sim(1, 900, 1500, 3, 20.0));
  for (const int n : {4, 5, 8}) expect_equal_on_every_target(moving_cloth(n, 0.1));
}

TEST(Constraints, OfGridsAreSolvedDirectionByDirectionOnEveryVectorTarget) {
  for (const int n : {12, 16, 17, 33, 40}) {
    expect_equal_on_every_target(moving_cloth(n, 0.0), n);
    expect_equal_on_every_target(moving_cloth(n, 0.1), n);
  }
}

TEST(Constraints, OfGridsWithHolesAndOtherSprings) {
  TestSim sim = moving_cloth(33, 0.1);
  std::vector<Spring> springs;
  for (std::size_t s = 0; s < sim.system.springs().size(); ++s)
    if (s % 7 != 3 && s % 101 != 5) springs.push_back(sim.system.springs()[s]);
  sim.system.set_springs(std::move(springs));
  expect_equal_on_every_target(sim, 33);
  for (Index i = 0; i < 200; ++i) sim.join(sim.system.points()[3 * i].id, sim.system.points()[5 * i + 70].id, 3.0, 0.3);
  expect_equal_on_every_target(sim, 33);
}

// ends at the same place have no direction
TEST(Constraints, BetweenCoincidentPointsDoNothing) {
  TestSim sim = moving_cloth(20, 0.1);
  for (Index i = 100; i < 105; ++i) {
    sim.state.position[i + 1] = sim.state.position[i];
    sim.state.velocity[i + 1] = sim.state.velocity[i];
  }
  expect_equal_on_every_target(sim, 20);
}

// so that the vectors of a run give the same result as one by one
TEST(Constraints, OfARunShareNoPoint) {
  for (const TestSim& sim : {moving_cloth(33, 0.1), random_sim(1, 900, 1500, 3, 20.0), random_sim(2, 30, 90)}) {
    const Plan plan = make_plan(sim.system);
    std::set<Index> visited;
    std::set<std::size_t> places;
    const Constraints constraints(plan);
    for (const SweepRun& run : constraints.runs()) {
      std::set<Index> ends;
      for (Index n = 0; n < run.count; ++n) {
        const Index packed = run.begin + n * run.step, first = run.first + n * run.step, second = run.second + n * run.step;
        EXPECT_TRUE(visited.insert(packed).second);
        EXPECT_TRUE(places.insert(run.place(n)).second);
        EXPECT_TRUE(ends.insert(first).second);
        EXPECT_TRUE(ends.insert(second).second);
      }
    }
    EXPECT_EQ(static_cast<Index>(visited.size()), plan.springs);
  }
}

// A stretched net, pushed sideways, after 15 frames: the errors are those of the greedy order of all springs, 0.0692 and 0.00776 m. All
// directions of even rows before those of odd rows have 0.0913 and 0.00928 m.
TEST(Constraints, OfGridsHaveTheErrorsOfTheGreedyOrder) {
  constexpr int n = 32, frames = 15;
  TestSim start = cloth(n);
  for (Index i = 0; i < start.system.point_count(); ++i) {
    const Index row = i / n, column = i % n;
    start.system.point(i).nailed = row == 0 || column == 0 || row == n - 1 || column == n - 1;
    const Vec3& x = start.state.position[i];
    if (!start.system.points()[i].nailed)
      start.state.velocity[i] = {0.1 * std::sin(9.0 * x.y), 0.1 * std::cos(7.0 * x.x), 0.1 * std::sin(5.0 * x.x)};
  }
  const auto after = [&](std::string_view method, int steps_per_frame) {
    TestSim sim = start;
    sim.run(*find_integrator(method), frames / 60.0, frames * steps_per_frame);
    return sim.state;
  };
  const State exact = after("velocity_verlet", 500);
  const auto error = [&](int steps_per_frame) {
    const State state = after("xpbd", steps_per_frame);
    double sum = 0.0;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
      const Vec3 distance = state.position[i] - exact.position[i];
      sum += distance.x * distance.x + distance.y * distance.y + distance.z * distance.z;
    }
    return std::sqrt(sum / static_cast<double>(state.position.size()));
  };
  EXPECT_NEAR(error(5), 0.0692, 0.0035);
  EXPECT_NEAR(error(20), 0.00776, 0.0004);
}

TEST(Constraints, ConserveMomentum) {
  TestSim sim = moving_cloth(40, 0.1);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  const Field after = velocities_after_sweep(plan, motion);
  double max_change = 0.0;
  for (int c = 0; c < 3; ++c) {
    double before_sum = 0.0, after_sum = 0.0, scale = 0.0;
    for (Index i = 0; i < plan.points; ++i) {
      before_sum += plan.mass[i] * motion.v[c * plan.points + i];
      after_sum += plan.mass[i] * after[c * plan.points + i];
      scale += plan.mass[i] * std::abs(after[c * plan.points + i]);
      max_change = std::max(max_change, std::abs(after[c * plan.points + i] - motion.v[c * plan.points + i]));
    }
    EXPECT_NEAR(after_sum, before_sum, 1e-14 * scale) << "component " << c;
  }
  EXPECT_GT(max_change, 0.01);
}

}  // namespace
}  // namespace hooke
