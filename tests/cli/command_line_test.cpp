// hooke-headless as used by scripts: exit codes, stdout and stderr, the fields of its JSON.

#include <gtest/gtest.h>
#include <rapidjson/document.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>

#include "base/build_info.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "sim/hash.h"
#include "support/contents.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

Outcome headless(std::vector<std::string> words) {
  words.insert(words.begin(), HOOKE_HEADLESS);
  return run_process(words);
}

std::string write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file.string();
}

rapidjson::Document parse(const std::string& text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text.c_str());
  EXPECT_FALSE(document.HasParseError()) << text.substr(0, 500);
  return document;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// One free point with a speed of 1 m/s, so that results can be computed by hand.
constexpr const char* free_point =
    R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0, 0, 0], "velocity": [1, 0, 0], "mass": 2}],
  "simulation": {"frame_rate": 10, "substeps": 1}})";

TEST(Headless, HelpVersionAndLimitsGoToStdoutForEveryCommand) {
  for (const std::vector<std::string>& subcommand : {std::vector<std::string>{}, {"run"}, {"convert"}}) {
    const auto output_of = [&](const char* option) {
      std::vector<std::string> words = subcommand;
      words.emplace_back(option);
      const Outcome outcome = headless(words);
      EXPECT_EQ(outcome.code, 0) << option;
      EXPECT_EQ(outcome.err, "");
      return outcome.out;
    };
    EXPECT_EQ(output_of("--version"), std::string("hooke-headless ") + program_version + "\n");
    EXPECT_NE(output_of("--help").find("Exit codes: 0 success"), std::string::npos);
    EXPECT_NE(output_of("--limits").find("at most 256 MiB"), std::string::npos);
  }
}

struct Usage {
  std::vector<std::string> words;
  std::string message;  // part of it
};

TEST(Headless, WrongUsageIsCodeTwoWithOneLineOnStderr) {
  for (const Usage& usage : {
           Usage{{}, "A subcommand is required"},
           {{"fly"}, "A subcommand is required"},
           {{"run"}, "SCENE is required"},
           {{"run", "two_masses"}, "--seconds is required"},
           {{"run", "two_masses", "--seconds", "-1"}, "--seconds: -1: must be at least 0"},
           {{"run", "two_masses", "--seconds", "nan"}, "--seconds: nan: must be"},
           {{"run", "two_masses", "--seconds", "1e300"}, "must be at most 1e15 frames"},
           {{"run", "two_masses", "--seconds", "1", "--warp", "9"}, "--warp"},
           {{"run", "two_masses", "--seconds", "1", "--threads", "2"}, "--threads"},
           {{"run", "two_masses", "--seconds", "1", "--substeps", "0"}, "--substeps: 0: must be from 1 to 1000000"},
           {{"run", "two_masses", "--seconds", "1", "--frame-rate", "0"}, "--frame-rate: 0: must be more than 0"},
           {{"run", "two_masses", "--seconds", "1", "--sample", "0"}, "--sample: 0: must be more than 0"},
           {{"run", "two_masses", "--seconds", "1", "--points", "0,2"}, "--points 0,2: must be numbers from 0 to 1"},
           {{"run", "two_masses", "--seconds", "1", "--points", "0,,1"}, "--points 0,,1: must be numbers"},
           {{"run", "two_masses", "--seconds", "1", "--integrator", "magic"},
            "--integrator magic: must be one of explicit_euler, symplectic_euler, velocity_verlet"},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag"}, "--set drag: must be NAME=VALUE"},
           {{"run", "two_masses", "--seconds", "1", "--set", "dreg=1"}, "--set dreg=1: must name one of dimensions, substeps, "},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag=-1"}, "--set drag=-1: must be from 0 to 100 [1/s]"},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag=1x"}, "--set drag=1x: must be from 0 to 100"},
           {{"run", "two_masses", "--seconds", "1", "--set", "substeps=2.5"}, "--set substeps=2.5: must be whole"},
           {{"run", "two_masses", "--seconds", "1", "--set", "point_damping=2"}, "--set point_damping=2: must be on or off"},
           {{"run", "two_masses", "--seconds", "1", "--tolerance", "1e-6"}, "requires an adaptive method"},
           {{"convert", "two_masses"}, "OUT is required"},
           {{"convert", "two_masses", "out.bin"}, "out.bin: must end in .json"},
       }) {
    const Outcome outcome = headless(usage.words);
    EXPECT_EQ(outcome.code, 2) << usage.message;
    EXPECT_EQ(outcome.out, "") << usage.message;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(usage.message), std::string::npos) << outcome.err;
  }
}

