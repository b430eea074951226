// The hand in a run: its top speed, colliders that it carries, and properties that follow a slider.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "edit/command.h"
#include "edit/history.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/model/grab.h"
#include "support/apply_now.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;  // [s]

TEST(Hand, WithAMaximumSpeedLagsAndReportsTheDistance) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.hand_speed = 3.0;
  for (const GrabKind kind : {GrabKind::Hold, GrabKind::Pull}) {
    Lab lab(scene);
    const Vec3 from = scene.state.position[63], target = from + Vec3(0.0, 0.0, 1.0);
    lab.submit(GrabPoint{{.point = scene.system.points()[63].id, .kind = kind, .target = from}});
    ASSERT_TRUE(lab.step());
    lab.submit(MoveHand{target});
    run(lab, 1);
    EXPECT_NEAR(glm::distance(lab.scene().state.hand.position, from), 3.0 * frame, 1e-12);
    lab.publish();
    EXPECT_NEAR(lab.status()->run.hand_lag, 1.0 - 3.0 * frame, 1e-12);
    run(lab, 20);
    lab.publish();
    EXPECT_EQ(lab.scene().state.hand.position, target);
    EXPECT_EQ(lab.status()->run.hand_lag, 0.0);
  }
}

TEST(MassFollowsRadius, ScalesBySquareWhereSwitchedOnAndIsUndone) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  const Scene start = scene;
  for (const bool follows : {false, true}) {
    scene.defaults.mass_follows_radius = follows;
    const Point before = scene.system.points()[5];
    Lab lab(scene);
    lab.submit(SetPointProperty{PointProperty::Radius, {{before.id, 3.0 * before.radius}}});
    apply_now(lab);
    EXPECT_DOUBLE_EQ(lab.scene().system.points()[5].mass, (follows ? 9.0 : 1.0) * before.mass);
    submit_and_apply(lab, Undo{});
    EXPECT_EQ(lab.scene().system, scene.system);
    submit_and_apply(lab, Redo{});
    EXPECT_DOUBLE_EQ(lab.scene().system.points()[5].mass, (follows ? 9.0 : 1.0) * before.mass);

    lab.submit(SetParameter{find_parameter("radius"), 0.5});
    apply_now(lab);
    EXPECT_EQ(lab.scene().system.points()[6].radius, 0.5);
    submit_and_apply(lab, Undo{});
    submit_and_apply(lab, Undo{});
    EXPECT_EQ(lab.scene().system, scene.system);
  }
}

TEST(MassFollowsRadius, ADragOfItsSliderIsOneStepWithTheMemoryOfOne) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.defaults.mass_follows_radius = true;
  History one, drag;
  Scene first = scene, last = scene;
  const auto set = [](History& history, Scene& on, double radius) {
    Effect effect;
    history.record("radius", apply(on, SetParameter{find_parameter("radius"), radius}, effect), 7);
  };
  set(one, first, 0.05);
  for (int i = 1; i <= 100; ++i) set(drag, last, 0.001 * i);
  EXPECT_EQ(drag.done(), 1u);
  EXPECT_EQ(drag.bytes(), one.bytes());
  drag.go_to(0, last);
  EXPECT_EQ(last.system, scene.system);
}

TEST(GrabbedCollider, FollowsTheHandDuringARunAndReturnsByOneUndo) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.colliders = {{.shape = Sphere{{0.5, -0.6, -1.0}, 0.2}}};
  Lab lab(scene);
  lab.submit(GrabCollider{{0, {0.5, -0.6, -1.0}}}, 3);
  for (int i = 1; i <= 30; ++i) {
    lab.submit(MoveHand{{0.5, -0.6, -1.0 + 0.05 * i}}, 3);
    ASSERT_TRUE(lab.step());
    EXPECT_NEAR(anchor_of(lab.scene().state.hand.collider->shape).z, -1.0 + 0.05 * i, 1e-12);
  }
  lab.submit(ReleaseHand{}, 3);
  ASSERT_TRUE(lab.step());
  EXPECT_FALSE(lab.scene().state.hand.collider);
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system.colliders, scene.system.colliders);
}

TEST(GrabbedCollider, FollowsTheMouseWhileAScriptedHandActs) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.colliders = {{.shape = Sphere{{0.5, -0.6, -1.0}, 0.2}}};
  const ScriptedHand hand{.point = scene.system.points()[63].id,
                          .from = scene.state.position[63],
                          .center = scene.state.position[63] - Vec3(0.2, 0.0, 0.0),
                          .speed = 1.0,
                          .seconds = 0.25};
  scene.system.scripted_hand = hand;
  Lab lab(scene), without(scene);
  lab.submit(GrabCollider{{0, {0.5, -0.6, -1.0}}}, 3);
  for (int i = 1; i <= 30; ++i) {
    lab.submit(MoveHand{{0.5, -0.6, -1.0 - 0.05 * i}}, 3);
    ASSERT_TRUE(lab.step());
    ASSERT_TRUE(without.step());
    EXPECT_NEAR(anchor_of(lab.scene().state.hand.collider->shape).z, -1.0 - 0.05 * i, 1e-12);
    if (i <= 15) {
      EXPECT_LT(glm::distance(lab.scene().state.position[63], position_at(hand, i * frame)), 1e-12) << i;
    }
  }
  lab.submit(ReleaseHand{}, 3);
  ASSERT_TRUE(lab.step());
  ASSERT_TRUE(without.step());
  // the ball moved away from the sheet, so nothing else is affected
  EXPECT_EQ(lab.scene().state.position, without.scene().state.position);
  EXPECT_EQ(lab.scene().state.supply.net_input, without.scene().state.supply.net_input);
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system, scene.system);
}

TEST(MovingColliders, AreSavedAndBoxesCannotSpin) {
  const Scene scene = parse(R"({"hooke": 1, "hand_speed": 5, "strain_limit_percent": 12.5, "break_strain": 0.5, "colliders": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1, "spin": [0, 3, 0]},
    {"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "spin": [0, -2, 0], "oscillate": [0, 0.1, 0], "frequency": 3, "phase": 0.5},
    {"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "belt": [1, 0, 0]}]})");
  EXPECT_EQ(scene.system.colliders[1].path, (ColliderPath{{0.0, 0.1, 0.0}, 3.0, 0.5, {0.0, -2.0, 0.0}, Vec3(0.0)}));
  EXPECT_EQ(parse(format_scene(scene)).system, scene.system);
  EXPECT_THROW(parse(R"({"hooke": 1, "colliders": [{"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "spin": [0, 1, 0]}]})"), InputError);
  EXPECT_THROW(parse(R"({"hooke": 1, "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "spin": [1, 0, 0]}]})"),
               InputError);
}

}  // namespace
}  // namespace hooke
