// How often the accumulated error is right: random scenes with contact, dashpots and drag against converged runs of two methods.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "sim/control/frame_error.h"
#include "sim/methods/integrator.h"
#include "support/force_with.h"
#include "support/measured_lab.h"
#include "support/parts.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

constexpr int frames = 60;

// A chain of a few points in flight above a plane, which may touch each other too.
Scene random_chain(std::uint64_t seed) {
  Random random(seed);
  TestSim sim;
  sim.system.gravity = random.one_in(4) ? Vec3(0.0) : Vec3(0.0, -9.81, 0.0);
  const int count = 2 + static_cast<int>(random.below(5));
  const double stiffness = std::exp(random.uniform(0.0, 8.0)), speed = random.uniform(0.0, 3.0);
  const double damping = random.one_in(2) ? 0.0 : std::exp(random.uniform(-5.0, 2.0));
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, z);
  };
  PointId last{};
  for (int i = 0; i < count; ++i) {
    const Vec3 place = Vec3(0.3 * i, 0.0, 0.0) + vector(0.1);
    const Vec3 velocity = vector(speed);
    const double mass = random.uniform(0.2, 2.0);
    const bool is_nailed = i == 0 && random.one_in(3);
    const PointId point = is_nailed ? sim.nail(place) : sim.add(place, mass, velocity);
    sim.system.point(sim.system.index_of(point)).radius = 0.05;
    if (i > 0) sim.join(last, point, stiffness, random.uniform(0.15, 0.4), damping);
    last = point;
  }
  if (random.one_in(3)) sim.system.drag = random.uniform(0.0, 2.0);
  if (!random.one_in(3))
    sim.system.colliders = {{.shape = Plane{{0.0, -0.6, 0.0}, {0.0, 1.0, 0.0}}, .restitution = random.uniform(0.0, 1.0), .friction = 0.3}};
  sim.system.contact.points = random.one_in(2);
  sim.system.contact.restitution = random.uniform(0.0, 1.0);
  sim.system.contact.friction = 0.2;
  const char* methods[] = {"velocity_verlet", "symplectic_euler", "blanes_moan4", "runge_kutta4", "implicit_midpoint", "tr_bdf2", "xpbd"};
  const char* method = random.one_of(methods);
  return scene_of(sim, {.integrator = find_integrator(method), .substeps = 1 + static_cast<int>(random.below(16))});
}

std::optional<std::vector<Vec3>> end_of(Scene scene, const char* method, int substeps, std::optional<double> tolerance) {
  scene.settings = {
      .integrator = find_integrator(method), .frame_rate = scene.settings.frame_rate, .substeps = substeps, .tolerance = tolerance};
  Lab lab(scene, KeepStart::No);
  for (int i = 0; i < frames; ++i)
    if (!lab.step()) return std::nullopt;
  return lab.scene().state.position;
}

// How many of the runs whose exact end is known claim far too little or too much.
struct Coverage {
  int known = 0, small = 0, large = 0;
  double smallest = 1.0, largest = 1.0;

  void add(double claimed, double error) {
    const double ratio = claimed / error;
    ++known;
    small += ratio < 1.0 / 3.0 ? 1 : 0;
    large += ratio > 3.0 ? 1 : 0;
    smallest = std::min(smallest, ratio);
    largest = std::max(largest, ratio);
  }
  void print() const {
    if (std::getenv("HOOKE_PRINT") == nullptr) return;
    std::printf("%d known: %d claim less than a third (%.2g times the error), %d more than three times (%.2g)\n", known, small, smallest,
                large, largest);
  }
};

// What is claimed at the end is compared with two methods, if these agree.
void add_run(const Scene& scene, int finest, Coverage& coverage) {
  Lab lab = measured_lab(scene);
  int done = 0;
  while (done < frames && lab.step()) ++done;
  const auto claimed = lab.accuracy().accumulated.value;
  if (done < frames || !claimed) return;
  const auto exact = end_of(scene, "dop853", 10, 1e-10), other = end_of(scene, "velocity_verlet", finest, std::nullopt);
  if (!exact || !other) return;
  const double error = weighted_distance(lab.scene().system, lab.scene().state.position, *exact, 1.0).rms;
  constexpr double min_error = 1e-9, max_gap = 0.1;
  if (error > min_error && weighted_distance(lab.scene().system, *exact, *other, 1.0).rms < max_gap * error) coverage.add(*claimed, error);
}

class AccumulatedCoverage : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, AccumulatedCoverage, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, AccumulatedCoverage, testing::Range(1, AccumulatedCoverage::parts));

TEST_P(AccumulatedCoverage, IsRarelyFarTooSmallOrTooLarge) {
  Coverage coverage;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    if (has(static_cast<int>(seed))) add_run(random_chain(seed), 800, coverage);
  coverage.print();
  EXPECT_GE(coverage.known, 30 / parts);
  EXPECT_LE(coverage.small, coverage.known / 20);
  EXPECT_LE(coverage.large, coverage.known / 20);
}

// Gusts are random: steps that pass over several of them, and halves of them, see different ones.
TEST_P(AccumulatedCoverage, HoldsForGustsThatStepsDoNotResolve) {
  Coverage coverage;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    if (!has(static_cast<int>(seed))) continue;
    Random random(seed);
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    sim.join(sim.add(Vec3(0.0), 0.05), sim.add({1.0, 0.0, 0.0}, 0.05), random.one_of(std::array{0.001, 0.01, 0.1}), 1.0);
    for (Index i = 0; i < 2; ++i) sim.system.point(i).radius = 0.05;
    const double x = random.uniform(-5.0, 5.0), y = random.uniform(-5.0, 5.0);
    const double normal = random.one_of(std::array{0.1, 1.0}), duration = random.one_of(std::array{0.05, 0.0625, 0.1, 0.25});
    sim.system.forces = {force_with("wind", {{"x", x},
                                             {"y", y},
                                             {"z", 0.0},
                                             {"normal", normal},
                                             {"gusts", 1.0},
                                             {"gust_time", duration},
                                             {"seed", static_cast<double>(seed)}})};
    const char* method = random.one_of(std::array{"velocity_verlet", "runge_kutta4", "tr_bdf2", "auto"});
    const double frame_rate = random.one_of(std::array{2.0, 4.0, 5.0, 10.0, 20.0});
    const int substeps = random.one_of(std::array{1, 1, 2, 4});
    add_run(scene_of(sim, {.integrator = find_integrator(method), .frame_rate = frame_rate, .substeps = substeps}), 1000, coverage);
  }
  coverage.print();
  EXPECT_GE(coverage.known, 40 / parts);
  EXPECT_LE(coverage.small, coverage.known / 20);
  EXPECT_LE(coverage.large, coverage.known / 10);
}

}  // namespace
}  // namespace hooke
