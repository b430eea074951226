// Contact of points with a radius of their own on springs and faces ("beads"), with `points` as well: each other, and spheres.
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/plan/plan.h"
#include "support/convergence.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr double frame_of_beads = 1.0 / 60.0;

PointId add_bead(TestSim& sim, const Vec3& position, double radius, double mass, bool is_nailed = false) {
  const PointId id = is_nailed ? sim.nail(position) : sim.add(position, mass);
  sim.system.point(sim.system.index_of(id)).radius = radius;
  return id;
}

// The largest by which two points that touch overlap, as a part of the distance at which they do.
double max_overlap(const TestSim& sim) {
  const std::vector<Point>& points = sim.system.points();
  const PairPlan plan = plan_pairs(sim.system);
  double max = 0.0;
  for (Index j = 0; j < static_cast<Index>(points.size()); ++j)
    for (Index i = 0; i < j; ++i) {
      if ((points[i].nailed && points[j].nailed) || plan.excludes(i, j)) continue;
      const double touching = points[i].radius + points[j].radius + plan.thickness;
      max = std::max(max, 1.0 - glm::distance(sim.state.position[i], sim.state.position[j]) / touching);
    }
  return max;
}

void join_at_rest(TestSim& sim, PointId i, PointId j, double stiffness, double damping) {
  sim.join(i, j, stiffness, glm::distance(sim.position(i), sim.position(j)), damping);
}

// Balls, the upper ones heavier, that fall on a rope of beads between two nails.
TestSim balls_on_a_rope(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  sim.system.dimensions = 2;
  sim.system.gravity = {0.0, -9.81, 0.0};
  sim.system.contact = {.points = true,
                        .springs = true,
                        .thickness = random.uniform(0.002, 0.006),
                        .restitution = random.one_in(2) ? 0.0 : 0.3,
                        .friction = random.one_in(2) ? 0.0 : 0.3};
  const Index count = 11 + random.below(6);
  PointId last{};
  const double radius = random.uniform(0.008, 0.016);
  for (Index k = 0; k < count; ++k) {
    const double s = static_cast<double>(k) / static_cast<double>(count - 1);
    const PointId bead = add_bead(sim, {s - 0.5, -0.4 * s * (1.0 - s), 0.0}, radius, 0.02, k == 0 || k + 1 == count);
    if (k > 0) join_at_rest(sim, last, bead, 4000.0, 0.5);
    last = bead;
  }
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      add_bead(sim, {-0.12 + 0.08 * column + random.uniform(-0.008, 0.008), 0.06 + 0.08 * row, 0.0}, random.uniform(0.018, 0.03),
               0.02 * (1 + row));
  return sim;
}

// A net of beads that hangs from its border, or a sheet of such points whose faces touch, with balls and a rope of beads on it.
TestSim balls_on_a_net(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  sim.system.gravity = {0.0, 0.0, -9.81};
  const bool has_faces = random.one_in(2);
  sim.system.contact = {.points = true,
                        .springs = !has_faces || random.one_in(2),
                        .faces = has_faces,
                        .thickness = random.uniform(0.003, 0.008),
                        .restitution = random.one_in(2) ? 0.0 : 0.3,
                        .friction = random.one_in(2) ? 0.0 : 0.3};
  constexpr int n = 7;
  const double radius = random.uniform(0.01, 0.025);
  std::vector<PointId> net;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column)
      net.push_back(add_bead(sim, {0.08 * (column - n / 2), 0.08 * (row - n / 2), 0.0}, radius, 0.02,
                             row == 0 || column == 0 || row + 1 == n || column + 1 == n));
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const PointId at = net[n * row + column];
      if (column + 1 < n) join_at_rest(sim, at, net[n * row + column + 1], 1000.0, 0.2);
      if (row + 1 < n) join_at_rest(sim, at, net[n * row + n + column], 1000.0, 0.2);
      if (has_faces && column + 1 < n && row + 1 < n) {
        const PointId right = net[n * row + column + 1], below = net[n * row + n + column], other = net[n * row + n + column + 1];
        join_at_rest(sim, right, below, 300.0, 0.2);
        sim.system.faces.push_back({{at, right, below}});
        sim.system.faces.push_back({{right, other, below}});
      }
    }
  PointId last{};
  for (int k = 0; k < 8; ++k) {
    const PointId bead = add_bead(sim, {0.06 * (k - 4), 0.02 * (k % 2), 0.07}, 0.012, 0.02);
    if (k > 0) join_at_rest(sim, last, bead, 1000.0, 0.2);
    last = bead;
  }
  for (int layer = 0; layer < 3; ++layer)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        add_bead(sim, {0.08 * (column - 1) + random.uniform(-0.01, 0.01), 0.08 * (row - 1), 0.14 + 0.08 * layer},
                 random.uniform(0.018, 0.03), 0.03 * (1 + layer));
  return sim;
}

