// Recordings: commands are read back from text, a replay gives the same bits, and any difference is reported.
#include "lab/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "base/build_info.h"
#include "base/errors.h"
#include "edit/command_text.h"
#include "edit/field_names.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "scene/shape.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/command_text.h"
#include "support/contents.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {
// One of every command, with a non-default value in every field.
std::vector<Command> one_of_each() {
  const Point point{.id = PointId{7}, .nailed = true, .color = Color{1, 2, 3}, .mass = 0.1, .radius = 0.3};
  const Spring spring{.id = SpringId{9},
                      .first = PointId{7},
                      .second = PointId{1},
                      .family = SpringFamily::Shear,
                      .stiffness = 1e300,
                      .damping = 5e-324,
                      .rest_length = 0.1};
  const GrabPoint::Item grab{.point = PointId{1},
                             .patch = Patch{{PointId{1}, PointId{2}, PointId{3}}, {0.5, 0.25, 0.25}},
                             .kind = GrabKind::Pull,
                             .target = {-0.0, 1.0 / 3.0, 2.0},
                             .stiffness = 12.5};
  return {
      Insert{{{no_index, point, {1, 2, 3}, {4, 5, 6}, 0.7}},
             {{3, spring, 0.3}},
             {{0, {{PointId{7}, PointId{1}, PointId{2}}, {0.1, -0.2, 0.3}}}},
             PairContact{.springs = true, .friction = 0.1}},
      Remove{{PointId{1}, PointId{2}}, {SpringId{3}}, {{{PointId{1}, PointId{2}, PointId{4}}}}},
      SetNailed{{{PointId{1}, true, {0.1, 0.2, 0.3}}}},
      Move{{{PointId{1}, {0.1, 0.2, 0.3}, {-1, -2, -3}}}},
      SetPointColor{{{PointId{1}, Color{9, 8, 7}}, {PointId{2}, std::nullopt}}},
      SetLoad{{{PointId{1}, {0.1, -2, 3}}}},
      SetFixedAxes{{{PointId{1}, 5}}},
      SetPointProperty{PointProperty::Radius, {{PointId{1}, 0.1}}},
      SetSpringProperty{SpringProperty::BreakStrain, {{SpringId{1}, never_breaks}}},
      SetSpringLaw{{{SpringId{1}, SpringLaw{.force = SpringForce::Cubic, .k3 = -5.0, .rate = 0.1}}, {SpringId{2}, std::nullopt}}},
      SetParameter{find_parameter("drag"), 0.25},
      RestoreParameter{find_parameter("drag"), 1e9},
      SetIntegrator{find_integrator("xpbd")},
      GrabPoint{grab},
      GrabCollider{{2, {0.5, -1, 2}}},
      MoveHand{{1, 2, 3}},
      ReleaseHand{},
      SetGravity{{0, -1.62, 0}},
      SetColliders{{{Sphere{{1, 2, 3}, 4}, 0.5, 0.25, false, false, {{1, 2, 3}, 4, 5, {6, 7, 8}, {9, 10, 11}}},
                    {Plane{}, 0, 0, true},
                    {Box{}, 1, 1, true}}},
      SetForces{{{&force_terms()[0], false, default_values(force_terms()[0])}}},
      SetVelocity{{{PointId{1}, {1, -2, 3}}}},
      SetText{"Title", "What it is", "Notes"},
      SetPlots{{"y1", "length0"}},
      SetTexture{"linen", 0.5, {}},
      GoToState{std::make_shared<const State>(
          State{.time = 0.1, .position = {{1, 2, 3}}, .velocity = {{4, 5, 6}}, .memory = {0.1, 0.2}, .torn = 4})},
      SetTorn{3},
      MarkTorn{3},
  };
}

TEST(CommandText, EveryCommandIsReadBackAsWritten) {
  const std::vector<Command> commands = one_of_each();
  std::set<std::size_t> kinds;
  const std::string name = "test";
  for (const Command& command : commands) {
    kinds.insert(command.index());
    const std::string text = text_of(command);
    JsonParser parser;
    const JsonField whole(name, "command", parser.parse(text));
    EXPECT_EQ(text_of(read_command(whole.members()[0])), text);
  }
  // all except Replace, which contains a scene and is written on several lines
  EXPECT_EQ(kinds.size() + 1, std::variant_size_v<CommandVariant>);
}

