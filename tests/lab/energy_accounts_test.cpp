// The energy balance of single frames.
#include <gtest/gtest.h>

#include <array>

#include "lab/accuracy/energy_accounts.h"
#include "sim/divergence.h"
#include "sim/plan.h"
#include "support/flat_scene.h"

namespace hooke {
namespace {

// A point that rests is lifted and set down by 1 mJ in turn: what contact has supplied in total is zero, and the rest is due to the method.
TEST(EnergyAccounts, ContactWithCollidersAtRestNeverSuppliesEnergyInTotal) {
  TestSim sim;
  sim.add({0.0, 0.0, 0.0});
  const Plan plan = make_plan(sim.system);
  EnergyAccounts accounts;
  accounts.start(sim.state, 0.0);
  double energy = 0.0;
  for (const auto& [work, contact, method] : {std::array{1e-3, 0.0, 1e-3}, {-3e-3, -2e-3, 0.0}, {1e-3, -1e-3, 0.0}, {2e-3, 0.0, 1e-3}}) {
    Motion motion;
    motion.contact_work = work;
    energy += work;
    accounts.add_frame(plan, sim.system, sim.state, sim.state, motion, energy);
    EXPECT_NEAR(accounts.balance().contact, contact, 1e-18);
    EXPECT_NEAR(accounts.balance().method, method, 1e-18);
    EXPECT_NEAR(accounts.balance().sum(), accounts.balance().change, 1e-18);
  }
}

// A dashpot dissipates nothing that a part of the scene without dashpots loses, and no more than its own part loses.
TEST(EnergyAccounts, DashpotsDoNotDissipateWhatOtherPartsOfTheSceneLose) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.add({0.0, 0.0, 0.0}, 2.0, {1.0, 0.0, 0.0});
  const PointId damped = sim.add({5.0, -1.0, 0.0}, 2.0, {1.0, 0.0, 0.0});
  sim.join(damped, sim.nail({5.0, 0.0, 0.0}), 1.0, 1.0, 100.0);
  initialize_ledger(sim.system, sim.state);
  const Plan plan = make_plan(sim.system);
  for (const double end_speed : {1.0, 0.5}) {
    EnergyAccounts accounts;
    accounts.start(sim.state, 2.0);
    State end = sim.state;
    end.time = 1.0 / 60.0;
    end.velocity[0] = Vec3(0.0);
    end.velocity[1].x = end_speed;
    accounts.add_frame(plan, sim.system, sim.state, end, {}, end_speed * end_speed);
    EXPECT_NEAR(accounts.balance().dashpots, end_speed * end_speed - 1.0, 1e-15);
    EXPECT_NEAR(accounts.balance().method, -1.0, 1e-15);
  }
}

}  // namespace
}  // namespace hooke