TEST(Headless, RefusedInputIsCodeThreeWithOneLineOnStderr) {
  const ScratchFolder scratch;
  const std::string bad = write(scratch.folder / "bad.json", R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]})");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", bad, "--seconds", "1"}, {"convert", bad, (scratch.folder / "out.json").string()}}) {
    const Outcome outcome = headless(words);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "hooke-headless: " + bad + ": points[0].mass: -1: must be more than 0\n");
  }
  EXPECT_EQ(headless({"run", "/dev/zero", "--seconds", "1"}).code, 3);
  EXPECT_FALSE(fs::exists(scratch.folder / "out.json"));
}

TEST(Headless, AFileThatCannotBeReadOrWrittenIsCodeFive) {
  const ScratchFolder scratch;
  const std::string nowhere = (scratch.folder / "none" / "x.json").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", nowhere, "--seconds", "0.1"},
                                                {"run", "two_masses", "--seconds", "0.1", "--json", nowhere},
                                                {"run", "two_masses", "--seconds", "0.1", "--csv", nowhere},
                                                {"run", "two_masses", "--seconds", "0.1", "--pc2", nowhere},
                                                {"run", "two_masses", "--seconds", "0.1", "--json", "/dev/full"},
                                                {"convert", "two_masses", nowhere},
                                                {"convert", nowhere, "x.json"}}) {
    const Outcome outcome = headless(words);
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  }
}

TEST(Headless, ADivergedRunIsCodeFourAndNamesTheSpringTheCauseAndATestedRemedy) {
  const Outcome outcome = headless({"run", "unstable", "--seconds", "60", "--points", "63", "--json", "-", "-q"});
  EXPECT_EQ(outcome.code, 4);
  const rapidjson::Document json = parse(outcome.out);
  EXPECT_TRUE(json["diverged"].GetBool());
  EXPECT_LT(json["seconds"].GetDouble(), 60.0);
  // the last good state
  ASSERT_EQ(json["samples"].Size(), 1u);
  EXPECT_EQ(json["samples"][0]["time"].GetDouble(), json["seconds"].GetDouble());
  ASSERT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  for (const char* part : {"Stopped at t = ", "point ", "spring "}) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;

  // a quiet run skips the search for a remedy, which takes a second
  const Outcome loud = headless({"run", "unstable", "--seconds", "60"});
  EXPECT_EQ(loud.code, 4);
  for (const char* part : {"Cause: ", " does not diverge (tested for "}) EXPECT_NE(loud.err.find(part), std::string::npos) << loud.err;
}

TEST(Headless, OutputThatDoesNotFitOnStdoutIsCodeFive) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC), null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "two_masses", "--seconds", "0.1"},
                                                {"run", "two_masses", "--seconds", "0.1", "--json", "-"},
                                                {"run", "two_masses", "--seconds", "0.1", "--csv", "-"},
                                                {"check", "two_masses"},
                                                {"check", "--hard", "--cases", "14"},
                                                {"check", "--hard", "--cases", "14", "--json", "-"},
                                                {"--limits"},
                                                {"--version"},
                                                {"--help"},
                                                {"run", "--help"}}) {
    std::vector<std::string> command = words;
    command.insert(command.begin(), HOOKE_HEADLESS);
    EXPECT_EQ(wait_for(start_process(command, full, null)), 5) << words.front();
  }
  close(full);
  close(null);
}

