// Grids in the graph, and their kernels: the same forces as spring by spring to rounding, the same bits for every vector unit.
#include "sim/plan/grid.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/forces/forces.h"
#include "sim/forces/grid_kernel.h"
#include "sim/forces/leapfrog_pass.h"
#include "sim/forces/spring_kernel.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// What is missing in a net of points in rows, or added to it.
struct Net {
  int rows, columns;
  int dimensions = 3;
  double max_damping = 0.0;
  bool uniform = false;     // one mass, and one stiffness and rest length for each direction
  int missing = 0;          // one spring of so many; 0: none
  bool extra = false;       // springs to the second next point, and to a point outside
  bool coincident = false;  // some points at the same place
};

TestSim make_net(const Net& net) {
  Random random(static_cast<std::uint64_t>(100 * net.rows + net.columns));
  const auto uniform = [&](double min, double max) { return random.uniform(min, max); };
  TestSim sim;
  sim.system.dimensions = net.dimensions;
  const double depth = net.dimensions == 3 ? 0.3 : 0.0;
  for (int r = 0; r < net.rows; ++r)
    for (int c = 0; c < net.columns; ++c) {
      const Vec3 away(uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-depth, depth));
      const Vec3 velocity(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-depth, depth));
      const bool coincides = net.coincident && c > 0 && random.one_in(6);
      sim.add(coincides ? sim.state.position.back() : Vec3(c, -r, 0.0) + away, net.uniform ? 0.5 : uniform(0.2, 2.0), velocity);
      if (random.one_in(9)) sim.system.point(r * net.columns + c).nailed = true;
    }
  const auto join = [&](int from, int to, int direction) {
    const bool is_missing = net.missing > 0 && random.one_in(net.missing);
    if (is_missing) return;
    const PointId first = sim.system.points()[from].id, second = sim.system.points()[to].id;
    const double k = net.uniform ? 10.0 + direction : uniform(1.0, 100.0),
                 rest_length = net.uniform ? 1.0 + 0.1 * direction : uniform(0.0, 2.0);
    sim.join(first, second, k, rest_length, uniform(0.0, net.max_damping));
  };
  for (int r = 0; r < net.rows; ++r)
    for (int c = 0; c < net.columns; ++c) {
      const int i = r * net.columns + c;
      if (c + 1 < net.columns) join(i, i + 1, 0);
      if (r + 1 < net.rows) join(i + net.columns, i, 1);
      if (r + 1 < net.rows && c + 1 < net.columns) join(i, i + net.columns + 1, 2);
      if (r + 1 < net.rows && c + 1 < net.columns) join(i + net.columns, i + 1, 3);
      if (net.extra && c + 2 < net.columns && random.one_in(3)) join(i, i + 2, 4);
    }
  if (net.extra) {
    sim.add({0.5, 2.0, 0.0});
    join(net.rows * net.columns, 1, 5);
  }
  return sim;
}

// rows and columns below, at and above the widths of vectors
std::vector<Net> assorted_nets() {
  std::vector<Net> nets;
  for (const int dimensions : {2, 3})
    for (const double damping : {0.0, 5.0})
      for (const int rows : {1, 2, 3, 5})
        for (const int columns : {4, 5, 7, 8, 9, 11, 15, 16, 17, 18, 24, 31, 33}) {
          if (rows == 1 && columns < 8) continue;
          const Net net{.rows = rows, .columns = columns, .dimensions = dimensions, .max_damping = damping};
          nets.push_back(net);
          for (const auto change : {&Net::uniform, &Net::extra, &Net::coincident}) {
            nets.push_back(net);
            nets.back().*change = true;
          }
          nets.push_back(net);
          if (rows > 3) nets.back().missing = 12;
        }
  return nets;
}

// With grids, however small the scene is.
Plan make_plan_with_grids(const System& system) {
  Plan plan = make_plan(system);
  plan.spring.grids = find_grids(plan.spring.runs, plan.points, plan.spring.loose_runs);
  refresh_grids(plan);
  return plan;
}

struct PackedGrid {
  Plan plan;
  Motion motion;
  explicit PackedGrid(const TestSim& sim) : plan(make_plan_with_grids(sim.system)) { pack(plan, sim.state, motion); }
  const double* velocities() const { return plan.has_dashpots() ? motion.v.data() : nullptr; }
  Field forces() const {
    Field f(motion.x.size(), 0.0);
    add_spring_forces(plan, motion.x.data(), velocities(), f.data());
    return f;
  }
};

// The same plan without grids.
Plan without_grids(Plan plan) {
  plan.spring.grids.clear();
  plan.spring.loose_runs = plan.spring.runs;
  return plan;
}

