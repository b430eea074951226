// The energy balance of random damped nets that fall on a floor and on each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/measured_lab.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// Where and how large, and its springs.
struct Body {
  Vec3 center, x, y, z, velocity;
  double mass, stiffness, damping;

  PointId add(TestSim& sim, const Vec3& at) const { return sim.add(center + at.x * x + at.y * y + at.z * z, mass, velocity); }
  void join(TestSim& sim, PointId i, PointId j) const {
    sim.join(i, j, stiffness, glm::distance(sim.position(i), sim.position(j)), damping);
  }
};

// n x n x layers points, springs between neighbors and across, and the faces of the surface.
void add_block(TestSim& sim, const Body& body, int n, int layers) {
  std::vector<PointId> ids;
  const auto id = [&](int i, int j, int k) { return ids[(k * n + j) * n + i]; };
  const double middle = 0.5 * (n - 1);
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) ids.push_back(body.add(sim, Vec3(i - middle, j - middle, k - 0.5 * (layers - 1)) / (n - 1.0)));
  for (std::size_t a = 0; a < ids.size(); ++a)
    for (std::size_t b = a + 1; b < ids.size(); ++b)
      if (glm::distance(sim.position(ids[a]), sim.position(ids[b])) < 1.8 * glm::length(body.x) / (n - 1)) body.join(sim, ids[a], ids[b]);
  const auto quad = [&](PointId a, PointId b, PointId c, PointId d) {
    sim.system.faces.push_back({{a, b, c}});
    sim.system.faces.push_back({{a, c, d}});
  };
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      quad(id(i, j, 0), id(i + 1, j, 0), id(i + 1, j + 1, 0), id(i, j + 1, 0));
      if (layers > 1) quad(id(i, j, layers - 1), id(i + 1, j, layers - 1), id(i + 1, j + 1, layers - 1), id(i, j + 1, layers - 1));
    }
  for (int i = 0; i + 1 < n; ++i)
    for (int k = 0; k + 1 < layers; ++k)
      for (const int end : {0, n - 1}) {
        quad(id(i, end, k), id(i + 1, end, k), id(i + 1, end, k + 1), id(i, end, k + 1));
        quad(id(end, i, k), id(end, i + 1, k), id(end, i + 1, k + 1), id(end, i, k + 1));
      }
}

// Blocks, sheets and ropes above a floor, one over the other.
TestSim falling_nets(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  const auto direction = [&] {
    while (true) {
      const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0), z = random.uniform(-1.0, 1.0);
      if (const Vec3 v(x, y, z); glm::length(v) > 0.2) return glm::normalize(v);
    }
  };
  const Index bodies = 2 + random.below(3);
  double height = 0.0;
  for (Index b = 0; b < bodies; ++b) {
    const double size = random.uniform(0.2, 0.5);
    Body body;
    body.x = direction();
    body.y = glm::normalize(glm::cross(direction(), body.x));
    body.z = glm::cross(body.x, body.y);
    for (Vec3* axis : {&body.x, &body.y, &body.z}) *axis *= size;
    height += 0.8 * size + 0.02;
    body.center = {random.uniform(-0.1, 0.1), height, random.uniform(-0.1, 0.1)};
    height += 0.8 * size + 0.02;
    body.velocity = random.uniform(0.0, 1.0) * direction();
    body.mass = std::pow(10.0, random.uniform(-3.0, -1.5));
    body.stiffness = body.mass * std::pow(10.0, random.uniform(3.5, 5.0));
    // of critical damping of one spring
    body.damping = random.uniform(0.0, 0.6) * std::sqrt(body.stiffness * body.mass);
    const Index kind = random.below(3);
    if (kind < 2) {
      add_block(sim, body, kind == 0 ? 3 : 4, kind == 0 ? 3 : 1);
    } else {
      PointId last = body.add(sim, Vec3(-0.5, 0.0, 0.0));
      for (int i = 1; i < 8; ++i) {
        const PointId next = body.add(sim, Vec3(i / 7.0 - 0.5, 0.0, 0.0));
        body.join(sim, last, next);
        last = next;
      }
    }
  }
  sim.system.colliders = {
      {.shape = Plane{}, .restitution = random.one_in(2) ? 0.0 : random.uniform(0.0, 0.5), .friction = random.uniform(0.0, 0.6)}};
  sim.system.contact = {.springs = true, .faces = true, .thickness = 0.01, .friction = random.uniform(0.0, 0.6)};
  if (random.one_in(3)) sim.system.strain_limit = 0.05;
  if (random.one_in(3)) sim.system.drag = random.uniform(0.0, 0.5);
  return sim;
}

EnergyBalance balance_of(const Scene& scene, int frames) {
  Lab lab = measured_lab(scene, AccuracyMode::Frame);
  for (int frame = 0; frame < frames; ++frame) EXPECT_TRUE(lab.step());
  return lab.accuracy().energy;
}

class ContactAccounts : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, ContactAccounts, testing::ValuesIn(every_method()), method_name);

