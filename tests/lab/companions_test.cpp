// Runs beside the run: each is what it is alone, and the run is as without them.
#include "lab/accuracy/companions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"
#include "sim/methods/integrator.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

Companion companion(const char* method, int substeps) {
  return {.name = method, .settings = {.integrator = find_integrator(method), .substeps = substeps}};
}

TEST(Companions, EachIsTheRunWithItsSettingsAndTheRunIsAsWithoutThem) {
  const Scene scene = load_scene(find_scene("grid_4x4")).scene;
  Scene other = scene;
  other.settings.integrator = find_integrator("runge_kutta4");
  other.settings.substeps = 7;
  Lab lab(scene), without(scene), alone(other);
  submit_and_apply(lab, SetCompanions{{companion("runge_kutta4", 7), {.name = "same", .settings = scene.settings}}});
  for (int frame = 0; frame < 40; ++frame) {
    run(lab, 1);
    run(without, 1);
    run(alone, 1);
    lab.publish();
    const CompanionsStatus& status = lab.status()->companions;
    ASSERT_EQ(status.list.size(), 2u);
    EXPECT_EQ(*status.list[0].positions, alone.scene().state.position);
    EXPECT_EQ(status.list[0].distance,
              weighted_distance(lab.scene().system, lab.scene().state.position, alone.scene().state.position, 1.0).rms);
    EXPECT_EQ(status.list[1].distance, 0.0);
    EXPECT_EQ(lab.scene().state, without.scene().state);
  }
  const CompanionTable& table = *lab.status()->companions.table;
  ASSERT_EQ(table.times.size(), 40u);
  EXPECT_EQ(table.times.back(), lab.scene().state.time);
  EXPECT_EQ(table.distances[0].back(), lab.status()->companions.list[0].distance);
}

// The frame with which `auto` tests its choice is the frame of the companion, which must not take another step.
TEST(Companions, OneWithTheMethodAutoIsTheRunWithIt) {
  for (const char* id : {"grid_4x4", "rope_64"}) {
    const Scene scene = load_scene(find_scene(id)).scene;
    Scene automatic = scene;
    automatic.settings.integrator = &automatic_method();
    automatic.settings.tolerance = 1e-2;
    Lab lab(scene), alone(automatic);
    submit_and_apply(lab, SetCompanions{{{.name = "auto", .settings = automatic.settings}}});
    for (int frame = 0; frame < 40; ++frame) {
      run(lab, 1);
      run(alone, 1);
      lab.publish();
      ASSERT_EQ(*lab.status()->companions.list[0].positions, alone.scene().state.position) << id << ", frame " << frame;
    }
  }
}

TEST(Companions, StartAgainAfterAnEdit) {
  Lab lab(load_scene(find_scene("grid_4x4")).scene);
  submit_and_apply(lab, SetCompanions{{companion("runge_kutta4", 7)}});
  run(lab, 10);
  lab.submit(SetParameter{find_parameter("stiffness"), 50.0});
  run(lab, 1);
  lab.publish();
  ASSERT_EQ(lab.status()->companions.list.size(), 1u);
  EXPECT_EQ(lab.status()->companions.list[0].name, "runge_kutta4");
  EXPECT_EQ(lab.status()->companions.table->times.size(), 1u);
  // they follow the edited scene from its present state
  EXPECT_LT(lab.status()->companions.list[0].distance, 1e-3);
  EXPECT_GT(lab.status()->companions.since, 0.1);
}

TEST(Companions, OneThatDivergesIsReported) {
  Scene scene = load_scene(find_scene("grid_4x4")).scene;
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->stiffness = 1e4;
  scene.settings.substeps = 200;
  Lab lab(scene);
  submit_and_apply(lab, SetCompanions{{companion("explicit_euler", 1)}});
  run(lab, 300);
  lab.publish();
  EXPECT_TRUE(lab.status()->companions.list[0].has_diverged);
  EXPECT_TRUE(std::isnan(lab.status()->companions.table->distances[0].back()));
  EXPECT_FALSE(lab.status()->snapshot->divergence);
}

TEST(Companions, AreComputedWhileTheFrameAfterThemWaits) {
  Lab lab(load_scene(find_scene("grid_4x4")).scene);
  submit_and_apply(lab, SetCompanions{{companion("runge_kutta4", 50)}});
  lab.submit(SetRunning{true});
  // one substep in each call
  for (int call = 0; call < 2000; ++call) {
    lab.advance(1e-3, [] { return false; });
    const auto& status = *lab.status();
    if (const auto& table = status.companions.table) {
      EXPECT_GE(table->times.back(), status.snapshot->state.time - 1.01 / 60.0);
    }
  }
  ASSERT_TRUE(lab.status()->companions.table);
  EXPECT_GT(lab.status()->companions.table->times.size(), 3u);
}

}  // namespace
}  // namespace hooke