Index springs_in_grids(const Plan& plan) {
  Index count = 0;
  for (const Grid& grid : plan.spring.grids)
    for (const std::vector<Index>& spring : grid.spring)
      count += static_cast<Index>(std::ranges::count_if(spring, [](Index s) { return s != no_index; }));
  return count;
}

TEST(Grids, AreMadeForLargeScenesOnly) {
  EXPECT_TRUE(make_plan(make_net({.rows = 8, .columns = 8}).system).spring.grids.empty());
  EXPECT_EQ(make_plan(make_net({.rows = 10, .columns = 10}).system).spring.grids.size(), 1u);
}

TEST(Grids, AreFoundInNetsWithAllTheirSprings) {
  for (const int columns : {4, 9, 33}) {
    const Plan plan = make_plan_with_grids(make_net({.rows = 6, .columns = columns}).system);
    ASSERT_EQ(plan.spring.grids.size(), 1u);
    EXPECT_EQ(plan.spring.grids[0].rows, 6);
    EXPECT_EQ(plan.spring.grids[0].columns, columns);
    EXPECT_EQ(springs_in_grids(plan), plan.springs);
    EXPECT_TRUE(plan.spring.loose_runs.empty());
  }
}

TEST(Grids, KeepTheirShapeWhereSpringsAreMissing) {
  const Plan plan = make_plan_with_grids(make_net({.rows = 12, .columns = 20, .missing = 15}).system);
  ASSERT_EQ(plan.spring.grids.size(), 1u);
  EXPECT_EQ(plan.spring.grids[0].rows, 12);
  EXPECT_EQ(plan.spring.grids[0].columns, 20);
  EXPECT_EQ(springs_in_grids(plan), plan.springs);
}

TEST(Grids, LeaveOutSpringsThatDoNotFit) {
  const Plan plan = make_plan_with_grids(make_net({.rows = 6, .columns = 20, .extra = true}).system);
  ASSERT_EQ(plan.spring.grids.size(), 1u);
  Index loose = 0;
  for (const SpringRun& run : plan.spring.loose_runs) {
    loose += run.count;
    for (Index e = 0; e < run.count; ++e)
      for (const std::vector<Index>& spring : plan.spring.grids[0].spring) EXPECT_EQ(std::ranges::count(spring, run.begin + e), 0);
  }
  EXPECT_GT(loose, 10);
  EXPECT_EQ(loose + springs_in_grids(plan), plan.springs);
}

TEST(Grids, DoNotDependOnTheOrderOfTheSprings) {
  const TestSim sim = make_net({.rows = 7, .columns = 13, .missing = 20});
  TestSim reversed = sim;
  std::vector<Spring> springs = sim.system.springs();
  std::ranges::reverse(springs);
  for (Spring& spring : springs) std::swap(spring.first, spring.second);
  reversed.system.set_springs(springs);
  EXPECT_EQ(PackedGrid(sim).forces(), PackedGrid(reversed).forces());
}

TEST(Grids, StoreASingleRowOfNumbersIfAllRowsAreEqual) {
  const Grid uniform = make_plan_with_grids(make_net({.rows = 6, .columns = 9, .uniform = true}).system).spring.grids.at(0);
  const Grid varied = make_plan_with_grids(make_net({.rows = 6, .columns = 9}).system).spring.grids.at(0);
  for (std::size_t direction = 0; direction < Grid::directions; ++direction) {
    EXPECT_EQ(uniform.stiffness[direction].number.size(), 16u);
    EXPECT_EQ(varied.stiffness[direction].number.size(), direction == Grid::Right ? 96u : 80u);
  }
}

TEST(Grids, CoverSeveralSheetsAndRopesOfAScene) {
  TestSim sim = make_net({.rows = 5, .columns = 9});
  const TestSim more = make_net({.rows = 4, .columns = 6});
  const auto append = [&](const TestSim& other) {
    const Index first = sim.system.point_count();
    for (const Vec3& position : other.state.position) sim.add(position + Vec3(20.0));
    for (const Spring& spring : other.system.springs())
      sim.join(sim.system.points()[first + other.system.index_of(spring.first)].id,
               sim.system.points()[first + other.system.index_of(spring.second)].id, spring.stiffness, spring.rest_length);
  };
  append(more);
  append(make_net({.rows = 1, .columns = 30}));
  const Plan plan = make_plan_with_grids(sim.system);
  ASSERT_EQ(plan.spring.grids.size(), 3u);
  EXPECT_EQ(plan.spring.grids[1].columns, 6);
  EXPECT_EQ(plan.spring.grids[2].rows, 1);
  EXPECT_EQ(springs_in_grids(plan), plan.springs);
}