struct Session {
  std::uint64_t hash = 0;
  std::string text;
};

// A cloth that falls on a ball, without contact of its faces, which takes long with dop853.
Scene falling_cloth() {
  Scene scene = load_scene(find_scene("cloth_on_ball")).scene;
  scene.system.contact = {};
  return scene;
}

// A user session on a cloth that contains everything a recording can hold.
Session record_session(const std::filesystem::path& file) {
  Lab lab(falling_cloth());
  const auto step = [&](int frames) {
    for (int i = 0; i < frames; ++i) lab.step();
  };
  step(3);
  lab.submit(Remove{{lab.scene().system.points()[5].id}, {}});  // from here on, ids differ from indices
  step(1);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  step(5);
  const PointId corner = lab.scene().system.points()[0].id;
  lab.submit(GrabPoint{{.point = corner, .kind = GrabKind::Hold, .target = lab.scene().state.position[0]}});
  for (int i = 0; i < 5; ++i) {
    lab.submit(MoveHand{lab.scene().state.position[0] + Vec3(0.05, 0.1, 0.0)});
    step(1);
  }
  lab.submit(ReleaseHand{});
  lab.submit(SetParameter{find_parameter("damping"), 0.5});
  step(2);
  lab.submit(Undo{});
  lab.submit(SetIntegrator{find_integrator("dop853")});
  step(2);
  lab.submit(SetIntegrator{find_integrator("xpbd")});
  step(2);
  lab.submit(Redo{});
  const PointId added = lab.new_point_id();
  lab.submit(Insert{{{no_index, {.id = added}, {0.3, 2.0, 0.1}, Vec3(0.0)}},
                    {{no_index, {.id = lab.new_spring_id(), .first = added, .second = corner, .stiffness = 80.0, .rest_length = 0.4}}},
                    {}});
  step(4);
  lab.submit(GoToStart{});
  step(2);
  lab.submit(Record{});
  apply_now(lab);
  EXPECT_EQ(lab.status()->recording.error, "");
  return {hash_state(lab.scene().state), contents(file)};
}

class Recordings : public testing::Test {
 protected:
  // Played to its end, or to the first difference.
  Lab play(const std::string& text) {
    auto recording = std::make_shared<const Recording>(parse_recording(text, "test"));
    Lab lab(*recording->start, KeepStart::No);
    lab.submit(Play{std::move(recording)});
    apply_now(lab);
    while (lab.is_playing()) lab.step();
    return lab;
  }
  const ScratchFolder scratch_;
  const Session session_ = record_session(scratch_.folder / "session.hookelog");
};

TEST_F(Recordings, ContinueWithADocumentOpenedMeanwhile) {
  const std::filesystem::path file = scratch_.folder / "two.hookelog";
  Lab lab(falling_cloth());
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  for (int i = 0; i < 3; ++i) lab.step();
  lab.submit(Open{std::make_shared<const Scene>(load_scene(find_scene("rope_64")).scene)});
  for (int i = 0; i < 3; ++i) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  const Lab played = play(contents(file));
  EXPECT_EQ(played.difference(), "");
  EXPECT_EQ(hash_state(played.scene().state), hash_state(lab.scene().state));
  EXPECT_EQ(played.scene().system.point_count(), 64);
}

TEST_F(Recordings, ContinueWithARecordingPlayedMeanwhile) {
  const std::filesystem::path file = scratch_.folder / "played.hookelog";
  Lab lab(load_scene(find_scene("rope_64")).scene);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  for (int i = 0; i < 3; ++i) lab.step();
  lab.submit(Play{std::make_shared<const Recording>(parse_recording(session_.text, "test"))});
  apply_now(lab);
  while (lab.is_playing()) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  EXPECT_EQ(hash_state(lab.scene().state), session_.hash);
  const Lab played = play(contents(file));
  EXPECT_EQ(played.difference(), "");
  EXPECT_EQ(hash_state(played.scene().state), session_.hash);
}