TEST(Headless, AFileThatDoesNotFitLeavesTheOldOneAndIsCodeFive) {
  const ScratchFolder scratch;
  // a file size limit has the same effect as a full disk
  signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const char* option : {"--json", "--csv", "--pc2"}) {
    const std::string file = write(scratch.folder / "out", "old");
    const rlimit small{4096, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const Outcome outcome = headless({"run", "cloth", "--seconds", "0.1", "--sample", "0.01", "-q", option, file});
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(outcome.code, 5) << option;
    EXPECT_NE(outcome.err.find("out: cannot be written: File too large"), std::string::npos) << outcome.err;
    EXPECT_EQ(contents(file), "old") << option;
    EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder), {}), 1) << option;
  }
  signal(SIGXFSZ, SIG_DFL);
}

TEST(Headless, RunWritesEveryFieldOfItsJson) {
  const ScratchFolder scratch;
  const std::string scene = write(scratch.folder / "free.json", free_point);
  const Outcome outcome = headless({"run", scene, "--seconds", "1", "--sample", "0.25", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const rapidjson::Document json = parse(outcome.out);
  EXPECT_EQ(json.MemberCount(), 15u);
  EXPECT_EQ(json["scene"].GetString(), scene);
  EXPECT_EQ(json["points"].GetInt(), 1);
  EXPECT_EQ(json["springs"].GetInt(), 0);
  EXPECT_STREQ(json["integrator"].GetString(), "velocity_verlet");
  EXPECT_EQ(json["substeps"].GetInt(), 1);
  EXPECT_EQ(json["frame_rate"].GetDouble(), 10.0);
  EXPECT_NEAR(json["seconds"].GetDouble(), 1.0, 1e-12);
  EXPECT_GE(json["cpu_seconds"].GetDouble(), 0.0);
  EXPECT_GE(json["wall_seconds"].GetDouble(), 0.0);
  EXPECT_FALSE(json["diverged"].GetBool());
  EXPECT_GT(json["force_evaluations"].GetInt(), 0);
  EXPECT_EQ(json["factorizations"].GetInt(), 0);
  EXPECT_EQ(std::string(json["hash"].GetString()).find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(json["hash"].GetStringLength(), 16u);

  // the first frames that end at or after 0, 0.25, 0.5, 0.75 and 1 s
  const auto& samples = json["samples"];
  const double times[] = {0.0, 0.3, 0.5, 0.8, 1.0};
  ASSERT_EQ(samples.Size(), std::size(times));
  for (rapidjson::SizeType i = 0; i < samples.Size(); ++i) {
    const auto& sample = samples[i];
    EXPECT_EQ(sample.MemberCount(), 6u);
    EXPECT_NEAR(sample["time"].GetDouble(), times[i], 1e-12);
    EXPECT_NEAR(sample["positions"][0][0].GetDouble(), times[i], 1e-12);
    EXPECT_EQ(sample["positions"][0].Size(), 3u);
    EXPECT_EQ(sample["velocities"][0][0].GetDouble(), 1.0);
    EXPECT_EQ(sample["energy"].MemberCount(), 4u);
    for (const char* key : {"kinetic", "total"}) EXPECT_EQ(sample["energy"][key].GetDouble(), 1.0);
    for (const char* key : {"elastic", "gravitational"}) EXPECT_EQ(sample["energy"][key].GetDouble(), 0.0);
    // free motion is exact
    EXPECT_EQ(sample["error"].MemberCount(), 9u);
    for (const char* key : {"frame", "accumulated"}) {
      if (i == 0)
        EXPECT_TRUE(sample["error"][key].IsNull());
      else
        EXPECT_NEAR(sample["error"][key].GetDouble(), 0.0, 1e-12);
    }
  }
}

TEST(Headless, WithoutASamplingIntervalOnlyTheLastStateIsSampled) {
  const rapidjson::Document json = parse(headless({"run", "two_masses", "--seconds", "0.5", "--points", "1", "--json", "-"}).out);
  ASSERT_EQ(json["samples"].Size(), 1u);
  EXPECT_NEAR(json["samples"][0]["time"].GetDouble(), 0.5, 1e-12);
  EXPECT_EQ(json["samples"][0]["positions"].Size(), 1u);
}

TEST(Headless, RunStepsWholeFramesUntilTheSecondsAreCovered) {
  const auto seconds_of = [](const std::string& seconds) {
    return parse(headless({"run", "two_masses", "--seconds", seconds, "--frame-rate", "10", "--json", "-"}).out)["seconds"].GetDouble();
  };
  EXPECT_EQ(seconds_of("0"), 0.0);
  EXPECT_NEAR(seconds_of("0.3"), 0.3, 1e-12);
  EXPECT_NEAR(seconds_of("0.31"), 0.4, 1e-12);
}

TEST(Headless, ReportsTheHashThatALaboratoryComputes) {
  Lab lab(load_scene(find_scene("two_masses_bouncy")).scene);
  for (int frame = 0; frame < 60; ++frame) ASSERT_TRUE(lab.step());
  const rapidjson::Document json = parse(headless({"run", "two_masses_bouncy", "--seconds", "1", "--json", "-"}).out);
  for (rapidjson::SizeType c = 0; c < 3; ++c) {
    EXPECT_EQ(json["samples"][0]["positions"][1][c].GetDouble(), lab.scene().state.position[1][static_cast<int>(c)]);
    EXPECT_EQ(json["samples"][0]["velocities"][1][c].GetDouble(), lab.scene().state.velocity[1][static_cast<int>(c)]);
  }
  EXPECT_EQ(std::stoull(json["hash"].GetString(), nullptr, 16), hash_state(lab.scene().state));
}

TEST(Headless, EqualRunsHaveEqualHashesAndDifferentRunsDifferentOnes) {
  const auto hash_of = [](const char* substeps) {
    return std::string(
        parse(headless({"run", "rope", "--seconds", "0.1", "--substeps", substeps, "--points", "0", "--json", "-"}).out)["hash"]
            .GetString());
  };
  EXPECT_EQ(hash_of("40"), hash_of("40"));
  EXPECT_NE(hash_of("40"), hash_of("41"));
}

TEST(Headless, OptionsOverrideTheScene) {
  const rapidjson::Document json =
      parse(headless({"run", "rope", "--seconds", "0.1", "--integrator", "runge_kutta4", "--substeps", "7", "--frame-rate", "120", "--set",
                      "gravity=0", "--set", "damped_springs=off", "--points", "47", "--json", "-", "-q"})
                .out);
  EXPECT_STREQ(json["integrator"].GetString(), "runge_kutta4");
  EXPECT_EQ(json["substeps"].GetInt(), 7);
  EXPECT_EQ(json["frame_rate"].GetDouble(), 120.0);
  // nothing moves without gravity
  EXPECT_EQ(json["samples"][0]["velocities"][0][1].GetDouble(), 0.0);
  EXPECT_EQ(json["force_evaluations"].GetInt(), 12 * 7 * 4);
}

TEST(Headless, CsvHasOneRowPerSample) {
  const ScratchFolder scratch;
  const std::string file = (scratch.folder / "out.csv").string();
  const Outcome outcome = headless({"run", "two_masses", "--seconds", "0.1", "--sample", "0.05", "--points", "1,0", "--csv", file});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  const std::vector<std::string> lines = lines_of(contents(file));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "time [s],kinetic [J],elastic [J],gravitational [J],total [J],x1 [m],y1 [m],z1 [m],x0 [m],y0 [m],z0 [m]");
  EXPECT_EQ(lines[1], "0,0,0,4.9,4.9,0.5,0.5,0,0,0.5,0");
}

TEST(Headless, CsvContainsTheRequestedQuantities) {
  const ScratchFolder scratch;
  const std::string file = (scratch.folder / "out.csv").string();
  EXPECT_EQ(headless({"run", "two_masses", "--seconds", "0", "--csv", file, "--quantities", "time,length0, y1"}).code, 0);
  EXPECT_EQ(contents(file), "time [s],length0 [m],y1 [m]\n0,0.5,0.5\n");
  const Outcome refused = headless({"run", "two_masses", "--seconds", "0", "--csv", file, "--quantities", "time,y2"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--quantities y2: must be one of time, kinetic"), std::string::npos) << refused.err;
}

TEST(Headless, WithoutAFileASummaryGoesToStdoutUnlessQuiet) {
  const Outcome loud = headless({"run", "two_masses", "--seconds", "0.1"}),
                quiet = headless({"run", "two_masses", "--seconds", "0.1", "-q"});
  EXPECT_NE(loud.out.find("2 points, 1 spring;"), std::string::npos) << loud.out;
  EXPECT_NE(loud.out.find("hash "), std::string::npos);
  EXPECT_EQ(loud.err, "");
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST(Headless, WarningsGoToStderrUnlessQuiet) {
  const std::vector<std::string> words{"run", "cloth", "--seconds", "0", "--substeps", "1", "--json", "-"};
  const Outcome loud = headless(words);
  EXPECT_EQ(loud.err.find("warning: simulation.substeps: 1: may be too few for velocity_verlet here: "), 0u) << loud.err;
  EXPECT_EQ(loud.out.front(), '{');
  std::vector<std::string> quiet = words;
  quiet.emplace_back("--quiet");
  EXPECT_EQ(headless(quiet).err, "");
}

TEST(Headless, OnlyTheSelectedMethodAndStepAreWarnedAbout) {
  EXPECT_EQ(headless({"run", "unstable", "--seconds", "0", "--integrator", "symplectic_euler", "--json", "-"}).err, "");
}

TEST(Headless, RequiresNeitherADisplayNorAWorkingDirectory) {
  unsetenv("DISPLAY");
  const fs::path before = fs::current_path();
  fs::current_path("/");
  EXPECT_EQ(headless({"run", "cloth", "--seconds", "0.02", "-q"}).code, 0);
  fs::current_path(before);
}

TEST(Headless, ConvertWritesTheSameScene) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "out.json";
  EXPECT_EQ(headless({"convert", "grid_4x4", file.string()}).code, 0);
  const Scene original = load_scene(find_scene("grid_4x4")).scene, copy = load_scene(file).scene;
  EXPECT_EQ(copy.system, original.system);
  EXPECT_EQ(copy.state, original.state);
}

TEST(Headless, ASaveKilledAtAnyMomentLeavesTheOldFileOrTheNewOne) {
  const ScratchFolder scratch;
  const fs::path file = scratch.folder / "scene.json";

  // a net whose points are listed, so that saving takes long enough to be interrupted
  Scene large =
      parse_scene(
          R"({"hooke": 1, "name": "new", "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0],
                                "points": [90, 90], "stiffness": 1}], "simulation": {"substeps": 1000}})",
          "large")
          .scene;
  large.state.velocity[0].x = 1.0;
  const fs::path source = scratch.folder / "source.json";
  const std::string next = format_scene(large);
  write(source, next);
  large.name = "old";
  const std::string old = format_scene(large);

  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  std::mt19937 random(7);
  int seen_old = 0, seen_new = 0;
  const auto run = [&](long microseconds) {
    write(file, old);
    const pid_t child = start_process({HOOKE_HEADLESS, "convert", source.string(), file.string(), "-q"}, null, null);
    if (microseconds >= 0) {
      usleep(static_cast<useconds_t>(microseconds));
      kill(child, SIGKILL);
    }
    wait_for(child);
    const std::string content = contents(file);
    seen_old += content == old;
    seen_new += content == next;
    return content == old || content == next;
  };

  // measures the duration of a complete save, then kills at times spread over that duration and slightly more
  const auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(run(-1));
  const long whole = std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(seen_new, 1);
  for (int i = 0; i < 40; ++i) ASSERT_TRUE(run(static_cast<long>(random() % static_cast<unsigned long>(whole * 5 / 4)))) << "kill " << i;
  EXPECT_GT(seen_old, 0);
  close(null);

  // the next save removes temporary files
  ASSERT_TRUE(run(-1));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder), {}), 2);
}

}  // namespace
}  // namespace hooke
