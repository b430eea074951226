// Films and replays of hooke-headless, run as a separate process. A fake ffmpeg records its input and fails on request.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "lab/recording.h"
#include "scene/parameters.h"
#include "support/apply_now.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/picture.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

class Films : public testing::Test {
 protected:
  // Runs in the scratch folder, with the programs in it first in the path.
  Outcome run(const std::string& arguments, const std::string& path = "bin:/usr/bin:/bin") const {
    std::vector<std::string> words{"/usr/bin/env", "-C", scratch_.folder.string(), "-u", "DISPLAY", "PATH=" + path, HOOKE_HEADLESS};
    std::istringstream text(arguments);
    for (std::string word; text >> word;) words.push_back(word);
    return run_process(words);
  }
  // Installs an ffmpeg with this script.
  void install_ffmpeg(const std::string& script) const {
    std::filesystem::create_directory(scratch_.folder / "bin");
    const std::filesystem::path program = scratch_.folder / "bin" / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  std::string contents(const std::string& name) const { return hooke::contents(scratch_.folder / name); }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(scratch_.folder), std::filesystem::directory_iterator()));
  }
  const ScratchFolder scratch_;
};

// The last argument is the output file.
constexpr const char* honest_ffmpeg = "echo \"$@\" >arguments\nfor last; do :; done\nexec cat >\"${last#file:}\"\n";

TEST_F(Films, ContainTheSamePicturesAsAFolder) {
  install_ffmpeg(honest_ffmpeg);
  const Outcome outcome = run("capture cloth --seconds 0.1 --fps 30 --size 64x36 --out a.mp4");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const std::string film = contents("a.mp4");
  ASSERT_EQ(film.size(), 4u * 64 * 36 * 3);
  EXPECT_NE(contents("arguments").find("-video_size 64x36 -framerate 30 "), std::string::npos) << contents("arguments");

  ASSERT_EQ(run("capture cloth --seconds 0.1 --fps 30 --size 64x36 --out pictures").code, 0);
  const Image last = read_png(scratch_.folder / "pictures" / "frame_00003.png");
  EXPECT_EQ(film.substr(3u * 64 * 36 * 3), std::string(last.pixels.begin(), last.pixels.end()));
}

TEST_F(Films, NeedNoFfmpegAsWebpOrGif) {
  for (const char* file : {"a.webp", "a.gif"})
    EXPECT_EQ(run(std::string("capture cloth --seconds 0.1 --fps 30 --size 64x36 --out ") + file, "/nowhere").code, 0);
  EXPECT_EQ(contents("a.webp").substr(8, 4), "WEBP");
  EXPECT_EQ(contents("a.gif").substr(0, 6), "GIF89a");
}

// ffmpeg 5.1 on a disk that becomes full while it writes the end of the file.
TEST_F(Films, WhoseEndCannotBeWrittenAreRefused) {
  install_ffmpeg(
      "cat >/dev/null\nfor last; do :; done\necho incomplete >\"${last#file:}\"\n"
      "echo 'Error writing trailer: No space left on device' >&2\ncase \" $* \" in *' -xerror '*) exit 1 ;; esac\n");
  const Outcome outcome = run("capture two_masses --frames 2 --size 64x36 --out a.mp4");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("a.mp4: ffmpeg ended with 1: Error writing trailer: No space left on device"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(files(), 1u) << "only ffmpeg";
}

TEST_F(Films, AreNotLeftIncomplete) {
  install_ffmpeg("echo 'no space' >&2\nexit 7\n");
  const Outcome outcome = run("capture cloth --seconds 0.5 --size 640x360 --out a.mp4");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_EQ(outcome.err.rfind("hooke-headless: a.mp4: ffmpeg ended ", 0), 0u) << outcome.err;
  EXPECT_NE(outcome.err.find("no space"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), 1u);  // only the fake ffmpeg
}

TEST_F(Films, ReportAMissingFfmpegAndHowToInstallIt) {
  const Outcome outcome = run("capture cloth --out a.mp4", "/nowhere");
  EXPECT_EQ(outcome.code, 5);
  EXPECT_EQ(outcome.err,
            "hooke-headless: a.mp4: ffmpeg, which encodes films, cannot be started: No such file or directory (apt-get install ffmpeg)\n");
  EXPECT_EQ(files(), 0u);
}

// A recording of half a second of a cloth after its nails are released.
class Replays : public Films {
 protected:
  Replays() {
    Lab lab(load_scene(find_scene("cloth")).scene);
    lab.submit(Record{std::make_shared<const std::filesystem::path>(scratch_.folder / "a.hookelog")});
    for (int frame = 0; frame < 30; ++frame) {
      if (frame == 10) lab.submit(SetParameter{find_parameter("gravity"), 3.0});
      lab.step();
    }
    lab.submit(Record{});
    apply_now(lab);
  }

  // In the edit of the recording.
  void replace_in_recording(const std::string& old_text, const std::string& new_text) const {
    std::string text = contents("a.hookelog");
    const std::size_t at = text.find(old_text, text.find("\"set_parameter\""));
    ASSERT_NE(at, std::string::npos) << text.substr(text.find("\"set_parameter\""), 200);
    std::ofstream(scratch_.folder / "a.hookelog") << text.replace(at, old_text.size(), new_text);
  }
};

TEST_F(Replays, AreVerified) {
  const Outcome outcome = run("replay a.hookelog --verify");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.rfind("30 frames to 0.5 s, hash ", 0), 0u) << outcome.out;
  EXPECT_NE(outcome.out.find(": every frame as recorded"), std::string::npos) << outcome.out;
}

