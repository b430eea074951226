// The energy balance of single frames and of short runs.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "lab/accuracy/accuracy_meter.h"
#include "scene/parameters.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "sim/plan/plan.h"
#include "sim/step/divergence.h"
#include "support/accuracy_scenes.h"
#include "support/flat_scene.h"
#include "support/measured_lab.h"

namespace hooke {
namespace {

// A point that rests is lifted and set down by 1 mJ in turn: what contact supplies in a frame is due to the method, and does not make up
// for what it has dissipated.
TEST(EnergyAccounts, ContactWithWhatIsAtRestSuppliesNoEnergy) {
  TestSim sim;
  sim.add({0.0, 0.0, 0.0});
  const Plan plan = make_plan(sim.system);
  EnergyAccounts accounts;
  accounts.start(sim.state, 0.0);
  double energy = 0.0;
  for (const auto& [work, contact, method] :
       {std::array{1e-3, 0.0, 1e-3}, {-3e-3, -3e-3, 1e-3}, {1e-3, -3e-3, 2e-3}, {-2e-3, -5e-3, 2e-3}}) {
    Motion motion;
    motion.energy[EnergyCause::Contact] = work;
    energy += work;
    accounts.add_frame(plan, sim.state, sim.state, motion, energy);
    EXPECT_NEAR(accounts.balance().ledger[EnergyCause::Contact], contact, 1e-18);
    EXPECT_NEAR(accounts.balance().method(), method, 1e-18);
    EXPECT_NEAR(accounts.balance().ledger.sum() + accounts.balance().method(), accounts.balance().change, 1e-18);
  }
}

// What contact supplies in a frame, in which a dashpot acts on the same points, is a part of what the dashpot took.
TEST(EnergyAccounts, WhatOnlyTakesEnergyReturnsWhatAnotherTook) {
  using enum EnergyCause;
  EnergyLedger frame;
  frame.add(Hand, 1.0);
  frame.add(Contact, 1.0);
  frame.add(Dashpots, -3.0);
  frame.add(Drag, -1.0);
  frame.add(StrainLimit, 2.0);
  EnergyLedger ledger = explained(frame, true);
  EXPECT_EQ(ledger[Hand], 1.0);
  EXPECT_EQ(ledger[StrainLimit], 2.0);
  EXPECT_EQ(ledger[Contact], 0.0);
  EXPECT_DOUBLE_EQ(ledger[Dashpots], -2.25);
  EXPECT_DOUBLE_EQ(ledger[Drag], -0.75);
  EXPECT_DOUBLE_EQ(ledger.sum(), frame.sum());

  ledger = explained(frame, false);
  EXPECT_DOUBLE_EQ(ledger[Dashpots], -0.75);
  EXPECT_EQ(ledger[StrainLimit], 0.0);
  frame.add(StrainLimit, 5.0);
  ledger = explained(frame, false);
  EXPECT_EQ(ledger[Dashpots], 0.0);
  EXPECT_EQ(ledger.sum(), 1.0);
}

// A dashpot between a point that the hand moves at a constant speed and a free one: of the work of the hand, it takes what does not move
// the free one.
TEST(EnergyAccounts, ADashpotToTheHandTakesWhatItDissipates) {
  constexpr double mass = 0.5, damping = 2.0, speed = 0.8, frame = 1.0 / 60.0;
  constexpr int frames = 15;
  for (const char* method : {"velocity_verlet", "velocity_verlet_explicit", "blanes_moan4"}) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId held = sim.add({0.0, 0.0, 0.0});
    sim.join(held, sim.add({1.0, 0.0, 0.0}, mass), 0.0, 1.0, damping);
    Scene scene = scene_of(sim, {});
    scene.settings.integrator = find_integrator(method);
    scene.settings.substeps = 40;
    Lab lab = measured_lab(scene, AccuracyMode::Frame);
    for (int i = 1; i <= frames; ++i) {
      const Vec3 target(-speed * frame * i, 0.0, 0.0);
      if (i == 1) lab.submit(GrabPoint{{.point = held, .kind = GrabKind::Hold, .target = target}});
      lab.submit(MoveHand{target});
      ASSERT_TRUE(lab.step());
    }
    const double taken = 0.5 * mass * speed * speed * (1.0 - std::exp(-2.0 * damping * frames * frame / mass));
    EXPECT_NEAR(lab.accuracy().energy.ledger[EnergyCause::Dashpots], -taken, 1e-4 * taken) << method;
  }
}

// Two points that separate at 1 m/s: 1 W, and 10 W after the edit.
TEST(EnergyAccounts, AnEditOfADashpotAppliesFromTheNextFrameOn) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.join(sim.add({0.0, 0.0, 0.0}, 1e6, {-0.5, 0.0, 0.0}), sim.add({1.0, 0.0, 0.0}, 1e6, {0.5, 0.0, 0.0}), 0.0, 1.0, 1.0);
  Lab lab = measured_lab(scene_of(sim, {}), AccuracyMode::Frame);
  constexpr double frame = 1.0 / 60.0;
  ASSERT_TRUE(lab.step());
  EXPECT_NEAR(lab.accuracy().energy.ledger[EnergyCause::Dashpots], -frame, 1e-6);
  lab.submit(Command(SetParameter{find_parameter("damping"), 10.0}));
  ASSERT_TRUE(lab.step());
  EXPECT_NEAR(lab.accuracy().energy.ledger[EnergyCause::Dashpots], -11.0 * frame, 1e-6);
}