TEST_F(Recordings, ReplayWithTheSameBits) {
  const Lab lab = play(session_.text);
  EXPECT_EQ(lab.difference(), "");
  EXPECT_EQ(hash_state(lab.scene().state), session_.hash);
}

TEST_F(Recordings, OfAReplayAreIdenticalToTheOriginal) {
  auto recording = std::make_shared<const Recording>(parse_recording(session_.text, "test"));
  Lab lab(*recording->start);
  lab.submit(Play{recording});
  lab.submit(Record{std::make_shared<const std::filesystem::path>(scratch_.folder / "again.hookelog")});
  apply_now(lab);
  while (lab.is_playing()) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  const Recording again = read_recording(scratch_.folder / "again.hookelog");
  EXPECT_EQ(again.frames, recording->frames);
  EXPECT_EQ(hash_state(play(session_.text).scene().state), session_.hash);
}

TEST_F(Recordings, NameTheFrameAndThePointsThatDiffer) {
  // the fingerprint of the fourth frame, with the byte of the third pair of points changed
  std::size_t at = 0;
  for (int frame = 0; frame < 4; ++frame) at = session_.text.find("{\"frame\": \"", at + 1);
  std::string text = session_.text;
  char& digit = text[at + std::string("{\"frame\": \"").size() + 16 + 2 * 2];
  digit = digit == '0' ? '1' : '0';
  const Lab lab = play(text);
  EXPECT_TRUE(lab.difference().starts_with("frame 4, at ")) << lab.difference();
  EXPECT_TRUE(lab.difference().ends_with("points 4 to 5 are not where recorded")) << lab.difference();
  EXPECT_FALSE(lab.is_playing());
}

TEST_F(Recordings, WithOtherParametersDiffer) {
  std::string text = session_.text;
  const std::string gravity = "\"gravity\": [0, -9.8";
  const std::size_t at = text.find(gravity);
  ASSERT_NE(at, std::string::npos) << text.substr(0, 400);
  text[at + gravity.size() - 1] = '7';
  EXPECT_TRUE(play(text).difference().starts_with("frame 1, at ")) << play(text).difference();
}

TEST_F(Recordings, ThatAreTruncatedPlayUpToTheirEnd) {
  const std::string text = session_.text.substr(0, session_.text.size() - 7);
  const Recording recording = parse_recording(text, "test");
  EXPECT_TRUE(recording.is_truncated);
  EXPECT_EQ(recording.frames, parse_recording(session_.text, "test").frames - 1);
  EXPECT_EQ(play(text).difference(), "");
}

TEST_F(Recordings, EndWhenAGrabIsSetFromOutside) {
  auto recording = std::make_shared<const Recording>(parse_recording(session_.text, "test"));
  Lab lab(*recording->start);
  lab.submit(Play{std::move(recording)});
  lab.step();
  ASSERT_TRUE(lab.is_playing());
  lab.submit(SetGravity{{0.0, 1.0, 0.0}});
  lab.step();
  EXPECT_FALSE(lab.is_playing());
  EXPECT_EQ(lab.scene().system.gravity, Vec3(0.0, 1.0, 0.0));
}

TEST_F(Recordings, ThatCannotBeWrittenEndWithAnError) {
  Lab lab(load_scene(find_scene("two_masses")).scene);
  lab.submit(Record{std::make_shared<const std::filesystem::path>("/nowhere/session.hookelog")});
  lab.step();
  lab.publish();
  EXPECT_EQ(lab.status()->recording.file, "");
  EXPECT_NE(lab.status()->recording.error.find("/nowhere/session.hookelog: cannot be written: No such file or directory"),
            std::string::npos)
      << lab.status()->recording.error;
  EXPECT_GT(lab.scene().state.time, 0.0);
}

