// Edits while a frame is in progress: what they copy, what they discard, and that the clock advances.
#include <gtest/gtest.h>

#include <filesystem>

#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "support/nets.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Scene hanging_sheet() {
  TestSim sim = cloth(8);
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  for (Index i = 0; i < scene.system.spring_count(); ++i) scene.system.spring(i)->stiffness = 50.0;  // stable at 10 substeps
  scene.system.colliders = {{.shape = Sphere{{0.5, -0.6, -1.0}, 0.2}}};
  scene.settings = {.integrator = find_integrator("velocity_verlet"), .frame_rate = 60.0, .substeps = 10};
  return scene;
}

constexpr double frame_time = 1.0 / 60.0;
const auto one_substep = [] { return false; };
const auto no_deadline = [] { return true; };

TEST(MovingHand, DoesNotCopyTheSystem) {
  for (const bool is_collider : {false, true}) {
    Lab lab(hanging_sheet());
    const PointId point = lab.scene().system.points()[60].id;
    const Vec3 start = is_collider ? anchor_of(lab.scene().system.colliders[0]) : lab.scene().state.position[60];
    lab.submit(SetRunning{true});
    if (is_collider)
      lab.submit(GrabCollider{{0, start}});
    else
      lab.submit(GrabPoint{{.point = point, .kind = GrabKind::Hold, .target = start}});
    lab.advance(frame_time, no_deadline);
    const auto system = lab.status()->snapshot->system;
    const long frames = lab.status()->run.frames;
    for (int i = 0; i < 100; ++i) {
      lab.submit(MoveHand{start - Vec3(0.0, 0.0, 0.002 * i)});
      lab.advance(frame_time, no_deadline);
      EXPECT_EQ(lab.status()->snapshot->system, system) << "move " << i;
    }
    EXPECT_GE(lab.status()->run.frames, frames + 99);
    // check that the hand did move something
    const Snapshot& now = *lab.status()->snapshot;
    const Vec3 end = is_collider ? anchor_of(current_collider(*now.system, now.state, 0)) : now.position(point);
    EXPECT_LT(end.z, start.z - 0.19);
  }
}

TEST(ShownEdits, ComputeNothingAndTheTimeIsMadeUpForLater) {
  Lab lab(hanging_sheet()), late(hanging_sheet());
  for (Lab* each : {&lab, &late}) {
    each->submit(SetRunning{true});
    each->advance(frame_time, no_deadline);
  }
  const auto before = lab.status();
  lab.submit(SetParameter{find_parameter("drag"), 3.0});
  lab.show_edits(frame_time);
  EXPECT_EQ(lab.status()->snapshot->system->drag, 3.0);
  EXPECT_EQ(lab.status()->run.frames, before->run.frames);
  EXPECT_EQ(hash_state(lab.status()->snapshot->state), hash_state(before->snapshot->state));
  lab.advance(0.0, no_deadline);
  late.submit(SetParameter{find_parameter("drag"), 3.0});
  late.advance(frame_time, no_deadline);
  EXPECT_EQ(lab.status()->run.frames, before->run.frames + 1);
  EXPECT_EQ(hash_state(lab.scene().state), hash_state(late.scene().state));
}

TEST(Status, ReadsParametersOnlyAfterAnEdit) {
  Lab lab(hanging_sheet());
  lab.submit(SetRunning{true});
  lab.advance(frame_time, no_deadline);
  const auto document = lab.status()->document;
  for (int i = 0; i < 50; ++i) lab.advance(frame_time, no_deadline);
  EXPECT_EQ(lab.status()->document, document);
  lab.submit(SetParameter{find_parameter("substeps"), 20.0});
  lab.advance(frame_time, no_deadline);
  EXPECT_NE(lab.status()->document, document);
}

