// Forces follow their formulas, are opposite in pairs, equal minus the gradient of the energy, and have the same bits at every vector
// width.
#include "sim/forces/forces.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/forces/energy/energy.h"
#include "sim/forces/spring_kernel.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

struct Packed {
  Plan plan;
  Motion motion;
  explicit Packed(const TestSim& sim) : plan(make_plan(sim.system)) {
    prepare_hand(plan, sim.system, sim.state, 1.0 / 60.0);
    pack(plan, sim.state, motion);
  }
  // [N] on every point
  Field forces() const {
    Field f(motion.x.size(), 0.0);
    compute_forces(plan, motion.time, motion.x, motion.v, f);
    return f;
  }
  Field spring_forces() const {
    Field f(motion.x.size(), 0.0);
    add_spring_forces(plan, motion.x.data(), plan.has_dashpots() ? motion.v.data() : nullptr, f.data());
    return f;
  }
  Vec3 at(const Field& f, Index i) const { return vector_at(plan, f, i); }
};

// -(k (l - l0) + d w) u on the first end of every spring, computed by a plain loop over the System.
std::vector<Vec3> plain_spring_forces(const TestSim& sim, std::vector<double>& size) {
  std::vector<Vec3> forces(sim.state.position.size(), Vec3(0.0));
  size.assign(forces.size(), 0.0);
  for (const Spring& spring : sim.system.springs()) {
    const Index i = sim.system.index_of(spring.first), j = sim.system.index_of(spring.second);
    const Vec3 along = sim.state.position[i] - sim.state.position[j];
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const Vec3 u = along / length;
    const double w = glm::dot(sim.state.velocity[i] - sim.state.velocity[j], u);
    const Vec3 force = -(spring.stiffness * (length - spring.rest_length) + sim.system.damping_of(spring) * w) * u;
    forces[i] += force;
    forces[j] -= force;
    for (const Index end : {i, j})
      size[end] += spring.stiffness * (length + spring.rest_length) + sim.system.damping_of(spring) * std::abs(w);
  }
  return forces;
}

// A square net in grid order, crumpled, with springs of different values: long runs and remainders.
TestSim crumpled_net(int n, int dimensions, double max_damping) {
  Random random(n);
  TestSim sim;
  sim.system.dimensions = dimensions;
  for (int i = 0; i < n * n; ++i) {
    const Vec3 away(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), dimensions == 3 ? random.uniform(-0.3, 0.3) : 0.0);
    const Vec3 velocity(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), dimensions == 3 ? random.uniform(-1.0, 1.0) : 0.0);
    sim.add(Vec3(i % n, -(i / n), 0.0) + away, 1.0, velocity);
  }
  const auto join = [&](int from, int to) {
    sim.join(sim.system.points()[from].id, sim.system.points()[to].id, random.uniform(1.0, 100.0), random.uniform(0.0, 2.0),
             random.uniform(0.0, max_damping));
  };
  for (int i = 0; i < n * n; ++i) {
    if (i % n + 1 < n) join(i, i + 1);
    if (i / n + 1 < n) join(i, i + n);
    if (i % n + 1 < n && i / n + 1 < n) join(i, i + n + 1);
    if (i % n > 0 && i / n + 1 < n) join(i, i + n - 1);
  }
  return sim;
}

std::vector<TestSim> assorted_sims() {
  std::vector<TestSim> sims;
  for (const int dimensions : {2, 3})
    for (const double damping : {0.0, 5.0}) {
      sims.push_back(random_sim(11, 30, 120, dimensions, damping));
      for (const int n : {2, 3, 9, 20}) sims.push_back(crumpled_net(n, dimensions, damping));
    }
  return sims;
}

TEST(SpringForces, EqualAPlainLoop) {
  for (const TestSim& sim : assorted_sims()) {
    const Packed packed(sim);
    const Field f = packed.spring_forces();
    std::vector<double> size;
    const std::vector<Vec3> plain = plain_spring_forces(sim, size);
    for (Index i = 0; i < packed.plan.points; ++i)
      EXPECT_LE(glm::distance(packed.at(f, i), plain[i]), 1e-15 * size[i]) << "point " << i << " of " << packed.plan.points;
  }
}

