// The cost of contact by the model of `auto`, which counts work: the same on every machine. With HOOKE_PRINT set, it is compared with the
// CPU time of this one.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

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
    sim.add({0.08 * (i % 4) - 0.12 + x, 0.05 + 0.08 * (i / 16), 0.08 * (i / 4 % 4) - 0.12 + z}, 0.1);
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
  Frame frame;
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

// In flight little is near anything else. Of the CPU time, on the machine of docs/accuracy.md, a substep of the pile takes 33 times, one of
// the folded sheet 13 times that of the same things in flight.
TEST(CostModel, CountsTheWorkOfContact) {
  for (const auto& [name, make, substeps, settled, measured] :
       {std::tuple("balls", &balls_over_bin, 10, 240, 33.0), {"sheet", &sheet_over_floor, 60, 40, 13.0}}) {
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

}  // namespace
}  // namespace hooke
