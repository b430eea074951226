// Gains of energy that contact, drag and dashpots dissipate meanwhile.
#include <gtest/gtest.h>

#include <string>

#include "sim/plan/plan.h"
#include "study/benchmark.h"
#include "study/hard_cases/monitored_run.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

struct MeasuredFrame {
  double speed = 0.0;                                          // [m/s], of 1 kg
  double contact_work = 0.0, dashpot_work = 0.0, limit = 0.0;  // [J]
};

std::string warning_after(std::initializer_list<MeasuredFrame> frames) {
  TestNetwork network;
  network.system.gravity = Vec3(0.0);
  network.system.drag = 1000.0;  // which would explain any loss
  network.add(Vec3(0.0), 1.0, {1.0, 0.0, 0.0});
  initialize_supply(network.system, network.state);
  const Settings settings{.integrator = find_integrator("runge_kutta4")};
  Plan plan = make_plan(network.system);
  plan.surface.on = true;  // something may touch
  State state = network.state;
  RunMonitor monitor(plan, settings, network.system, state, 0);
  for (const MeasuredFrame& frame : frames) {
    Motion motion;
    motion.energy[EnergyCause::Contact] = frame.contact_work;
    motion.energy[EnergyCause::Dashpots] = frame.dashpot_work;
    motion.energy[EnergyCause::StrainLimit] = frame.limit;
    monitor.begin_frame(network.system, settings, state);
    state.velocity[0].x = frame.speed;
    state.time += 1.0 / settings.frame_rate;
    monitor.end_frame(plan, settings, network.system, state, motion);
  }
  const auto warnings = monitor.warnings({});
  return warnings.empty() ? "" : warnings.front();
}

// The energy never rises.
TEST(HiddenGain, IsReported) {
  EXPECT_EQ(warning_after({{.speed = 0.8, .contact_work = -0.18}, {.speed = 0.6, .dashpot_work = -0.14}}), "");
  EXPECT_NE(warning_after({{.speed = 0.8, .contact_work = -0.30}}).find("24 % of the energy supplied (gain)"), std::string::npos);
  EXPECT_NE(warning_after({{.speed = 0.8, .dashpot_work = -0.30}}).find("24 % of the energy supplied (gain)"), std::string::npos);
  // a strain limit has supplied what it cannot have
  EXPECT_NE(warning_after({{.speed = 1.1, .limit = 0.105}}).find("(gain)"), std::string::npos);
}

// It balances what the method has lost in the same frame, and does not make up for what contact dissipates in another one.
TEST(HiddenGain, IsNotByContactThatSuppliesWhatTheMethodLoses) {
  EXPECT_EQ(warning_after({{.speed = 1.0, .contact_work = 0.3}}), "");
  EXPECT_NE(warning_after({{.speed = 1.0, .contact_work = 0.3}, {.speed = 0.8, .contact_work = -0.3}}).find("(gain)"), std::string::npos);
}

}  // namespace
}  // namespace hooke