// A net that swings, with drag, dashpots and a force that depends on velocity: what is not explained falls with the step as fast as the
// error of the method, or as that of the quadrature, which is of second order at least.
TEST(EnergyAccounts, TheShareOfTheMethodGoesToZeroWithTheStep) {
  for (const Integrator& method : integrators()) {
    if (method.step == nullptr || &method == find_integrator("explicit_euler")) continue;
    std::array<double, 2> share{};
    for (int i = 0; i < 2; ++i) {
      TestSim sim = net(4, 1e2, 0.5);
      sim.system.drag = 1.0;
      Force brake{.term = find_force_term("mass_center"), .values = default_values(*find_force_term("mass_center"))};
      sim.system.forces.push_back(brake);
      Lab lab = measured_lab(scene_of(sim, {.integrator = &method, .substeps = i == 0 ? 20 : 80}), AccuracyMode::Frame);
      for (int frame = 0; frame < 60; ++frame) ASSERT_TRUE(lab.step());
      const EnergyBalance balance = lab.accuracy().energy;
      share[i] = std::abs(balance.method()) / std::abs(balance.ledger[EnergyCause::Dashpots] + balance.ledger[EnergyCause::Drag]);
    }
    EXPECT_LT(share[1], method.order == 1 ? 0.4 * share[0] : std::max(0.12 * share[0], 1e-9)) << method.id << ' ' << share[0];
    EXPECT_LT(share[1], method.order == 1 ? 0.1 : 1e-3) << method.id;
  }
}

// [J], of a drag of 1/s in frames of 1/60 s of a motion that starts from rest, by the trapezoidal rule.
double loss_by_drag(Lab& lab, int frames) {
  double loss = 0.0, power = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    EXPECT_TRUE(lab.step());
    const double before = power;
    power = 2.0 * compute_energy(lab.scene().system, lab.scene().state).kinetic;
    loss += 0.5 * (before + power) / 60.0;
  }
  return loss;
}

// Implicit Euler damps: the balance separates what it loses from what drag takes.
TEST(EnergyAccounts, TheLossOfTheMethodIsSeparatedFromThatOfTheScene) {
  TestSim sim = net(8, 1e2, 0.0);
  sim.system.drag = 1.0;
  Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("implicit_euler"), .substeps = 4}), AccuracyMode::Frame);
  const double by_drag = loss_by_drag(lab, 60);
  const EnergyBalance balance = lab.accuracy().energy;
  EXPECT_NEAR(balance.ledger[EnergyCause::Drag], -by_drag, 0.2 * by_drag);
  EXPECT_LT(balance.method(), 0.0);
  EXPECT_EQ(balance.ledger[EnergyCause::Dashpots], 0.0);
}