TEST(GridForces, EqualThoseOfRunsToRounding) {
  for (const Net& net : assorted_nets()) {
    const PackedGrid packed(make_net(net));
    ASSERT_EQ(packed.plan.spring.grids.size(), 1u) << net.rows << " x " << net.columns;
    const Plan runs = without_grids(packed.plan);
    const Field f = packed.forces();
    Field expected(f.size(), 0.0);
    add_spring_forces(runs, packed.motion.x.data(), packed.velocities(), expected.data());
    for (std::size_t i = 0; i < f.size(); ++i) EXPECT_NEAR(f[i], expected[i], 2e-12) << net.rows << " x " << net.columns;
  }
}

// k (1 - l0 / l) is zero where l is l0, as k (l - l0) / l is.
TEST(GridForces, AreZeroInASheetAtRest) {
  TestSim sim = make_net({.rows = 9, .columns = 21});
  std::vector<Spring> springs = sim.system.springs();
  for (Spring& spring : springs) {
    const Vec3 u = sim.position(spring.first) - sim.position(spring.second);
    spring.rest_length = std::sqrt(u.x * u.x + u.y * u.y + u.z * u.z);
  }
  sim.system.set_springs(springs);
  const PackedGrid packed(sim);
  ASSERT_EQ(packed.plan.spring.grids.size(), 1u);
  for (const double component : packed.forces()) EXPECT_EQ(component, 0.0);
}

template <class Compute>
void expect_same_bits(const Compute& compute) {
  std::vector<Field> first;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    const std::vector<Field> fields = compute();
    if (first.empty()) first = fields;
    EXPECT_EQ(fields, first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(GridForces, HaveTheSameBitsForEveryVectorUnit) {
  expect_same_bits([] {
    std::vector<Field> forces;
    for (const Net& net : assorted_nets()) forces.push_back(PackedGrid(make_net(net)).forces());
    return forces;
  });
}

// One pass of forces, kick and drift, of the springs of grids alone.
std::pair<Field, Field> advanced(PackedGrid packed) {
  LeapfrogPass<double> pass = pass_over(packed.plan, packed.motion.x);
  pass.drifted = packed.motion.x.data();
  pass.v = packed.motion.v.data();
  pass.u = packed.velocities();
  pass.kick = {0.9, 0.01};
  pass.drift = 0.02;
  advance(packed.plan, pass, 1);
  return {packed.motion.x, packed.motion.v};
}

TEST(GridPass, EqualsForcesKickAndDriftInTurn) {
  for (const Net& net : assorted_nets())
    for (const double drag : {0.0, 0.7})
      for (const double duration : {0.0, 0.02}) {
        PackedGrid packed(make_net(net));
        Motion expected = packed.motion;
        compute_forces(packed.plan, 0.0, expected.x, expected.v, expected.a);
        packed.plan.drag = drag;
        divide_by_mass(packed.plan, expected.a);
        Field predicted, w(expected.v);
        predict_velocity(packed.plan, expected, 0.01 + 0.03, predicted);
        kick(packed.plan, expected, 0.01);
        drift(expected, duration);
        const Field u = packed.motion.v;
        accelerate_kick_and_drift(packed.plan, 0.0, packed.motion, 0.01, duration, {.acting = &u, .predicted = &w, .ahead = 0.03});
        for (std::size_t at = 0; at < w.size(); ++at) {
          EXPECT_NEAR(packed.motion.a[at], expected.a[at], 1e-11) << net.rows << " x " << net.columns;
          EXPECT_NEAR(packed.motion.v[at], expected.v[at], 1e-12) << net.rows << " x " << net.columns;
          EXPECT_NEAR(packed.motion.x[at], expected.x[at], 1e-13) << net.rows << " x " << net.columns;
          EXPECT_NEAR(w[at], predicted[at], 1e-12) << net.rows << " x " << net.columns;
        }
      }
}

TEST(GridPass, ComputesTheAccelerationsOfTheForcesDividedByMass) {
  for (const Net& net : assorted_nets())
    for (const double drag : {0.0, 0.7}) {
      PackedGrid packed(make_net(net));
      packed.plan.drag = drag;
      const Motion& motion = packed.motion;
      Field expected(motion.a), a(motion.a);
      compute_forces(packed.plan, 0.0, motion.x, motion.v, expected);
      divide_by_mass(packed.plan, expected);
      compute_accelerations(packed.plan, 0.0, motion.x, motion.v, a);
      for (std::size_t at = 0; at < a.size(); ++at) EXPECT_NEAR(a[at], expected[at], 1e-11) << net.rows << " x " << net.columns;
    }
}

TEST(GridPass, HasTheSameBitsForEveryVectorUnit) {
  expect_same_bits([] {
    std::vector<Field> fields;
    for (const Net& net : assorted_nets()) {
      const PackedGrid packed(make_net(net));
      auto [x, v] = advanced(packed);
      fields.push_back(std::move(x));
      fields.push_back(std::move(v));
    }
    return fields;
  });
}

}  // namespace
}  // namespace hooke
