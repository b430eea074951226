// The steps that `auto` takes where dashpots are weak.
#include "sim/step/automatic/leapfrog.h"

#include <gtest/gtest.h>

#include "sim/forces/energy/energy.h"
#include "sim/step/automatic/trials.h"
#include "support/automatic_runs.h"
#include "support/convergence.h"

namespace hooke {
namespace {

// [m], after a quarter of a second, in frames of 1/60 s.
double error_of(const TestSim& sim, const Integrator& method, int substeps) {
  const Settings exact{.integrator = find_integrator("dop853"), .tolerance = 1e-13}, settings{.integrator = &method, .substeps = substeps};
  Plan plan = make_plan(sim.system);
  Frame frame;
  State state = sim.state, truth = sim.state;
  for (int i = 0; i < 15; ++i) {
    state = next_frame(plan, frame, sim.system, settings, state);
    truth = next_frame(plan, frame, sim.system, exact, truth);
  }
  return distance(state, truth);
}

TEST(Leapfrog, IsOfSecondOrderWithoutDashpotsAndOfFirstWithThem) {
  const TestSim undamped = net(6, 1e2, 0.0), damped = net(6, 1e2, 5.0);
  EXPECT_NEAR(measured_order([&](int substeps) { return error_of(undamped, leapfrog, substeps); }, 32), leapfrog.order, 0.1);
  EXPECT_NEAR(measured_order([&](int substeps) { return error_of(damped, leapfrog, substeps); }, 256), leapfrog.order_with.damped, 0.1);
}

// At its limit of stability, on a scene with d = 9e-5 k, as in the benchmark.
TEST(Leapfrog, IsAsAccurateAsVelocityVerletWithWeakDashpots) {
  TestSim sim = net(8, 1e4, 0.9);
  for (Index i = 0; i < sim.system.point_count(); ++i) sim.state.position[i].z += 0.02 * (i % 3);
  const int substeps = stable_substeps(leapfrog, make_plan(sim.system).spectrum, 60.0);
  EXPECT_LT(error_of(sim, leapfrog, 4 * substeps), 2.0 * error_of(sim, default_integrator(), 4 * substeps));
}

TEST(Leapfrog, LosesTheEnergyOfADampedNetAtTheLimitOfItsStability) {
  for (const double damping : {0.1, 2.0, 20.0}) {
    TestSim sim = net(6, 1e4, damping);
    for (Index i = 0; i < sim.system.point_count(); ++i)
      if (!sim.system.points()[i].nailed) sim.state.position[i] += Vec3(0.01 * (i % 2), 0.01 * (i % 3), 0.01 * (i % 5));
    const Settings settings{.integrator = &leapfrog, .substeps = stable_substeps(leapfrog, make_plan(sim.system).spectrum, 60.0)};
    Plan plan = make_plan(sim.system);
    Frame frame;
    double last = compute_energy(sim.system, sim.state).total();
    for (int i = 0; i < 120; ++i) {
      sim.state = next_frame(plan, frame, sim.system, settings, sim.state);
      const double energy = compute_energy(sim.system, sim.state).total();
      if (i % 30 == 29) {
        EXPECT_LT(energy, last) << damping;
        last = energy;
      }
    }
  }
}

TEST(Leapfrog, IsChosenForWeakDashpotsAndNotForStrongOnes) {
  for (const auto& [damping, is_expected] : {std::pair{0.9, true}, std::pair{1e3, false}, std::pair{0.0, false}}) {
    TestSim sim = net(16, 1e4, damping);
    Plan plan = make_plan(sim.system);
    Frame frame;
    for (int i = 0; i < 3; ++i) sim.state = next_frame(plan, frame, sim.system, automatic(1e-3), sim.state);
    EXPECT_EQ(sim.state.memory.choice->method == &leapfrog, is_expected) << damping;
  }
}

// It is no method of the menus and files, but may be that of a frame.
TEST(Leapfrog, IsFoundOnlyAsAChoice) {
  EXPECT_EQ(find_integrator("leapfrog"), nullptr);
  EXPECT_EQ(find_chosen_method("leapfrog"), &leapfrog);
  EXPECT_EQ(find_chosen_method("velocity_verlet"), &default_integrator());
}

}  // namespace
}  // namespace hooke
