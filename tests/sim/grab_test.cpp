// Grabs: a held point follows the hand, a pulled point is attached by a spring, and a released point keeps its velocity.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/forces/hand.h"
#include "sim/model/grab.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

class Grabbed : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Grabbed, testing::ValuesIn(every_method()), method_name);

// A mass of 0.5 kg attached to a point that the hand grabs; the hand starts at the point.
struct Held {
  TestSim sim;
  PointId held, mass;
  Held() : held(sim.add({0.1, 0.2, 0.3}, 2.0)), mass(sim.add({0.1, -0.8, 0.3}, 0.5)) {
    sim.join(held, mass, 50.0, 0.9, 0.3);
    sim.system.drag = 0.5;
    grab(GrabKind::Hold, sim.position(held));
  }
  void grab(GrabKind kind, const Vec3& target) {
    sim.system.grab = Grab{.point = held, .kind = kind, .stiffness = 80.0};
    sim.state.hand = {.position = sim.position(held), .target = target};
  }
};

TEST_P(Grabbed, HeldPointFollowsTheHandOverTheSubsteps) {
  Held scene;
  const Vec3 from = scene.sim.position(scene.held), target(0.7, -0.4, 1.3);
  scene.grab(GrabKind::Hold, target);
  Plan plan = make_plan(scene.sim.system);
  Frame frame;
  State state = scene.sim.state;
  frame.begin(plan, scene.sim.system, {.integrator = &method(), .frame_rate = 60.0, .substeps = 7}, state);
  for (int k = 1; k <= 7; ++k) {
    while (frame.substeps_done() < k) frame.substep(plan);
    unpack(plan, frame.motion(), state);
    EXPECT_LT(glm::distance(state.position[0], from + k / 7.0 * (target - from)), 1e-14) << "substep " << k;
  }
  frame.end(plan, state);
  EXPECT_EQ(state.position[0], target);
  EXPECT_LT(glm::distance(state.velocity[0], (target - from) / frame_time), 1e-11);
}

TEST_P(Grabbed, HeldPointIsAtRestWhileTheHandIs) {
  Held scene;
  const Vec3 place = scene.sim.position(scene.held);
  for (int i = 0; i < 30; ++i) scene.sim.run(method(), frame_time, 5);
  EXPECT_EQ(scene.sim.position(scene.held), place);
  EXPECT_EQ(scene.sim.velocity(scene.held), Vec3(0.0));
}

// a mass on a spring whose end moves at V: x = V t + l0 + A cos(w t) - V / w sin(w t)
TEST_P(Grabbed, HeldEndDrivesItsSprings) {
  const double w = 10.0, speed = 1.5, seconds = 1.0;
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId held = sim.add(Vec3(0.0)), mass = sim.add({1.1, 0.0, 0.0}, 0.5);
    sim.join(held, mass, 50.0, 1.0);
    sim.system.grab = Grab{.point = held, .kind = GrabKind::Hold};
    sim.state.hand.target = {speed * seconds, 0.0, 0.0};
    sim.run(method(), seconds, steps);
    const double exact = 1.0 + speed * seconds + 0.1 * std::cos(w * seconds) - speed / w * std::sin(w * seconds);
    return std::abs(sim.position(mass).x - exact);
  };
  expect_order(error, asymptotic_steps(method().order), method().order, 0.2);
}

TEST_P(Grabbed, ReleasedPointKeepsTheVelocityOfTheHand) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId point = sim.add(Vec3(0.0));
  Vec3 hand(0.0);
  const Vec3 displacement(0.05, 0.02, -0.01);
  sim.system.grab = Grab{.point = point, .kind = GrabKind::Hold};
  for (int i = 0; i < 3; ++i) {
    sim.state.hand.target = hand += displacement;
    sim.run(method(), frame_time, 4);
  }
  sim.system.grab.reset();
  sim.run(method(), frame_time, 4);
  EXPECT_LT(glm::distance(sim.position(point), 4.0 * displacement), 1e-13);
  EXPECT_LT(glm::distance(sim.velocity(point), displacement / frame_time), 1e-11);
}