class BeadContactOf : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, BeadContactOf, testing::ValuesIn(every_method()), method_name);

void expect_no_overlap(const Integrator& method, TestSim (*scene)(std::uint64_t), int seeds, int frames) {
  // explicit_euler needs that many for its springs
  const int substeps = method.stability == Stability::None ? 200 : 30;
  for (int seed = 1; seed <= seeds; ++seed) {
    TestSim sim = scene(static_cast<std::uint64_t>(seed));
    double overlap = 0.0;
    int worst = 0;
    for (int i = 0; i < frames; ++i) {
      sim.run(method, frame_of_beads, substeps);
      const double now = max_overlap(sim);
      if (now > overlap) overlap = now, worst = i;
    }
    EXPECT_LT(overlap, 0.07) << method.id << ", seed " << seed << ", frame " << worst;
  }
}

TEST_P(BeadContactOf, DoesNotPressBallsIntoBeadsOfARope) { expect_no_overlap(method(), balls_on_a_rope, 2, 60); }

TEST_P(BeadContactOf, DoesNotPressBallsIntoBeadsOfANet) { expect_no_overlap(method(), balls_on_a_net, 2, 45); }

// Two ropes of beads that hit each other bead on bead: their springs stay apart, and change nothing.
TEST_P(BeadContactOf, LeavesImpactsOfBeadsToContactOfPoints) {
  // an adaptive method takes longer steps where no springs touch
  const double tolerance = &method() == &adaptive_integrator() ? 1e-3 : 1e-9;
  for (const double restitution : {0.0, 0.5, 1.0}) {
    std::array<TestSim, 2> sims;
    for (const bool springs : {false, true}) {
      TestSim& sim = sims[springs];
      sim.system.contact = {.points = true, .springs = springs, .thickness = 0.002, .restitution = restitution, .friction = 0.2};
      sim.system.gravity = Vec3(0.0);
      for (const double side : {-1.0, 1.0}) {
        PointId last{};
        for (int k = 0; k < 4; ++k) {
          const PointId bead = add_bead(sim, {0.1 * k + 0.002 * side * k, 0.05 * side, 0.0}, 0.03, 0.1 + 0.05 * k);
          sim.state.velocity.back() = {0.1 * side, -1.0 * side, 0.2};
          if (k > 0) join_at_rest(sim, last, bead, 500.0, 0.1);
          last = bead;
        }
      }
      sim.run(method(), 0.1, 100);
    }
    EXPECT_GT(glm::distance(sims[0].state.velocity[1], Vec3(-0.1, 1.0, 0.2)), 0.1) << "they hit each other";
    for (std::size_t i = 0; i < sims[0].state.position.size(); ++i) {
      EXPECT_NEAR(glm::distance(sims[0].state.velocity[i], sims[1].state.velocity[i]), 0.0, tolerance) << restitution;
      EXPECT_NEAR(glm::distance(sims[0].state.position[i], sims[1].state.position[i]), 0.0, tolerance) << restitution;
    }
  }
}

// Without gravity and nails.
TEST_P(BeadContactOf, ConservesLinearMomentumToRounding) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    TestSim sim = balls_on_a_net(seed);
    sim.system.gravity = Vec3(0.0);
    for (Index i = 0; i < sim.system.point_count(); ++i) {
      sim.system.point(i).nailed = false;
      if (i >= 49) sim.state.velocity[i].z = -3.0;
    }
    const Vec3 before = compute_momentum(sim.system, sim.state).linear;
    for (int i = 0; i < (method().stability == Stability::None ? 2 : 10); ++i) sim.run(method(), frame_of_beads, 60);
    EXPECT_LT(glm::distance(compute_momentum(sim.system, sim.state).linear, before), 1e-12) << seed;
  }
}

}  // namespace
}  // namespace hooke
