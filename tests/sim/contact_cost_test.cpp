// The cost of contact by the model of `auto`, which counts work: the same on every machine. With HOOKE_PRINT set, it is compared with the
// CPU time of this one.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "sim/control/frame_runner.h"
#include "sim/forces/force_terms.h"
#include "support/folds.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// 200 balls over a bin.
TestSim balls_over_bin() {
  TestSim sim;
  sim.system.contact = {.points = true, .restitution = 0.3, .friction = 0.3};
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.3, .friction = 0.3},
                          {.shape = Plane{{-0.16, 0.0, 0.0}, {1.0, 0.0, 0.0}}, .friction = 0.3},
                          {.shape = Plane{{0.16, 0.0, 0.0}, {-1.0, 0.0, 0.0}}, .friction = 0.3},
                          {.shape = Plane{{0.0, 0.0, -0.16}, {0.0, 0.0, 1.0}}, .friction = 0.3},
                          {.shape = Plane{{0.0, 0.0, 0.16}, {0.0, 0.0, -1.0}}, .friction = 0.3}};
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-0.005, 0.005), z = random.uniform(-0.005, 0.005);
    const int layer = i / 16, row = i / 4 % 4;
    sim.add({0.08 * (i % 4) - 0.12 + x, 0.05 + 0.08 * layer, 0.08 * row - 0.12 + z}, 0.1);
    sim.system.point(i).radius = 0.03;
  }
  return sim;
}

TestSim sheet_over_floor() {
  TestSim sim = dropped_sheet(17);
  folds::touch(sim);
  return sim;
}

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// [ms], per frame, of some frames after others.
struct FrameCost {
  double model = 0.0, cpu = 0.0;
};
FrameCost cost_after(TestSim sim, int substeps, int skipped, int frames) {
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  FrameCost cost;
  for (int i = 0; i < skipped + frames; ++i) {
    const double start = cpu_ms();
    frame.begin(plan, sim.system, {.integrator = &default_integrator(), .substeps = substeps}, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    if (i < skipped) continue;
    cost.cpu += (cpu_ms() - start) / frames;
    cost.model += frame.cost(plan) / frames;
  }
  return cost;
}

// In flight little is near anything else. Of the CPU time, on the machine of docs/evidence/accuracy.md, a substep of the pile takes 33
// times, one of the folded sheet 13 times that of the same things in flight.
TEST(CostModel, CountsTheWorkOfContact) {
  for (const auto& [name, make, substeps, settled, measured] :
       {std::tuple("balls", &balls_over_bin, 10, 240, 33.0), {"sheet", &sheet_over_floor, 60, 40, 6.5}}) {
    const FrameCost flight = cost_after(make(), substeps, 0, 5), contact = cost_after(make(), substeps, settled, 20);
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%s: %.3g ms (by the model %.3g) in flight, %.3g ms (%.3g) in contact, per frame\n", name, flight.cpu, flight.model,
                  contact.cpu, contact.model);
    EXPECT_GT(contact.model / flight.model, 0.5 * measured) << name;
    EXPECT_LT(contact.model / flight.model, 2.0 * measured) << name;
  }
}

// What does not touch has the cost of a scene without contact, but for the search.
TEST(CostModel, OfThingsFarApartIsThatOfTheirForces) {
  TestSim sim = net(16, 1e2, 0.0);
  const double without = cost_after(sim, 20, 0, 3).model;
  sim.system.contact = {.points = true};
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.system.point(i).radius = 1e-4;
  EXPECT_LT(cost_after(sim, 20, 0, 3).model, 5.0 * without);
  EXPECT_GT(cost_after(sim, 20, 0, 3).model, without);
}

// Points that cross the whole sheet in a substep: for each pair a long path is followed, distance by distance.
TEST(CostModel, CountsTheDistancesOnLongPaths) {
  TestSim fast = sheet_over_floor();
  Random random(3);
  for (Vec3& v : fast.state.velocity) {
    const double x = random.uniform(-60.0, 60.0), y = random.uniform(-60.0, 60.0), z = random.uniform(-60.0, 60.0);
    v = {x, y, z};
  }
  const FrameCost cost = cost_after(fast, 1, 0, 1);
  if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("paths: %.3g ms (by the model %.3g)\n", cost.cpu, cost.model);
  constexpr double measured = 200.0;  // [ms]
  EXPECT_GT(cost.model, 0.5 * measured);
  EXPECT_LT(cost.model, 2.0 * measured);
}