TEST_P(Grabbed, NailStaysWhereItIsReleased) {
  TestSim sim;
  sim.system.drag = 0.3;
  const PointId nail = sim.nail(Vec3(0.0));
  sim.system.grab = Grab{.point = nail, .kind = GrabKind::Hold};
  sim.state.hand.target = {0.3, 0.2, 0.1};
  sim.run(method(), frame_time, 4);
  EXPECT_EQ(sim.position(nail), Vec3(0.3, 0.2, 0.1));
  sim.system.grab.reset();
  for (int i = 0; i < 10; ++i) sim.run(method(), frame_time, 4);
  EXPECT_EQ(sim.position(nail), Vec3(0.3, 0.2, 0.1));
  EXPECT_EQ(sim.velocity(nail), Vec3(0.0));
}

TEST_P(Grabbed, InTwoDimensionsStaysInThePlane) {
  TestSim sim;
  sim.system.dimensions = 2;
  const PointId point = sim.add(Vec3(0.0));
  for (const GrabKind kind : {GrabKind::Hold, GrabKind::Pull}) {
    sim.system.grab = Grab{.point = point, .kind = kind};
    sim.state.hand.target = {0.3, 0.2, 0.1};
    sim.run(method(), frame_time, 4);
    EXPECT_EQ(sim.position(point).z, 0.0);
    EXPECT_EQ(sim.velocity(point).z, 0.0);
  }
}

// pulled by a hand that moves at V: x = V t - V / w sin(w t), w^2 = k / m
TEST_P(Grabbed, PulledPointFollowsASpringToTheHand) {
  const double w = 10.0, seconds = 0.5;
  const Vec3 speed(1.5, -0.5, 0.8);
  const auto error = [&](int steps) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId point = sim.add({0.1, 0.0, 0.0}, 0.5);
    sim.state.hand = {.target = seconds * speed};
    sim.system.grab = Grab{.point = point, .kind = GrabKind::Pull, .stiffness = 50.0};
    sim.run(method(), seconds, steps);
    const Vec3 exact = seconds * speed - std::sin(w * seconds) / w * speed + std::cos(w * seconds) * Vec3(0.1, 0.0, 0.0);
    return glm::distance(sim.position(point), exact);
  };
  expect_order(error, asymptotic_steps(method().order), method().order, 0.2);
}

// A scripted hand that moves the held point around a circle from the third frame to the seventh.
ScriptedHand circling(const Held& scene) {
  return {.point = scene.held,
          .from = {0.3, 0.2, 0.3},
          .center = {0.1, 0.2, -0.2},
          .axis = {0.0, 1.0, 0.0},
          .speed = 4.0,
          .begin = 2.0 * frame_time,
          .seconds = 4.6 * frame_time};
}