TEST(SpringForces, HaveTheSameBitsOnEveryVectorTarget) {
  const std::vector<int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::vector<Field> first;
  for (const int64_t target : targets) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    std::vector<Field> forces;
    for (const TestSim& sim : assorted_sims()) forces.push_back(Packed(sim).spring_forces());
    if (first.empty()) first = forces;
    EXPECT_EQ(forces, first) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

// Adds to `f` spring by spring. In a run along a row, each point adds both of its springs at once; in any other run, in blocks, the first
// ends add their forces before the second ends.
void add_plain_forces(const Packed& packed, Field& f) {
  const Plan& plan = packed.plan;
  const Field &x = packed.motion.x, &v = packed.motion.v;
  for (const SpringRun& run : plan.spring.runs)
    for (int c = 0; c < plan.dimensions; ++c) {
      std::vector<double> term;
      for (Index e = 0; e < run.count; ++e) {
        double length_squared = 0.0, approach = 0.0;
        for (int k = 0; k < plan.dimensions; ++k) {
          const Index i = k * plan.points + run.first + e, j = k * plan.points + run.second + e;
          length_squared += (x[i] - x[j]) * (x[i] - x[j]);
          approach += (x[i] - x[j]) * (v[i] - v[j]);
        }
        const Index spring = run.begin + e, at = c * plan.points + e;
        const double length = std::sqrt(length_squared);
        double tension = plan.spring.stiffness[spring] * (length - plan.spring.rest_length[spring]);
        if (plan.has_dashpots()) tension += plan.spring.damping[spring] * approach / length;
        term.push_back((length == 0.0 ? 0.0 : tension / length) * (x[at + run.first] - x[at + run.second]));
      }
      double* first = &f[c * plan.points + run.first];
      double* second = &f[c * plan.points + run.second];
      if (run.second == run.first + 1) {
        for (Index e = 0; e <= run.count; ++e) first[e] += (e > 0 ? term[e - 1] : 0.0) - (e < run.count ? term[e] : 0.0);
      } else {
        for (Index e = 0; e < run.count; ++e) first[e] -= term[e];
        for (Index e = 0; e < run.count; ++e) second[e] += term[e];
      }
    }
}

// Triangles between n x n points, with a random diagonal in each cell: runs of every length up to that of a row.
TestSim triangle_mesh(int n, int dimensions, double max_damping, bool shuffled) {
  Random random(n);
  TestSim sim;
  sim.system.dimensions = dimensions;
  std::vector<Index> at;
  for (Index i = 0; i < n * n; ++i) at.push_back(i);
  for (Index i = n * n; shuffled && i > 1; --i) std::swap(at[i - 1], at[random.below(i)]);
  for (int i = 0; i < n * n; ++i) {
    const Vec3 position(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), dimensions == 3 ? random.uniform(-1.0, 1.0) : 0.0);
    // some points coincide with the previous one
    sim.add(i > 0 && random.one_in(5) ? sim.state.position.back() : position, 1.0, 2.0 * position);
  }
  const auto join = [&](int from, int to) {
    sim.join(sim.system.points()[at[from]].id, sim.system.points()[at[to]].id, random.uniform(1.0, 100.0), random.uniform(0.0, 2.0),
             random.uniform(0.0, max_damping));
  };
  for (int i = 0; i < n * n; ++i) {
    const bool right = i % n + 1 < n, down = i / n + 1 < n;
    if (right) join(i, i + 1);
    if (down) join(i, i + n);
    if (right && down) random.one_in(2) ? join(i, i + n + 1) : join(i + 1, i + n);
  }
  return sim;
}

// including the signs of zeros
std::vector<std::uint64_t> next_bits(const Field& f) {
  std::vector<std::uint64_t> next_bits;
  for (const double component : f) next_bits.push_back(std::bit_cast<std::uint64_t>(component));
  return next_bits;
}

TEST(SpringForces, EqualAPlainLoopOverAnyGraphBitForBitOnEveryVectorTarget) {
  std::vector<TestSim> sims = assorted_sims();
  for (const int dimensions : {2, 3})
    for (const double damping : {0.0, 5.0}) {
      for (Index springs = 1; springs < 20; ++springs) sims.push_back(random_sim(springs, 12, springs, dimensions, damping));
      sims.push_back(random_sim(7, 200, 800, dimensions, damping));
      for (const int n : {2, 3, 4, 6, 9, 17, 40})
        for (const bool shuffled : {false, true}) sims.push_back(triangle_mesh(n, dimensions, damping, shuffled));
    }
  // a long run along a row, and one across, among short ones
  for (const int dimensions : {2, 3}) {
    TestSim sim = random_sim(9, 200, 60, dimensions, 0.0);
    for (const Index offset : {1, 100})
      for (Index i = 0; i < 90; ++i) sim.join(sim.system.points()[i].id, sim.system.points()[i + offset].id, 30.0, 0.5);
    sims.push_back(std::move(sim));
  }
  // forces that are all zero, added to signed zeros below, with and without a run along a row
  TestSim& still = sims.emplace_back();
  for (int i = 0; i < 5; ++i) still.add(Vec3(0.0));
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{2, 4}})
    still.join(still.system.points()[i].id, still.system.points()[j].id, 1.0, 1.0);

  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    for (const TestSim& sim : sims) {
      Packed packed(sim);
      packed.plan.spring.grids.clear();  // grid_test.cpp has theirs
      packed.plan.spring.loose_runs = packed.plan.spring.runs;
      Field f(packed.motion.x.size(), -0.0), plain = f;
      add_spring_forces(packed.plan, packed.motion.x.data(), packed.plan.has_dashpots() ? packed.motion.v.data() : nullptr, f.data());
      add_plain_forces(packed, plain);
      EXPECT_EQ(next_bits(f), next_bits(plain))
          << hwy::TargetName(target) << ", " << packed.plan.points << " points, " << packed.plan.springs << " springs";
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST(SpringForces, AreEqualAndOppositeInAPair) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    TestSim sim = random_sim(seed, 2, 1, 3, 5.0);
    const Packed packed(sim);
    const Field f = packed.spring_forces();
    EXPECT_EQ(packed.at(f, 0), -packed.at(f, 1)) << "seed " << seed;
  }
}

