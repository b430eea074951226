// Runs with the method `auto` are recorded, replayed and undone like any other.
#include <gtest/gtest.h>

#include <regex>

#include "base/errors.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/contents.h"
#include "support/nets.h"
#include "support/scratch_folder.h"
#include "support/test_sim.h"

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

// With weak dashpots it takes steps that are not in the table of integrators.
TEST(AutomaticReplay, OfTheLeapfrogHasTheSameBits) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "leapfrog.hookelog";
  const TestSim sim = net(8, 1e4, 0.5);
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  scene.settings = {.integrator = &automatic_method()};
  Lab lab(scene);
  for (int i = 0; i < 3; ++i) lab.step();
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  for (int i = 0; i < 6; ++i) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().state.memory.choice->method->id, "leapfrog");

  auto recording = std::make_shared<const Recording>(parse_recording(contents(file), "test"));
  Lab played(*recording->start, KeepStart::No);
  played.submit(Play{std::move(recording)});
  apply_now(played);
  while (played.is_playing()) played.step();
  EXPECT_EQ(played.difference(), "");
  EXPECT_EQ(hash_state(played.scene().state), hash_state(lab.scene().state));
  EXPECT_EQ(played.scene().state.memory, lab.scene().state.memory);
}

// A stiff and a soft chain, which have their own steps.
Scene two_chains() {
  TestSim sim;
  for (const double stiffness : {20.0, 2e4}) {
    const double z = stiffness < 100.0 ? 0.0 : 1.0;
    PointId last = sim.nail({0.0, 0.0, z});
    for (int i = 1; i < 60; ++i) {
      const PointId next = sim.add({0.1 * i, 0.0, z}, 0.01);
      sim.join(last, next, stiffness, 0.1);
      last = next;
    }
  }
  Scene scene;
  scene.system = std::move(sim.system);
  scene.state = std::move(sim.state);
  scene.settings = {.integrator = &automatic_method(), .tolerance = 1e-3};
  return scene;
}

TEST(AutomaticReplay, OfPartsWithTheirOwnStepsHasTheSameBits) {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "auto.hookelog";
  Lab lab(two_chains());
  for (int i = 0; i < 7; ++i) lab.step();
  EXPECT_EQ(lab.scene().state.memory.islands.size(), 2u);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  for (int i = 0; i < 20; ++i) lab.step();
  lab.submit(SetParameter{find_parameter("stiffness"), 300.0});
  for (int i = 0; i < 3; ++i) lab.step();
  EXPECT_TRUE(lab.scene().state.memory.islands.empty());
  lab.submit(Undo{});
  for (int i = 0; i < 3; ++i) lab.step();
  EXPECT_EQ(lab.scene().state.memory.islands.size(), 2u);
  lab.submit(Record{});
  apply_now(lab);
  auto recording = std::make_shared<const Recording>(parse_recording(contents(file), "test"));
  EXPECT_EQ(recording->start->state.memory.islands.size(), 2u);
  Lab played(*recording->start, KeepStart::No);
  played.submit(Play{std::move(recording)});
  apply_now(played);
  while (played.is_playing()) played.step();
  EXPECT_EQ(played.difference(), "");
  EXPECT_EQ(played.scene().state.memory, lab.scene().state.memory);
}

// The text of a recording that starts while two parts have their own steps.
std::string recording_of_two_chains() {
  const ScratchFolder scratch;
  const std::filesystem::path file = scratch.folder / "auto.hookelog";
  Lab lab(two_chains());
  for (int i = 0; i < 7; ++i) lab.step();
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  lab.step();
  lab.submit(Record{});
  apply_now(lab);
  return contents(file);
}

// Earlier versions wrote no parts: the methods are chosen anew.
TEST(AutomaticReplay, ARecordingOfAnEarlierVersionHasNoParts) {
  std::string text = recording_of_two_chains();
  const std::size_t begin = text.find(", \"islands\": ["), end = text.find(']', begin);
  ASSERT_NE(begin, std::string::npos) << text.substr(text.find("\"memory\""), 200);
  text.erase(begin, end + 1 - begin);
  const Recording recording = parse_recording(text, "test");
  EXPECT_TRUE(recording.start->state.memory.choice);
  EXPECT_TRUE(recording.start->state.memory.islands.empty());
  Lab lab(*recording.start, KeepStart::No);
  ASSERT_TRUE(lab.step());
  EXPECT_EQ(lab.scene().state.memory.islands.size(), 2u);
}

// Another one had other numbers beside the method and its substeps.
TEST(AutomaticReplay, AChoiceWithoutLaterFieldsIsRead) {
  std::string text = recording_of_two_chains();
  text = std::regex_replace(text, std::regex(R"(, "breaks": (true|false))"), ", \"selected_ratio\": 0.5");
  text = std::regex_replace(text, std::regex(R"(, "recent_turning": [-+.e0-9]+)"), "");
  ASSERT_NE(text.find("selected_ratio"), std::string::npos);
  ASSERT_EQ(text.find("recent_turning"), std::string::npos);
  const Recording recording = parse_recording(text, "test");
  ASSERT_TRUE(recording.start->state.memory.choice);
  EXPECT_FALSE(recording.start->state.memory.choice->breaks);
  Lab lab(*recording.start, KeepStart::No);
  EXPECT_TRUE(lab.step());
}

TEST(AutomaticReplay, ARecordingWithMorePartsThanThereCanBeIsRefused) {
  std::string text = recording_of_two_chains();
  const std::size_t begin = text.find("\"islands\": [") + 12, end = text.find('}', begin) + 1;
  const std::string first = text.substr(begin, end - begin);
  for (int i = 0; i < 20; ++i) text.insert(end, "," + first);
  try {
    parse_recording(text, "test");
    FAIL() << "is accepted";
  } catch (const InputError& refused) {
    EXPECT_NE(std::string(refused.what()).find("at most 12 islands"), std::string::npos) << refused.what();
  }
}

TEST(AutomaticReplay, PartsWithTheirOwnStepsAreMeasuredWithThem) {
  Lab lab(two_chains(), KeepStart::No);
  lab.submit(SetAccuracy{AccuracyMode::Full});
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(lab.step());
  const Accuracy accuracy = lab.accuracy();
  EXPECT_EQ(lab.scene().state.memory.islands.size(), 2u);
  ASSERT_TRUE(accuracy.frame.value && accuracy.accumulated.value);
  EXPECT_LT(*accuracy.frame.value, 1e-3 / 60.0);
  EXPECT_LT(*accuracy.accumulated.value, 1e-3);
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