// Contact fails within this number of frames, none of which costs seconds.
void expect_limited_cost(TestSim& sim, const Settings& settings, int frames) {
  constexpr double max_ms = 3000.0;  // by the model
  Plan plan = make_plan(sim.system);
  FrameRunner frame;
  bool has_failed = false;
  double max = 0.0;
  for (int i = 0; i < frames && !has_failed; ++i) {
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    has_failed = frame.failure() == StepFailure::TooManyPairs;
    max = std::max(max, frame.cost(plan));
  }
  if (std::getenv("HOOKE_PRINT") != nullptr)
    std::printf("%s: up to %.3g ms per frame, failed: %d\n", std::string(settings.integrator->id).c_str(), max, has_failed);
  EXPECT_LT(max, max_ms);
  EXPECT_TRUE(has_failed);
}

// A sheet pressed together by springs of three times its size, without friction: each of many substeps follows long paths.
TEST(CostModel, OfAFrameOfLongPathsIsLimited) {
  TestSim sim = sheet_over_floor();
  sim.system.gravity = Vec3(0.0);
  sim.system.contact.friction = 0.0;
  sim.system.contact.thickness = 1e-4;
  sim.system.contact.springs = true;
  Random random(5);
  for (Vec3& v : sim.state.velocity) v = 30.0 * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  for (Index s = 0; s < sim.system.spring_count(); ++s) {
    sim.system.spring(s)->stiffness *= 1e7;
    sim.system.spring(s)->rest_length *= s % 3 == 0 ? 0.3 : 3.0;
  }
  expect_limited_cost(sim, {.integrator = find_integrator("xpbd"), .substeps = 400}, 4);
}

// Far too large a step throws all points of a sheet through each other: nearly all pairs may touch in each substep.
TEST(CostModel, OfAFrameOfPointsThatAllMeetIsLimited) {
  TestSim sim = dropped_sheet(24);
  sim.system.colliders.clear();
  sim.system.contact = {.points = true};
  for (Index s = 0; s < sim.system.spring_count(); ++s) {
    sim.system.spring(s)->stiffness *= 1e3;
    sim.system.spring(s)->rest_length *= 1.1;
  }
  expect_limited_cost(sim, {.integrator = find_integrator("explicit_euler"), .substeps = 8}, 20);
}

// The CPU time of a substep relative to that of the springs alone, on an AMD EPYC beside other work.
TEST(CostModel, CountsListedForcesAndTheStrainLimit) {
  TestSim sheet = dropped_sheet(17);
  sheet.system.colliders.clear();
  const FrameCost alone = cost_after(sheet, 100, 0, 3);
  const auto with_force = [&](std::string_view id, std::initializer_list<std::pair<std::size_t, double>> values) {
    TestSim sim = sheet;
    const ForceTerm& term = *find_force_term(id);
    Force force{.term = &term, .values = default_values(term)};
    for (const auto& [index, value] : values) force.values[index] = value;
    sim.system.forces.push_back(force);
    return sim;
  };
  TestSim limited = sheet;
  limited.system.strain_limit = 0.05;
  for (Index s = 0; s < limited.system.spring_count(); ++s) limited.system.spring(s)->rest_length *= s % 2 == 0 ? 0.5 : 1.0;
  const std::tuple<const char*, TestSim, double> cases[] = {
      {"bending", with_force("bending", {{0, 1e-6}}), 3.6},
      {"damped bending", with_force("bending", {{0, 1e-6}, {1, 0.01}}), 150.0},
      {"wind", with_force("wind", {}), 3.0},
      {"center", with_force("center", {{4, 1.5}}), 4.4},
      {"strain limit", limited, 54.0},
  };
  for (const auto& [name, sim, measured] : cases) {
    const FrameCost cost = cost_after(sim, 100, 0, 3);
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%s: %.3g of the CPU time of the springs, %.3g by the model\n", name, cost.cpu / alone.cpu, cost.model / alone.model);
    EXPECT_GT(cost.model / alone.model, 0.5 * measured) << name;
    EXPECT_LT(cost.model / alone.model, 2.0 * measured) << name;
  }
}

}  // namespace
}  // namespace hooke