// Every published value is that of the scene, whichever parameter was edited.
TEST(Status, ShowsEveryParameterAsEdited) {
  Lab lab(hanging_sheet());
  for (std::size_t i = 0; i < parameters().size(); ++i) {
    const Parameter& parameter = parameters()[i];
    if (parameter.applies != nullptr && !parameter.applies(lab.scene())) continue;
    lab.submit(SetParameter{&parameter, parameter.max});
    lab.advance(0.0, no_deadline);
    EXPECT_EQ(lab.status()->document->parameter_values[i], parameter.read(lab.scene())) << parameter.name;
    lab.submit(Undo{});
    lab.advance(0.0, no_deadline);
    EXPECT_EQ(lab.status()->document->parameter_values[i], parameter.read(lab.scene())) << parameter.name;
  }
}

// Each call computes one of ten substeps, and an edit precedes each call.
TEST(Slider, TheClockAdvancesWhileItMoves) {
  for (const char* name : {"stiffness", "drag", "gravity", "substeps", "speed", "new_mass"}) {
    Lab lab(hanging_sheet());
    lab.submit(SetRunning{true});
    lab.advance(frame_time, no_deadline);
    const long frames = lab.status()->run.frames;
    const Parameter& parameter = *find_parameter(name);
    const double value = parameter.read(lab.scene());
    for (int i = 0; i < 220; ++i) {
      lab.submit(SetParameter{&parameter, name == std::string("substeps") ? 10.0 : value * (1.0 + 0.001 * i)}, 7);
      lab.advance(frame_time, one_substep);
    }
    EXPECT_GE(lab.status()->run.frames, frames + 18) << name;
  }
}

TEST(Slider, ForASettingDiscardsNoFrameInProgress) {
  for (const Parameter& parameter : parameters()) {
    if (parameter.scope != Parameter::Scope::Setting || parameter.name == "frame_rate") continue;
    Lab edited(hanging_sheet()), untouched(hanging_sheet());
    for (Lab* lab : {&edited, &untouched}) {
      lab->submit(SetRunning{true});
      for (int i = 0; i < 5; ++i) lab->advance(frame_time, one_substep);
    }
    edited.submit(SetParameter{&parameter, parameter.max});
    for (int i = 0; i < 5; ++i) {
      for (Lab* lab : {&edited, &untouched}) lab->advance(frame_time, one_substep);
      EXPECT_EQ(parameter.read(edited.scene()), parameter.max) << parameter.name;
    }
    EXPECT_EQ(edited.status()->run.frames, 1) << parameter.name;
    EXPECT_EQ(hash_state(edited.scene().state), hash_state(untouched.scene().state)) << parameter.name;
  }
}

// Edits take effect in the frame after the one in progress, and must be replayed there.
TEST(Recording, OfEditsDuringAFrameReplaysIdentically) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder.folder / "slider.hookelog";
  Lab lab(hanging_sheet());
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  lab.submit(SetRunning{true});
  lab.submit(GrabCollider{{0, {0.5, -0.6, -1.0}}});
  for (int i = 0; i < 300; ++i) {
    if (i % 3 == 0) lab.submit(MoveHand{{0.5, -0.6, -1.0 - 0.002 * i}});
    if (i % 7 == 0) lab.submit(SetParameter{find_parameter("substeps"), 5.0 + i % 5});
    if (i % 11 == 0) lab.submit(SetParameter{find_parameter("drag"), 0.01 * i});
    if (i == 150) lab.submit(Undo{});
    if (i == 200) lab.submit(ReleaseHand{});
    lab.advance(frame_time, one_substep);
  }
  const long frames = lab.status()->run.frames;
  EXPECT_GT(frames, 20);
  lab.submit(Record{nullptr});
  lab.apply_pending();

  const auto recording = std::make_shared<const Recording>(read_recording(file));
  EXPECT_EQ(recording->frames, frames);
  Lab replayed(*recording->start);
  replayed.submit(Play{recording});
  replayed.apply_pending();
  for (long i = 0; i < frames; ++i) ASSERT_TRUE(replayed.step());
  EXPECT_EQ(replayed.difference(), "");
  EXPECT_EQ(hash_state(replayed.scene().state), hash_state(lab.scene().state));
}

}  // namespace
}  // namespace hooke
