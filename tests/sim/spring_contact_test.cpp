// Contact of springs: ropes that lie on each other and on sheets, in three dimensions and in the plane.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "sim/energy.h"
#include "support/folds.h"

namespace hooke {
namespace {

// A rope of n points, nailed at both ends or free. Returns the index of its first point.
Index add_rope(TestSim& sim, int n, const Vec3& from, const Vec3& to, bool is_nailed) {
  const Index first = sim.system.point_count();
  const double a = glm::length(to - from) / (n - 1);
  for (int i = 0; i < n; ++i) sim.add(from + i / (n - 1.0) * (to - from), 0.01);
  for (int i = 0; i + 1 < n; ++i) sheet::join(sim, first + i, first + i + 1, 500.0, 0.02, a);
  if (is_nailed)
    for (const Index end : {first, first + n - 1}) sim.system.point(end).nailed = true;
  return first;
}

void run(TestSim& sim, double seconds) {
  for (int i = 0; i < static_cast<int>(60.0 * seconds); ++i) sim.run(default_integrator(), 1.0 / 60.0, 30);
}

TEST(SpringContact, HoldsARopeOnAnother) {
  for (const bool touches : {false, true}) {
    TestSim sim;
    add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, true);
    const Index upper = add_rope(sim, 12, {0.03, 0.1, -0.5}, {0.03, 0.1, 0.5}, false);
    sim.system.contact = {.springs = touches, .thickness = 0.01, .friction = 0.5};
    run(sim, 1.0);
    const double middle = 0.5 * (sim.state.position[upper + 5].y + sim.state.position[upper + 6].y);
    if (touches)
      EXPECT_GT(middle, sim.state.position[5].y);
    else
      EXPECT_LT(middle, -3.0);
  }
}

TEST(SpringContact, MakesSpringsWallsInThePlane) {
  for (const bool touches : {false, true}) {
    TestSim sim;
    sim.system.dimensions = 2;
    add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, true);
    const Index upper = add_rope(sim, 4, {-0.1, 0.2, 0.0}, {0.07, 0.2, 0.0}, false);
    sim.system.contact = {.springs = touches, .thickness = 0.01, .friction = 0.5};
    run(sim, 1.0);
    for (Index i = upper; i < upper + 4; ++i) {
      if (touches)
        EXPECT_GT(sim.state.position[i].y, -0.2) << i;
      else
        EXPECT_LT(sim.state.position[i].y, -3.0) << i;
    }
  }
}

TEST(SpringContact, HoldsARopeOnASheet) {
  TestSim sim;
  folds::add_sheet(
      sim, 9, [](double u, double v) { return Vec3(u - 0.5, 0.0, v - 0.5); }, folds::at_rest);
  for (Index i = 0; i < 81; ++i) sim.system.point(i).nailed = i % 9 == 0 || i % 9 == 8;
  const Index rope = add_rope(sim, 8, {-0.11, 0.05, -0.2}, {0.17, 0.05, 0.13}, false);
  sim.system.contact = {.springs = true, .faces = true, .thickness = 0.01, .friction = 0.3};
  run(sim, 1.0);
  for (Index i = rope; i < rope + 8; ++i) EXPECT_GT(sim.state.position[i].y, -0.6) << i;
}

TEST(SpringContact, ConservesLinearMomentum) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  add_rope(sim, 11, {-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, false);
  const Index upper = add_rope(sim, 12, {0.03, 0.1, -0.5}, {0.03, 0.1, 0.5}, false);
  for (Index i = upper; i < sim.system.point_count(); ++i) sim.state.velocity[i] = Vec3(0.5, -10.0, 1.0);
  sim.system.contact = {.springs = true, .thickness = 0.01, .friction = 0.5};
  const Vec3 before = compute_momentum(sim.system, sim.state).linear;
  run(sim, 0.1);
  EXPECT_GT(sim.state.velocity[upper + 6].y, -9.0);
  EXPECT_LT(glm::length(compute_momentum(sim.system, sim.state).linear - before), 1e-13);
}

}  // namespace
}  // namespace hooke