// A fall through air: the energy of Euler methods, whose velocities are half a step behind their positions, is off by m g h v / 2, far more
// in the first frame, which is repeated, than what drag takes there, and far less in the others.
TEST(EnergyAccounts, TheLagOfTheVelocityIsNotTakenForDragNorTheReverse) {
  for (const char* method :
       {"explicit_euler", "symplectic_euler", "velocity_verlet", "dop853", "xpbd", "implicit_euler", "baraff_witkin"}) {
    TestSim sim;
    sim.add(Vec3(0.0), 2.0);
    sim.system.drag = 0.5;
    Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator(method), .substeps = 20}), AccuracyMode::Frame);
    for (int frame = 0; frame < 36; ++frame) ASSERT_TRUE(lab.step());
    // v = (g / c) (1 - e^(-c t))
    const double g = 9.81, c = 0.5, t = 0.6, e = std::exp(-c * t);
    const double by_drag = 2.0 * g * g / c * (t - 2.0 * (1.0 - e) / c + (1.0 - e * e) / (2.0 * c));
    const EnergyBalance balance = lab.accuracy().energy;
    EXPECT_NEAR(balance.ledger[EnergyCause::Drag], -by_drag, 0.02 * by_drag) << method;
    EXPECT_NEAR(balance.method(), 0.0, 0.1 * by_drag) << method;
  }
}

// A fall without motion along the dashpot: implicit Euler loses m g^2 h^2 / 2 in each step, the dashpot nothing.
TEST(EnergyAccounts, ADashpotThatDoesNotActTakesNothing) {
  TestSim sim;
  sim.join(sim.add(Vec3(0.0)), sim.add({1.0, 0.0, 0.0}), 10.0, 1.0, 1.0);
  Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("implicit_euler"), .substeps = 1}), AccuracyMode::Frame);
  for (int frame = 0; frame < 25; ++frame) ASSERT_TRUE(lab.step());
  const EnergyBalance balance = lab.accuracy().energy;
  EXPECT_LT(balance.change, -0.5);
  EXPECT_NEAR(balance.method(), balance.change, 1e-9);
}

// A pendulum that the method damps by two thirds, with a drag or a dashpot that hardly acts.
TEST(EnergyAccounts, TheLossOfTheMethodIsNotThatOfAWeakDragOrDashpot) {
  for (const auto& [drag, damping] : {std::pair{1e-9, 0.0}, {0.0, 1e-9}}) {
    TestSim sim;
    sim.system.gravity = {0.0, -9.81, 0.0};
    sim.join(sim.nail(Vec3(0.0)), sim.add({1.0, 0.0, 0.0}), 1e4, 1.0, damping);
    sim.system.drag = drag;
    Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("implicit_euler"), .substeps = 1}), AccuracyMode::Frame);
    for (int frame = 0; frame < 240; ++frame) ASSERT_TRUE(lab.step());
    const EnergyBalance balance = lab.accuracy().energy;
    EXPECT_LT(balance.change, -5.0);
    EXPECT_NEAR(balance.method(), balance.change, 1e-5);
    EXPECT_NEAR(balance.ledger[EnergyCause::Drag] + balance.ledger[EnergyCause::Dashpots], 0.0, 1e-5);
  }
}

TEST(EnergyAccounts, DragAndDashpotsAreSeparated) {
  TestSim sim = net(8, 1e2, 0.5);
  sim.system.drag = 1.0;
  Lab lab = measured_lab(scene_of(sim, {.integrator = find_integrator("velocity_verlet"), .substeps = 8}), AccuracyMode::Frame);
  const double by_drag = loss_by_drag(lab, 120);
  const EnergyBalance balance = lab.accuracy().energy;
  EXPECT_NEAR(balance.ledger[EnergyCause::Drag], -by_drag, 0.1 * by_drag);
  EXPECT_LT(balance.ledger[EnergyCause::Dashpots], 0.0);
}

}  // namespace
}  // namespace hooke
