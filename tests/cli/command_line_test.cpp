// hooke-headless as used by scripts: exit codes, stdout and stderr, complete files.

#include <gtest/gtest.h>
#include <rapidjson/document.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <random>

#include "base/build_info.h"
#include "formats/scene_file.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

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
    const std::vector<std::string> version = lines_of(output_of("--version"));
    ASSERT_EQ(version.size(), 2u);
    EXPECT_EQ(version[0], std::string("hooke-headless ") + program_version);
    EXPECT_EQ(version[1].substr(0, 5), "GPU: ");
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
           Usage{
               {},
               "no command: must be one of run, bench, sweep, capture, check, convert, replay, as in hooke-headless run cloth --seconds 1"},
           {{"run", "two_masses", "--seconds", "1", "--seconds", "2"}, "--seconds: must be given once (see --help)"},
           {{"run", "two_masses", "--seconds", "1", "--quiet=x"}, "--quiet: x: must have no value (see --help)"},
           {{"fly"}, "fly: no such command: must be one of run, bench, "},
           {{"foo", "x"}, "foo: no such command: must be one of run, bench, "},
           {{"chek", "cloth"},
            "chek: no such command: must be one of run, bench, sweep, capture, check, convert, replay; did you mean check?"},
           {{"run"}, "SCENE is required"},
           {{"run", "two_masses"}, "--seconds is required"},
           {{"run", "two_masses", "--seconds", "-1"}, "--seconds: -1: must be at least 0"},
           {{"run", "two_masses", "--seconds", "nan"}, "--seconds: nan: not a finite number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "inf"}, "--seconds: inf: not a finite number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "abc"}, "--seconds: abc: not a number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "1e300"}, "must be at most 1e15 frames"},
           {{"run", "two_masses", "--seconds", "1", "--warp", "9"}, "--warp: no such option (see --help)"},
           {{"run", "two_masses", "--second", "1"}, "--second: no such option; did you mean --seconds? (see --help)"},
           {{"--versio"}, "--versio: no such option; did you mean --version? (see --help)"},
           {{"run", "two_masses", "--seconds", "1", "-s", "9"}, "-s: no such option"},
           {{"run", "two_masses", "--seconds"}, "--seconds: its value is missing"},
           {{"run", "two_masses", "a", "b", "--seconds", "1"}, "not expected: a b (see --help)"},
           {{"run", "two_masses", "--seconds", "100,5"}, "--seconds: 100,5: not a number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "0x10"}, "--seconds: 0x10: not a number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "1", "--substeps", "0x10"}, "--substeps: 0x10: not a number: must be from 1"},
           {{"check", "--hard", "--cases", "1,0x2"}, "--cases: 0x2: not a number: must be from 1"},
           {{"run", "two_masses", "--seconds", "1", "--substeps", "1.5"}, "--substeps: 1.5: not a whole number"},
           {{"run", "two_masses", "--seconds", "1", "--set", "stiffness=100,5"},
            "--set stiffness=100,5: not a number: must be from 0 to 1000000000000 [N/m]"},
           {{"sweep", "two_masses", "--seconds", "1", "--vary", "stiffness=1,x", "--measure", "total", "--out", "/tmp"},
            "--vary stiffness=1,x: x: not a number: must be from 0 to"},
           {{"run", "two_masses", "--seconds", "1", "--fail-above", "1", "--accuracy", "off"}, "--fail-above: requires --accuracy full"},
           {{"run", "two_masses", "--seconds", "1", "--threads", "0"}, "--threads: 0: must be from 1 to 64"},
           {{"run", "two_masses", "--seconds", "1", "--precision", "half"}, "--precision: half: must be double or single"},
           {{"run", "two_masses", "--seconds", "1", "--precision", "single"}, "--precision single: not for springs with dashpots"},
           {{"run", "two_masses", "--seconds", "1", "--substeps", "0"}, "--substeps: 0: must be from 1 to 1000000"},
           {{"run", "two_masses", "--seconds", "1", "--frame-rate", "0"}, "--frame-rate: 0: must be more than 0"},
           {{"run", "two_masses", "--seconds", "1", "--sample", "0"}, "--sample: 0: must be more than 0"},
           {{"run", "two_masses", "--seconds", "1", "--points", "0,2"}, "--points 0,2: must be numbers from 0 to 1"},
           {{"run", "two_masses", "--seconds", "1", "--points", "0,,1"}, "--points 0,,1: must be numbers"},
           {{"run", "two_masses", "--seconds", "1", "--integrator", "magic"},
            "--integrator magic: must be one of explicit_euler, symplectic_euler, velocity_verlet"},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag"}, "--set drag: must be NAME=VALUE"},
           {{"run", "two_masses", "--seconds", "1", "--set", "dreg=1"},
            "--set dreg: no such parameter: must be one of dimensions, substeps, "},
           {{"run", "two_masses", "--seconds", "1", "--set", "dreg=1"}, "; did you mean drag?"},
           {{"run", "two_masses", "--seconds", "1", "--integrator", "verlet"}, "; did you mean velocity_verlet?"},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag=-1"}, "--set drag=-1: must be at least 0 [1/s]"},
           {{"run", "two_masses", "--seconds", "1", "--set", "drag=1x"}, "--set drag=1x: not a number: must be at least 0"},
           {{"run", "two_masses", "--seconds", "1", "--set", "substeps=2.5"}, "--set substeps=2.5: must be whole"},
           {{"run", "two_masses", "--seconds", "1", "--set", "point_damping=2"}, "--set point_damping=2: must be on or off"},
           {{"run", "two_masses", "--seconds", "1", "--integrator", "xpbd", "--tolerance", "1e-6"}, "requires an adaptive method"},
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
  const std::string bad = write_file(scratch.folder / "bad.json", R"({"hooke": 1, "points": [{"position": [0, 0, 0], "mass": -1}]})");
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