// What the method is said to gain or lose is a small part of what the scene loses, and falls with the substeps. When dashpots were judged
// by the velocities at the ends of frames, it was 12 % to 22 % with every method and number of substeps.
TEST_P(ContactAccounts, LeaveLittleToTheMethodAndLessWithMoreSubsteps) {
  constexpr int falls = 1, frames = 40, refinement = 4;
  double coarse = 0.0, fine = 0.0;
  for (const bool touches_at_points : {false, true})
    for (int seed = 0; seed < falls; ++seed) {
      TestSim sim = falling_nets(static_cast<std::uint64_t>(seed) * 7919 + 5);
      if (touches_at_points) {
        sim.system.contact = {.points = true, .friction = 0.3};
        for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 0.02;
      }
      const int substeps = static_cast<int>(std::ceil(make_plan(sim.system).spectrum.omega / 60.0 / 0.5));
      for (const int factor : {1, refinement}) {
        const Settings settings{.integrator = &method(), .substeps = factor * substeps, .tolerance = {}};
        const EnergyBalance balance = balance_of(scene_of(sim, settings), frames);
        EXPECT_LE(balance.ledger[EnergyCause::Contact], 0.0);
        EXPECT_LE(balance.ledger[EnergyCause::Dashpots], 0.0);
        EXPECT_LE(balance.ledger.limits(), 0.0);
        EXPECT_NEAR(balance.ledger.sum() + balance.method(), balance.change, 1e-9);
        (factor == 1 ? coarse : fine) += std::abs(balance.method() / balance.change) / (2 * falls);
      }
    }
  if (std::getenv("HOOKE_PRINT") != nullptr)
    std::printf("%s: %.2f %% of the loss, %.2f %% with %d times the substeps\n", method().id.data(), 100.0 * coarse, 100.0 * fine,
                refinement);
  const bool is_of_first_order = method().order_with.damped == 1;
  EXPECT_LT(fine, is_of_first_order ? 0.05 : 1e-3);
  // one fall of 40 frames: which pairs touch differs with the substeps, by which a smaller part varies
  constexpr double negligible = 1e-4;
  EXPECT_LT(fine, std::max(negligible, (is_of_first_order ? 0.8 : 0.5) * coarse));
}

// A point rests on a floor, and another one above it on a spring and dashpot. The dashpot acts within the method on the velocity by which
// the weight accelerates what contact then stops: with the methods whose path has the velocity at the end of the substep, it was said to
// supply 2.7 mJ/s.
TEST_P(ContactAccounts, SayThatNothingIsSuppliedOrLostAtRest) {
  for (const bool has_springs : {false, true}) {
    TestSim net;
    const PointId bottom = net.add({0.0, 0.02, 0.0}), top = net.add({0.0, 0.5, 0.0});
    net.join(bottom, top, 1000.0, 0.48, 20.0);
    net.system.dimensions = 2;
    net.system.drag = 1.0;
    net.system.colliders = {{.shape = Plane{}, .friction = 0.3}};
    net.system.contact = {.points = !has_springs, .springs = has_springs, .friction = 0.3};
    Lab lab = measured_lab(scene_of(net, {.integrator = &method(), .substeps = 20, .tolerance = {}}), AccuracyMode::Frame);
    std::array<EnergyBalance, 2> rest;
    for (EnergyBalance& balance : rest) {
      for (int frame = 0; frame < 300; ++frame) ASSERT_TRUE(lab.step());
      balance = lab.accuracy().energy;
    }
    const double tolerance = 2e-4 * std::abs(rest[0].change);
    EXPECT_LT(rest[0].ledger[EnergyCause::Dashpots], -0.01);
    EXPECT_NEAR(rest[1].ledger[EnergyCause::Dashpots], rest[0].ledger[EnergyCause::Dashpots], tolerance);
    EXPECT_NEAR(rest[1].method(), rest[0].method(), tolerance);
    EXPECT_NEAR(rest[1].ledger[EnergyCause::Contact], rest[0].ledger[EnergyCause::Contact], tolerance);
  }
}

// Jelly cubes with dashpots that 16 substeps do not resolve fall on each other, and rest from 1 s on. With 256 substeps, dashpots take
// 10.4 J, and contact 2.1 J.
TEST(ContactAccountsOf, StackedJellyBookWhatIsLost) {
  const Scene scene = load_scene(find_scene("stacked_jelly")).scene;
  for (const int frames : {30, 60, 120}) {
    const EnergyBalance balance = balance_of(scene, frames);
    EXPECT_LT(balance.change, -12.0);
    EXPECT_LT(std::abs(balance.method()), 0.01 * -balance.change) << frames;
    EXPECT_LT(balance.ledger[EnergyCause::Contact], -0.5);
    EXPECT_LT(balance.ledger[EnergyCause::Dashpots], -10.0);
  }
}

// A strain limit stops what separates. On the hammock, it was said to supply 460 J in 4 s, and dashpots to dissipate 270 J, of 24 J that it
// loses.
TEST(ContactAccountsOf, AStrainLimitSupplyNothing) {
  Scene scene = load_scene(find_scene("hammock")).scene;
  scene.system.strain_limit = 0.1;
  const EnergyBalance balance = balance_of(scene, 120);
  EXPECT_LT(balance.change, -15.0);
  EXPECT_LE(balance.ledger.limits(), 0.0);
  for (const double share : {balance.ledger.limits(), balance.ledger[EnergyCause::Dashpots], balance.ledger[EnergyCause::Contact],
                             balance.ledger[EnergyCause::Drag]}) {
    EXPECT_LE(share, 0.0);
    EXPECT_GT(share, balance.change);
  }
}

}  // namespace
}  // namespace hooke