TEST_P(Grabbed, AScriptedHandHoldsBitForBitLikeAMouse) {
  Held scripted, by_hand;
  scripted.sim.system.grab.reset();
  scripted.sim.system.scripted_hand = circling(scripted);
  initialize_supply(scripted.sim.system, scripted.sim.state);
  by_hand.sim.system.grab.reset();
  initialize_supply(by_hand.sim.system, by_hand.sim.state);

  Plan plan = make_plan(scripted.sim.system);  // one for all frames: the scripted hand grabs and releases without an edit
  Frame frame;
  State& state = scripted.sim.state;
  for (int i = 0; i < 10; ++i) {
    const Settings settings{.integrator = &method(), .frame_rate = 60.0, .substeps = 5, .tolerance = 1e9};
    state.memory = {.step = 1e9, .error = 1e-4};
    frame.begin(plan, scripted.sim.system, settings, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
    state.memory = {};

    by_hand.sim.system.grab.reset();
    if (i >= 2 && i < 7) by_hand.grab(GrabKind::Hold, position_at(circling(by_hand), (i + 1) * frame_time));
    by_hand.sim.run(method(), frame_time, 5);

    EXPECT_EQ(plan.hand.held.has_value(), i >= 2 && i < 7) << "frame " << i;
    for (Index p = 0; p < 2; ++p) EXPECT_LT(glm::distance(state.position[p], by_hand.sim.state.position[p]), 1e-13) << "frame " << i;
    EXPECT_NEAR(state.supply.net_input, by_hand.sim.state.supply.net_input, 1e-9) << "frame " << i;
  }
  EXPECT_GT(state.supply.scale, 1.0);
}

TEST(Hand, TheMouseTakesPrecedenceOverAScript) {
  Held scene;
  scene.sim.system.scripted_hand = circling(scene);
  scene.grab(GrabKind::Hold, {5.0, 0.0, 0.0});
  const auto grab_in_frame = [&](int frame) {
    scene.sim.state.time = frame * frame_time;
    return active_grab(scene.sim.system, scene.sim.state, frame_time);
  };
  EXPECT_EQ(grab_in_frame(3)->target, Vec3(5.0, 0.0, 0.0));
  scene.sim.system.grab.reset();
  EXPECT_EQ(grab_in_frame(3)->target, position_at(circling(scene), 3.0 * frame_time + frame_time));
  EXPECT_FALSE(grab_in_frame(1));
  EXPECT_FALSE(grab_in_frame(7));
}

// at a radius of 0.2 m and 0.5 m about y: |p| = sqrt(0.29), counter-clockwise seen from above
TEST(Hand, AScriptMovesAroundItsCircleAtItsSpeed) {
  const ScriptedHand hand = circling(Held());
  EXPECT_LT(glm::distance(position_at(hand, hand.begin), hand.from), 1e-15);
  const double radius = std::sqrt(0.29), round = 2.0 * 3.14159265358979323846 * radius / hand.speed;
  EXPECT_LT(glm::distance(position_at(hand, hand.begin + round), hand.from), 1e-14);
  const Vec3 moved = position_at(hand, hand.begin + 1e-6) - hand.from;
  EXPECT_NEAR(glm::length(moved), 4e-6, 1e-11);
  EXPECT_GT(glm::cross(hand.from - hand.center, moved).y, 0.0);
}

// the force of the hand on the scene at the start of a frame of one second
Vec3 force_in(const TestSim& sim) {
  Plan plan = make_plan(sim.system);
  prepare_hand(plan, sim.system, sim.state, 1.0);
  Motion motion;
  pack(plan, sim.state, motion);
  return hand_force(plan, motion);
}

TEST(Hand, ForceIsWhatTheGrabExerts) {
  Held scene;
  const Vec3 weight = 2.0 * scene.sim.system.gravity;
  // the spring is stretched by 0.1 m and pulls the held point down
  EXPECT_LT(glm::distance(force_in(scene.sim), -weight + Vec3(0.0, 5.0, 0.0)), 1e-12);
  // so does its dashpot while the mass moves down
  scene.sim.state.velocity[1] = {3.0, -2.0, 0.0};
  EXPECT_LT(glm::distance(force_in(scene.sim), -weight + Vec3(0.0, 5.6, 0.0)), 1e-12);
  scene.grab(GrabKind::Pull, Vec3(0.0));
  scene.sim.state.hand.position += Vec3(0.1, 0.0, 0.0);
  EXPECT_LT(glm::distance(force_in(scene.sim), Vec3(8.0, 0.0, 0.0)), 1e-12);
  scene.sim.system.grab.reset();
  EXPECT_EQ(force_in(scene.sim), Vec3(0.0));
}

// energy = initial energy + work of the hand, up to the error of the substeps, for any frame rate
TEST_P(Grabbed, TheWorkOfTheHandIsRecordedToTheOrderOfTheSubsteps) {
  struct Case {
    const char* name;
    GrabKind kind;
    bool nailed;
  };
  for (const Case& which : {Case{"pull", GrabKind::Pull, false}, {"hold", GrabKind::Hold, false}, {"hold a nail", GrabKind::Hold, true}}) {
    const auto missing = [&](int steps) {
      constexpr int frames = 8;
      Held scene;
      scene.sim.system.drag = 0.0;
      scene.sim.system.spring(0)->damping = 0.0;
      scene.sim.system.point(0).nailed = which.nailed;
      scene.grab(which.kind, scene.sim.position(scene.held));
      initialize_supply(scene.sim.system, scene.sim.state);
      for (int i = 1; i <= frames; ++i) {
        const double t = 1.0 * i / frames;
        scene.sim.state.hand.target = Vec3(0.1, 0.2, 0.3) + 0.2 * std::pow(std::sin(3.0 * t), 2) * Vec3(1.0, 0.5, 0.2);
        scene.sim.run(method(), 1.0 / frames, steps / frames);
      }
      EXPECT_GT(scene.sim.state.supply.scale, 0.1) << which.name;
      return std::abs(compute_energy(scene.sim.system, scene.sim.state).total() - scene.sim.state.supply.net_input);
    };
    // the trapezoidal rule limits every method to second order
    expect_order(missing, 512, std::min(2, method().order), 0.2);
  }
}

}  // namespace
}  // namespace hooke