TEST(Headless, MessagesDoNotRepeatAllOfALongArgument) {
  const std::string name(100'000, 'A');
  for (const std::vector<std::string>& words : {std::vector<std::string>{name},
                                                {"run", name, "--seconds", "0.1"},
                                                {"run", "two_masses", "--seconds", name},
                                                {"run", "two_masses", "--seconds", "0.1", name},
                                                {"run", "two_masses", "--seconds", "0.1", "--" + name},
                                                {"run", "two_masses", "--seconds", "0.1", "--json", name},
                                                {"run", "rope_64", "--seconds", "0.1", "--engine", name},
                                                {"capture", "two_masses", "--out", name},
                                                {"check", name},
                                                {"replay", name},
                                                {"convert", "two_masses", name}}) {
    const Outcome outcome = headless(words);
    EXPECT_TRUE(outcome.code == 2 || outcome.code == 5) << outcome.err;
    EXPECT_EQ(lines_of(outcome.err).size(), 1u);
    EXPECT_LT(outcome.err.size(), 2100u) << words[0];
    EXPECT_NE(outcome.err.find(": ", 20), std::string::npos) << "the reason: " << outcome.err;
  }
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
  const rapidjson::Document json = parse_json(outcome.out);
  EXPECT_TRUE(json["diverged"].GetBool());
  EXPECT_LT(json["seconds"].GetDouble(), 60.0);
  // the last good state
  ASSERT_EQ(json["samples"].Size(), 1u);
  EXPECT_EQ(json["samples"][0]["time"].GetDouble(), json["seconds"].GetDouble());
  ASSERT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  for (const char* part : {" at t = ", "point ", "spring "}) EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;

  // a quiet run skips the search for a remedy, which takes a second
  const Outcome loud = headless({"run", "unstable", "--seconds", "60"});
  EXPECT_EQ(loud.code, 4);
  const std::string last = lines_of(loud.err).back();
  for (const char* part : {". Use ", ", which does not diverge (tested for ", ": the step is beyond the linear stability limit"})
    EXPECT_NE(last.find(part), std::string::npos) << last;
  EXPECT_EQ(last.find(". ", last.find(". Use ") + 1), std::string::npos) << "more than two sentences: " << last;
  // the search is announced before it starts
  const std::size_t announced = loud.err.find("Looking for the cause"), found = loud.err.find("The simulation blew up");
  ASSERT_NE(found, std::string::npos) << loud.err;
  EXPECT_LT(announced, found) << loud.err;
}

TEST(Headless, OutputThatDoesNotFitOnStdoutIsCodeFive) {
  const int full = open("/dev/full", O_WRONLY | O_CLOEXEC), null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"run", "two_masses", "--seconds", "0.1"},
                                                {"run", "two_masses", "--seconds", "0.1", "--json", "-"},
                                                {"run", "two_masses", "--seconds", "0.1", "--csv", "-"},
                                                {"check", "two_masses"},
                                                {"check", "--hard", "--cases", "5", "--methods", "symplectic_euler"},
                                                {"check", "--hard", "--cases", "5", "--methods", "symplectic_euler", "--json", "-"},
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
    const std::string file = write_file(scratch.folder / "out", "old");
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
                                "points": [60, 60], "stiffness": 1}], "simulation": {"substeps": 1000}})",
          "large")
          .scene;
  large.state.velocity[0].x = 1.0;
  const fs::path source = scratch.folder / "source.json";
  const std::string next = format_scene(large);
  write_file(source, next);
  large.name = "old";
  const std::string old = format_scene(large);

  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  std::mt19937 random(7);
  int seen_old = 0, seen_new = 0;
  const auto run = [&](long microseconds) {
    write_file(file, old);
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
  for (int i = 0; i < 12; ++i) ASSERT_TRUE(run(static_cast<long>(random() % static_cast<unsigned long>(whole * 5 / 4)))) << "kill " << i;
  EXPECT_GT(seen_old, 0);
  close(null);

  // the next save removes temporary files
  ASSERT_TRUE(run(-1));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder), {}), 2);
}

}  // namespace
}  // namespace hooke