TEST_F(Replays, FailWhereAFrameDiffersFromTheRecording) {
  replace_in_recording("\"value\": 3", "\"value\": 4");
  const Outcome verified = run("replay a.hookelog --verify");
  EXPECT_EQ(verified.code, 1);
  EXPECT_EQ(verified.err.rfind("a.hookelog: frame 11, at ", 0), 0u) << verified.err;
}

TEST_F(Replays, PlayOnAfterADifferenceAndSaySo) {
  replace_in_recording("\"value\": 3", "\"value\": 4");
  for (const char* command : {"replay a.hookelog", "replay a.hookelog --quiet --csv b.csv", "replay a.hookelog --json b.json"}) {
    const Outcome outcome = run(command);
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_EQ(outcome.err.rfind("warning: a.hookelog: frame 11, at ", 0), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find("; what follows is the motion of this version\n"), std::string::npos) << outcome.err;
  }
}

TEST_F(Replays, WarnOfADifferenceInTheLastFrame) {
  const std::string text = contents("a.hookelog");
  const std::size_t last = text.rfind("\"frame\": \"") + 10;
  std::string changed = text;
  changed[last] = changed[last] == '0' ? '1' : '0';
  std::ofstream(scratch_.folder / "a.hookelog") << changed;
  const Outcome outcome = run("replay a.hookelog");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err,
            "warning: a.hookelog: frame 30, at 0.5 s: not the state that was recorded; what follows is the motion of this version\n");
  EXPECT_EQ(run("replay a.hookelog --verify").code, 1);
}

// As a killed program leaves it.
TEST_F(Replays, WhoseLastLineIsIncompleteAreNotVerified) {
  const std::string text = contents("a.hookelog");
  std::ofstream(scratch_.folder / "a.hookelog") << text.substr(0, text.size() - 5);
  const Outcome plain = run("replay a.hookelog"), verified = run("replay a.hookelog --verify --junit a.xml");
  EXPECT_EQ(plain.code, 0);
  EXPECT_EQ(plain.err, "warning: a.hookelog: its last line is incomplete: the replay ends before it\n");
  EXPECT_EQ(verified.code, 1);
  EXPECT_EQ(verified.err, "a.hookelog: its last line is incomplete: the replay ends before it\n");
  EXPECT_EQ(verified.out.find("every frame as recorded"), std::string::npos) << verified.out;
  EXPECT_NE(contents("a.xml").find("failures=\"1\""), std::string::npos);
}

// A frame that diverges now and did not then.
TEST_F(Replays, ThatDivergeEndWithTheCodeForIt) {
  replace_in_recording("\"parameter\": \"gravity\", \"value\": 3", "\"parameter\": \"stiffness\", \"value\": 1000000");
  const Outcome outcome = run("replay a.hookelog");
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_NE(outcome.err.find(" diverges; it did not when it was recorded\n"), std::string::npos) << outcome.err;
}

TEST_F(Replays, RefuseOtherFiles) {
  std::ofstream(scratch_.folder / "a.hookelog") << "{\"hooke\": 1}\n";
  const Outcome outcome = run("replay a.hookelog");
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(outcome.err, "hooke-headless: a.hookelog: line 1: a scene: must be a recording, {\"hooke_recording\": 1, ...}\n");
  EXPECT_EQ(run("replay none.hookelog").code, 5);
}