std::string refusal(const std::string& text) {
  try {
    parse_recording(text, "x.hookelog");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST_F(Recordings, AreRefusedWithTheLineOfTheError) {
  const std::string first_lines = session_.text.substr(0, session_.text.find("{\"frame\""));
  EXPECT_EQ(refusal(""), "x.hookelog: empty: must begin with \"hooke_recording\"");
  EXPECT_EQ(refusal("{\"hooke_recording\": 1}"), "x.hookelog: ends within its first line: must begin with \"hooke_recording\"");
  EXPECT_EQ(refusal("garbage\n"), "x.hookelog: line 1: value: garbage: must be a JSON value (numbers are finite)");
  EXPECT_EQ(refusal("[1]\n"), "x.hookelog: line 1: not an object: must be {...}");
  EXPECT_EQ(refusal("{}\n"), "x.hookelog: line 1: must be a recording: {\"hooke_recording\": 1, ...}");
  EXPECT_EQ(refusal("{ \"name\": \"net\", \"hooke\": 1}\n"),
            "x.hookelog: line 1: a scene: must be a recording, {\"hooke_recording\": 1, ...}");
  EXPECT_EQ(refusal("{}\n{}\n"), "x.hookelog: line 1: must be a recording: {\"hooke_recording\": 1, ...}");
  EXPECT_NE(refusal("{\"hooke_recording\": 1}\n{\"frame\": \"00\"}\n").find("line 2: frame: "), std::string::npos);
  for (const char* line : {"{\"frame\": \"zz00000000000000\"}", "{\"fly\": {}}", "{\"replace\": {\"scene\": null}}",
                           "{\"move\": {\"items\": 3}}", "{\"set_parameter\": {\"parameter\": \"none\", \"value\": 1}}",
                           "{\"remove\": {\"points\": [-1], \"springs\": []}}", "{\"move\": {}}", "nonsense"})
    EXPECT_NE(refusal(first_lines + line + "\n").find("x.hookelog: line 4: "), std::string::npos)
        << line << ": " << refusal(first_lines + line + "\n");
}

TEST_F(Recordings, OfANewerFormatNameTheRequiredProgram) {
  const std::string now(program_version);
  EXPECT_EQ(refusal("{\"hooke_recording\": 2, \"program\": \"9.8.7\"}\n"),
            "x.hookelog: line 1: version 2 of the format: this is Hooke " + now +
                ", which reads up to version 1; Hooke 9.8.7 wrote it: that version or a newer one is required");
  EXPECT_EQ(refusal("{\"program\": 3, \"hooke_recording\": 2}\n"), "x.hookelog: line 1: version 2 of the format: this is Hooke " + now +
                                                                       ", which reads up to version 1; a newer program is required");
  // the same version of the format, but a command of a later program
  std::string text = session_.text.substr(0, session_.text.find("{\"frame\"")) + "{\"fly\": {}}\n";
  EXPECT_EQ(refusal(text), "x.hookelog: line 4: fly: is unknown");
  text.replace(text.find("\"program\": \"" + now), 12 + now.size(), "\"program\": \"9.8.7");
  EXPECT_EQ(refusal(text), "x.hookelog: line 4: fly: is unknown; Hooke 9.8.7 wrote it: that version or a newer one is required");
}

// A newer program may add optional members anywhere, and another one formats the lines differently.
TEST_F(Recordings, WithUnknownOptionalMembersPlayTheSame) {
  std::string text;
  std::istringstream lines(session_.text);
  for (std::string line; std::getline(lines, line);) {
    line.insert(1, " \t\"x-before\": [1, {\"frame\": 2}], ");
    line.insert(line.size() - 1, ", \"x-after\": \"rest\"");
    if (const std::size_t items = line.find("{\"items\":"); items != std::string::npos) line.insert(items + 1, "\"x-inside\": null, ");
    text += " " + line + "\r\n";
  }
  const Lab lab = play(text);
  EXPECT_EQ(lab.difference(), "");
  EXPECT_EQ(hash_state(lab.scene().state), session_.hash);
}

// recordings/version_N.hookelog was written by the first program that wrote version N and is never changed. Each frame must have the same
// bits on machines with the same arithmetic as the one that wrote it, up to the first change of the physics since then: dop853,
// which version 1 has from frame 26 on, added each term of its sums to the positions, and took powers from the C library.
constexpr const char* known_differences[] = {"frame 26, at 0.48333333333333334 s: point 1 is not where recorded; Hooke 0.1.0 recorded it"};

// A session in a laboratory that measures at once, and its accuracy after each frame.
std::vector<Accuracy> record_measured_session(const std::filesystem::path& file) {
  std::vector<Accuracy> measured;
  Lab lab(load_scene(find_scene("rope")).scene, KeepStart::No);
  lab.submit(SetAccuracy{AccuracyMode::Full});
  lab.submit(Record{std::make_shared<const std::filesystem::path>(file)});
  for (int frame = 0; frame < 60; ++frame) {
    if (frame == 15) lab.submit(SetParameter{find_parameter("damping"), 0.5});
    if (frame == 30) lab.submit(Move{{{lab.scene().system.points()[9].id, {0.1, 0.2, 0.3}, Vec3(0.0)}}});
    if (frame == 40) lab.submit(Undo{});
    lab.step();
    measured.push_back(lab.accuracy());
  }
  lab.submit(Record{});
  lab.apply_pending();
  return measured;
}

TEST(RecordedAccuracy, IsThatOfTheSessionBitForBitWhenItIsReplayed) {
  const ScratchFolder scratch;
  const std::vector<Accuracy> session = record_measured_session(scratch.folder / "a.hookelog");
  const auto recording = std::make_shared<const Recording>(read_recording(scratch.folder / "a.hookelog"));
  Lab lab(*recording->start, KeepStart::No);
  lab.submit(Play{recording});
  lab.submit(SetAccuracy{AccuracyMode::Full});
  lab.apply_pending();
  int known = 0;
  for (const Accuracy& recorded : session) {
    lab.step();
    const Accuracy replayed = lab.accuracy();
    for (const auto measured : {&Accuracy::frame, &Accuracy::frame_max, &Accuracy::accumulated, &Accuracy::amplification}) {
      ASSERT_EQ((replayed.*measured).value, (recorded.*measured).value) << "at " << lab.scene().state.time << " s";
      ASSERT_EQ((replayed.*measured).reason, (recorded.*measured).reason);
    }
    ASSERT_EQ(replayed.energy, recorded.energy);
    ASSERT_EQ(replayed.half_error.substeps, recorded.half_error.substeps);
    known += recorded.frame.value && recorded.accumulated.value ? 1 : 0;
  }
  EXPECT_GT(known, 25);
  EXPECT_FALSE(lab.is_playing());
  EXPECT_EQ(lab.difference(), "");
}

TEST(OldRecordings, OfEveryVersionPlayToTheirEndAndNameTheFirstDifference) {
  for (int version = 1; version <= newest_recording_version; ++version) {
    const std::filesystem::path file = std::filesystem::path(HOOKE_RECORDINGS) / ("version_" + std::to_string(version) + ".hookelog");
    const auto recording = std::make_shared<const Recording>(read_recording(file));
    EXPECT_FALSE(recording->is_truncated) << file;
    EXPECT_GE(recording->frames, 40) << file;
    Lab lab(*recording->start);
    lab.submit(Play{recording});
    lab.apply_pending();
    while (lab.is_playing()) ASSERT_TRUE(lab.step()) << file;
    EXPECT_EQ(lab.difference(), known_differences[version - 1]) << file;
  }
}

TEST(Fingerprints, OfLargeScenesNameAGroupOfPoints) {
  State a;
  a.position.assign(5000, Vec3(1.0));
  a.velocity.assign(5000, Vec3(0.0));
  State b = a;
  b.velocity[3333].z = 1e-300;
  const auto range = first_difference(fingerprint_of(a), fingerprint_of(b), 5000);
  ASSERT_TRUE(range);
  EXPECT_LE(range->first, 3333);
  EXPECT_GE(range->second, 3333);
  EXPECT_LT(range->second - range->first, 5);
  EXPECT_FALSE(first_difference(fingerprint_of(a), fingerprint_of(a), 5000));
}

}  // namespace
}  // namespace hooke