// over the whole scene: no net force and no net torque, up to round-off
TEST(SpringForces, SumToZeroForceAndTorqueOverTheScene) {
  for (const TestSim& sim : assorted_sims()) {
    const Packed packed(sim);
    const Field f = packed.spring_forces();
    std::vector<double> size;
    plain_spring_forces(sim, size);
    Vec3 force(0.0), torque(0.0);
    double scale = 0.0;
    for (Index i = 0; i < packed.plan.points; ++i) {
      force += packed.at(f, i);
      torque += glm::cross(sim.state.position[i], packed.at(f, i));
      scale += size[i] * (1.0 + glm::length(sim.state.position[i]));
    }
    EXPECT_LT(glm::length(force), 1e-15 * scale);
    EXPECT_LT(glm::length(torque), 1e-15 * scale);
  }
}

// f = -dE/dx by central differences of step s: error s^2 f'' / 6 + round-off E eps / s
TEST(Forces, AreMinusTheGradientOfTheEnergy) {
  for (const int dimensions : {2, 3}) {
    TestSim sim = random_sim(21, 9, 25, dimensions);
    sim.system.gravity = {1.0, -9.81, dimensions == 3 ? 2.0 : 0.0};
    for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).nailed = false;
    sim.system.grab = Grab{.point = sim.system.points()[2].id, .kind = GrabKind::Pull, .stiffness = 37.0};
    sim.state.hand = {.position = {0.4, 0.5, 0.0}, .target = {0.4, 0.5, 0.0}};
    for (Vec3& v : sim.state.velocity) v = Vec3(0.0);
    const Packed packed(sim);
    const Field f = packed.forces();

    const double s = 1e-5;
    for (Index i = 0; i < sim.system.point_count(); ++i)
      for (int c = 0; c < dimensions; ++c) {
        State ahead = sim.state, behind = sim.state;
        ahead.position[i][c] += s;
        behind.position[i][c] -= s;
        const double slope = (compute_energy(sim.system, ahead).total() - compute_energy(sim.system, behind).total()) / (2.0 * s);
        EXPECT_NEAR(packed.at(f, i)[c], -slope, 1e-6) << "point " << i << ", component " << c;
      }
  }
}

TEST(Forces, BetweenCoincidentPointsAreZero) {
  for (const double damping : {0.0, 3.0})
    for (const double rest_length : {0.0, 1.0}) {
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      const PointId first = sim.add({0.3, 0.2, 0.1}, 1.0, {1.0, 2.0, 3.0}), second = sim.add({0.3, 0.2, 0.1}, 2.0);
      sim.join(first, second, 100.0, rest_length, damping);
      const Packed packed(sim);
      const Field f = packed.forces();
      EXPECT_EQ(packed.at(f, 0), Vec3(0.0));
      EXPECT_EQ(packed.at(f, 1), Vec3(0.0));
    }
}

TEST(Forces, BetweenAlmostCoincidentPointsAreFinite) {
  for (const double distance : {1e-12, 1e-100, 1e-160, 1e-300}) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId first = sim.add(Vec3(0.0), 1.0, {1.0, 0.0, 0.0}), second = sim.add({distance, 0.0, 0.0}, 1.0);
    sim.join(first, second, 100.0, 1.0, 3.0);
    const Packed packed(sim);
    const double force = glm::length(packed.at(packed.forces(), 0));
    EXPECT_LE(force, 104.0) << "distance " << distance;
  }
}

TEST(Forces, OfGravityAndDragAreProportionalToMass) {
  TestSim sim;
  sim.system.drag = 0.5;
  sim.system.wind = {2.0, 0.0, 0.0};
  sim.add(Vec3(0.0), 3.0, {1.0, 4.0, 0.0});
  const Packed packed(sim);
  // m g - c m (v - wind)
  EXPECT_LT(glm::distance(packed.at(packed.forces(), 0), 3.0 * (Vec3(0.0, -9.81, 0.0) - 0.5 * Vec3(-1.0, 4.0, 0.0))), 1e-14);
}

}  // namespace
}  // namespace hooke