TEST_F(Replays, AreDrawnFromStartToEnd) {
  install_ffmpeg(honest_ffmpeg);
  EXPECT_EQ(run("capture --replay a.hookelog --size 64x36 --out a.mp4").code, 0);
  EXPECT_EQ(contents("a.mp4").size(), 31u * 64 * 36 * 3);
}

TEST_F(Replays, MeasureTheAccuracyOfTheRecordedFrames) {
  const Outcome json = run("replay a.hookelog --verify --sample 0.1 --points 0 --json -");
  EXPECT_EQ(json.code, 0) << json.err;
  const rapidjson::Document report = parse_json(json.out);
  EXPECT_STREQ(report["scene"].GetString(), "a.hookelog");
  const auto& samples = report["samples"];
  ASSERT_EQ(samples.Size(), 6u);
  for (rapidjson::SizeType i = 0; i < samples.Size(); ++i) {
    ASSERT_EQ(samples[i]["error"]["frame"].IsNull(), i == 0) << i;  // measured again after the edit at frame 10
    ASSERT_EQ(samples[i]["error"]["accumulated"].IsNull(), i == 0) << i;
    ASSERT_EQ(samples[i]["half_error"]["cost"].IsNull(), i == 0) << i;  // measured, as the cloth may touch something
    ASSERT_TRUE(samples[i]["energy_balance"].IsObject());
  }
  const auto rows = lines_of(run("replay a.hookelog --sample 0.1 --csv - --quantities time,error,accumulated_error,energy_method").out);
  ASSERT_EQ(rows.size(), 7u);
  EXPECT_EQ(rows[1].find("0,,,"), 0u) << rows[1];
  EXPECT_EQ(rows[6].find(",,"), std::string::npos) << rows[6];
}

TEST_F(Replays, OfARunWithoutEditsReportWhatTheRunReports) {
  Lab lab(load_scene(find_scene("cloth")).scene);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(scratch_.folder / "b.hookelog")});
  for (int frame = 0; frame < 12; ++frame) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  const auto samples_of = [](const std::string& json) {
    const std::size_t begin = json.find("\"samples\""), end = json.find("\n  \"seconds\"");
    return begin < end && end != std::string::npos ? json.substr(begin, end - begin) : json;
  };
  const std::string replayed = samples_of(run("replay b.hookelog --sample 0.1 --points 0,7 --json -").out);
  EXPECT_EQ(replayed, samples_of(run("run cloth --seconds 0.2 --sample 0.1 --points 0,7 --json -").out));
  EXPECT_NE(replayed.find("\"accumulated\": "), std::string::npos) << replayed;
}

TEST_F(Replays, LeaveEmptyWhatTheSessionRemoved) {
  Lab lab(load_scene(find_scene("two_masses")).scene);
  lab.submit(Record{std::make_shared<const std::filesystem::path>(scratch_.folder / "b.hookelog")});
  lab.step();
  lab.submit(Remove{{lab.scene().system.points()[1].id}, {}});
  lab.step();
  lab.submit(Record{});
  apply_now(lab);
  const auto rows = lines_of(run("replay b.hookelog --csv - --quantities x1,length0 --sample 0.01 --accuracy off").out);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NE(rows[2], ",");
  EXPECT_EQ(rows[3], ",");
  const rapidjson::Document last = parse_json(run("replay b.hookelog --points 0,1 --json -").out);
  const auto& positions = last["samples"][0]["positions"];
  EXPECT_TRUE(positions[0].IsArray() && positions[1].IsNull());
  EXPECT_EQ(parse_json(run("replay b.hookelog --json -").out)["samples"][0]["positions"].Size(), 1u);
}

TEST_F(Replays, AreReportedByCaptureWithTheirErrors) {
  EXPECT_EQ(run("capture --replay a.hookelog --size 64x36 --report report --out a.png").code, 0);
  const rapidjson::Document report = parse_json(contents("report/report.json"));
  ASSERT_EQ(report["frames"].Size(), 31u);
  EXPECT_GT(report["frames"][30]["error"]["frame"].GetDouble(), 0.0);
  EXPECT_GT(report["frames"][30]["error"]["accumulated"].GetDouble(), 0.0);
  EXPECT_EQ(run("capture --replay a.hookelog --size 64x36 --fail-above 1 --out a.png").code, 0);
}

TEST_F(Replays, RejectOptionsThatWouldChangeTheRun) {
  EXPECT_EQ(run("capture --replay a.hookelog --out a.png --substeps 3").code, 2);
  EXPECT_EQ(run("capture cloth --replay a.hookelog --out a.png").code, 2);
  EXPECT_EQ(run("capture --out a.png").code, 2);
}

}  // namespace
}  // namespace hooke
