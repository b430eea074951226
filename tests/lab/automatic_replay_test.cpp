// Runs with the method `auto` are recorded, replayed and undone like any other.
#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/automatic/automatic.h"
#include "sim/hash.h"
#include "support/apply_now.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

// The recording starts in the middle of a run, where the choice is remembered, and contains events of every kind.
TEST(AutomaticReplay, HasTheSameBits) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "auto.hookelog";
  Lab lab(load_scene(find_scene("rope_64")).scene);
  const auto step = [&](int frames) {
    for (int i = 0; i < frames; ++i) lab.step();
  };
  lab.submit(SetIntegrator{&automatic_method()});
  step(7);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  step(6);
  lab.submit(SetParameter{find_parameter("stiffness"), 300.0});
  step(3);
  lab.submit(SetParameter{&tolerance_parameter, 1e-6});
  step(4);
  const PointId end = lab.scene().system.points()[63].id;
  lab.submit(GrabPoint{{.point = end, .kind = GrabKind::Hold, .target = lab.scene().state.position[63]}});
  for (int i = 0; i < 4; ++i) {
    lab.submit(MoveHand{lab.scene().state.position[63] + Vec3(0.02, 0.05, 0.0)});
    step(1);
  }
  lab.submit(ReleaseHand{});
  lab.submit(SetParameter{find_parameter("budget"), 0.02});
  step(4);
  lab.submit(Undo{});
  lab.submit(Undo{});
  step(3);
  lab.submit(GoToStart{});
  step(3);
  lab.submit(Record{});
  apply_now(lab);
  EXPECT_EQ(lab.status()->recording.error, "");

  auto recording = std::make_shared<const Recording>(parse_recording(contents(file), "test"));
  Lab played(*recording->start, KeepStart::No);
  played.submit(Play{std::move(recording)});
  apply_now(played);
  while (played.is_playing()) played.step();
  EXPECT_EQ(played.difference(), "");
  EXPECT_EQ(hash_state(played.scene().state), hash_state(lab.scene().state));
  EXPECT_EQ(played.scene().state.memory, lab.scene().state.memory);
}

TEST(AutomaticReplay, AToleranceIsNotTakenOverByAMethodToWhichItMeansSomethingElse) {
  Lab lab(load_scene(find_scene("two_masses")).scene);
  lab.submit(SetIntegrator{&automatic_method()});
  lab.submit(SetParameter{&tolerance_parameter, 1e-2});
  apply_now(lab);
  EXPECT_EQ(lab.scene().settings.tolerance, 1e-2);
  lab.submit(SetIntegrator{find_integrator("dop853")});
  apply_now(lab);
  EXPECT_FALSE(lab.scene().settings.tolerance);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().settings.integrator, &automatic_method());
  EXPECT_EQ(lab.scene().settings.tolerance, 1e-2);
}

}  // namespace
}  // namespace hooke
