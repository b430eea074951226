// `hooke convert` to LAMMPS and `hooke run --engine` with the real LAMMPS of Debian.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "formats/lammps/lammps_dump.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A sheet nailed at its border, which is always in tension, so that rounding errors do not grow, and two masses with a velocity; points of
// many masses. 1000 steps are half a second.
constexpr const char* scene_text = R"({"hooke": 1, "gravity": [0.5, -9.81, 1], "drag": DRAG, "wind": [2, 0, 1],
  "points": [{"position": [3, 0, 0], "velocity": [1, 2, -1], "mass": 2}, {"position": [3, 1, 0.5], "mass": 0.7}],
  "springs": [{"points": [0, 1], "stiffness": 30, "rest_length": 0.8}],
  "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1], "points": [14, 11], "density": 0.2,
                  "stiffness": 100, "damping": 0, "nail": ["border"]}],
  "simulation": {"integrator": "velocity_verlet", "frame_rate": 100, "substeps": 20}})";

std::string write_scene(const fs::path& file, const std::string& drag) {
  std::string text = scene_text;
  text.replace(text.find("DRAG"), 4, drag);
  std::ofstream(file) << text;
  return file;
}

// MPI refuses to run as root or with more ranks than cores, as tests in containers do.
Outcome headless_with_mpi(const std::vector<std::string>& words) {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"})
    setenv(name, "1", 1);
  return headless(words);
}

rapidjson::Document run_json(const std::vector<std::string>& words) {
  const Outcome outcome = headless_with_mpi(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return parse_json(outcome.out);
}

// The maximum difference of the vectors of two samples.
double max_difference(const rapidjson::Value& first, const rapidjson::Value& second, const char* key) {
  const auto a = first[key].GetArray(), b = second[key].GetArray();
  EXPECT_EQ(a.Size(), b.Size());
  double max = 0.0;
  for (rapidjson::SizeType i = 0; i < a.Size(); ++i)
    for (rapidjson::SizeType c = 0; c < 3; ++c) max = std::max(max, std::abs(a[i][c].GetDouble() - b[i][c].GetDouble()));
  return max;
}

TEST(Lammps, RunsAConvertedSceneAsVelocityVerletDoes) {
  const ScratchFolder scratch;
  for (const char* drag : {"0", "0.8"}) {
    const std::string scene = write_scene(scratch.folder / "scene.json", drag);
    ASSERT_EQ(headless({"convert", scene, scratch.folder / "out.lmp"}).code, 0);
    const std::string here = fs::current_path();
    fs::current_path(scratch.folder);
    const Outcome lammps = run_process({LAMMPS, "-in", "out.lmp", "-log", "none", "-var", "steps", "1000", "-var", "every", "1000"});
    fs::current_path(here);
    ASSERT_EQ(lammps.code, 0) << lammps.out;

    const auto ours = run_json({"run", scene, "--seconds", "0.5", "--accuracy", "off", "--json", "-"});
    const auto points = ours["samples"][0]["positions"].GetArray();
    LammpsDump dump(scratch.folder / "out.dump", points.Size());
    LammpsFrame frame;
    while (dump.next(frame)) {
    }
    ASSERT_EQ(frame.step, 1000);
    double max = 0.0, motion = 0.0;
    for (rapidjson::SizeType i = 0; i < points.Size(); ++i)
      for (rapidjson::SizeType c = 0; c < 3; ++c) {
        const auto component = static_cast<glm::length_t>(c);
        max = std::max(max, std::abs(points[i][c].GetDouble() - frame.position[i][component]));
        motion = std::max(motion, std::abs(frame.velocity[i][component]));
      }
    EXPECT_LE(max, 1e-12) << "drag " << drag;
    EXPECT_GT(motion, 0.1);
    RecordProperty(std::string("max_difference_drag_") + drag, std::to_string(max));
  }
}

TEST(Lammps, IsAnEngineOfRun) {
  const ScratchFolder scratch;
  for (const char* drag : {"0", "0.8"}) {
    const std::string scene = write_scene(scratch.folder / "scene.json", drag);
    const std::vector<std::string> words{"run",       scene,
                                         "--seconds", "0.5",
                                         "--sample",  "0.05",
                                         "--json",    "-",
                                         "--csv",     scratch.folder / "run.csv",
                                         "--pc2",     scratch.folder / "run.pc2"};
    std::vector<std::string> with_engine = words, alone = words;
    with_engine.insert(with_engine.end(), {"--engine", LAMMPS});
    alone.insert(alone.end(), {"--accuracy", "off"});
    const auto theirs = run_json(with_engine);
    const std::string csv = contents(scratch.folder / "run.csv"), cache = contents(scratch.folder / "run.pc2");
    const auto ours = run_json(alone);
    ASSERT_EQ(theirs["samples"].Size(), 11u);
    ASSERT_EQ(ours["samples"].Size(), 11u);
    for (rapidjson::SizeType i = 0; i < 11; ++i) {
      const auto &a = theirs["samples"][i], &b = ours["samples"][i];
      EXPECT_EQ(a["time"].GetDouble(), b["time"].GetDouble());
      EXPECT_LE(max_difference(a, b, "positions"), 1e-12);
      EXPECT_LE(max_difference(a, b, "velocities"), 1e-10);
      EXPECT_NEAR(a["energy"]["total"].GetDouble(), b["energy"]["total"].GetDouble(), 1e-10);
    }
    EXPECT_EQ(theirs["seconds"].GetDouble(), 0.5);
    EXPECT_EQ(theirs["force_evaluations"].GetInt(), 1001);
    EXPECT_FALSE(theirs["diverged"].GetBool());
    const std::string reason = theirs["samples"][0]["error"]["reason"].GetString();
    EXPECT_NE(reason.find("energy_balance: not measured with --engine"), std::string::npos) << reason;
    EXPECT_STREQ(theirs["samples"][0]["half_error"]["reason"].GetString(), "not measured with --engine");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 12);
    EXPECT_EQ(cache.size(), contents(scratch.folder / "run.pc2").size());
  }
}

TEST(Lammps, TwoRanksGiveTheSameMotion) {
  const ScratchFolder scratch;
  const std::string scene = write_scene(scratch.folder / "scene.json", "0.8");
  const std::vector<std::string> words{"run", scene, "--seconds", "0.5", "--json", "-"};
  std::vector<std::string> two = words, alone = words;
  two.insert(two.end(), {"--engine", std::string(MPIRUN) + " -np 2 " + LAMMPS});
  alone.insert(alone.end(), {"--accuracy", "off"});
  const auto theirs = run_json(two), ours = run_json(alone);
  const double difference = max_difference(theirs["samples"][0], ours["samples"][0], "positions");
  EXPECT_LE(difference, 1e-10);
  // LAMMPS has computed it: its rounding differs
  EXPECT_STRNE(theirs["hash"].GetString(), ours["hash"].GetString());
}

TEST(Lammps, TheSummarySaysThatTheErrorIsNotMeasured) {
  const ScratchFolder scratch;
  const Outcome outcome = headless({"run", write_scene(scratch.folder / "scene.json", "0"), "--seconds", "0.1", "--engine", LAMMPS});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(lines_of(outcome.out).back(), "error of a frame, accumulated, predictability: not measured with --engine");
}

TEST(Lammps, APointBouncesOnAPlane) {
  const ScratchFolder scratch;
  const fs::path scene = scratch.folder / "bounce.json";
  std::ofstream(scene) << R"({"hooke": 1, "gravity": [0, -9.81, 0], "points": [{"position": [0, 1, 0], "radius": 0.1}],
    "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "restitution": 1, "friction": 0}],
    "simulation": {"frame_rate": 100, "substeps": 100}})";
  const std::vector<std::string> words{"run", scene, "--seconds", "0.8", "--json", "-"};
  std::vector<std::string> with_engine = words;
  with_engine.insert(with_engine.end(), {"--engine", LAMMPS});
  const auto theirs = run_json(with_engine), ours = run_json(words);
  EXPECT_GT(ours["samples"][0]["positions"][0][1].GetDouble(), 0.5) << "it has bounced once";
  // LAMMPS reflects at the end of a step: gravity then acts in the wrong direction for less than a step h, a velocity of at most 2 g h
  EXPECT_LE(max_difference(theirs["samples"][0], ours["samples"][0], "positions"), 2.0 * 9.81 * 1e-4 * 0.4);
}

struct Failure {
  std::string engine;
  int code;
  std::string message;
};

TEST(Lammps, AFailingEngineIsOneLine) {
  const ScratchFolder scratch;
  const std::string scene = write_scene(scratch.folder / "scene.json", "0"), json = scratch.folder / "run.json";
  for (const Failure& failure : {
           Failure{"no_such_engine -np 2", 5, "--engine \"no_such_engine -np 2\": no_such_engine: cannot be started: No such file"},
           {"false", 5, "--engine \"false\": failed with exit code 1"},
           {"true", 5, "--engine \"true\": ended without writing a frame"},
           {std::string(LAMMPS) + " -bad_option", 5, "ERROR: Invalid command-line argument"},
           {std::string(MPIRUN) + " -np 2 no_such_program", 5, "executable file, and therefore did not launch the job"},
           {std::string(MPIRUN) + " -np 2 /etc/passwd", 5, "could not access or execute an executable"},
           {std::string(MPIRUN) + " -np 2 false", 5, ", but 1 process returned a non-zero exit code"},
           {" ", 2, "--engine: must be a command"},
       }) {
    const Outcome outcome = headless_with_mpi({"run", scene, "--seconds", "0.5", "--json", json, "--engine", failure.engine});
    EXPECT_EQ(outcome.code, failure.code) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(failure.message), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(json));
  }
  for (const std::vector<std::string>& extra :
       {std::vector<std::string>{"--integrator", "xpbd"}, {"--accuracy", "full"}, {"--csv", "-", "--quantities", "time,error"}}) {
    std::vector<std::string> words{"run", scene, "--seconds", "0.5", "--engine", LAMMPS};
    words.insert(words.end(), extra.begin(), extra.end());
    const Outcome outcome = headless(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("--engine"), std::string::npos) << outcome.err;
  }
}

TEST(Lammps, ADivergedRunEndsWithItsLastValidState) {
  const ScratchFolder scratch;
  const std::string json = scratch.folder / "run.json";
  const Outcome outcome =
      headless({"run", "rope_64", "--substeps", "1", "--seconds", "1", "--sample", "0.016", "-q", "--json", json, "--engine", LAMMPS});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_TRUE(outcome.err.find("diverged") != std::string::npos || outcome.err.find("blew up") != std::string::npos) << outcome.err;
  const rapidjson::Document run = parse_json(contents(json));
  EXPECT_TRUE(run["diverged"].GetBool());
  EXPECT_LT(run["seconds"].GetDouble(), 0.5);
  // the frames before, of which one was written each 1/60 s
  const auto samples = run["samples"].GetArray();
  ASSERT_GE(samples.Size(), 2u);
  EXPECT_EQ(samples[samples.Size() - 1]["time"].GetDouble(), run["seconds"].GetDouble());
  EXPECT_LT(samples[samples.Size() - 1]["energy"]["total"].GetDouble(), 100.0);
}

TEST(Lammps, CtrlCEndsTheEngineAndLeavesNoFiles) {
  const ScratchFolder scratch;
  const std::string scene = write_scene(scratch.folder / "scene.json", "0"), json = scratch.folder / "run.json";
  const fs::path temporary = scratch.folder / "temporary";
  fs::create_directories(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  const pid_t child =
      start_process({HOOKE_HEADLESS, "run", scene, "--seconds", "1e5", "--sample", "0.1", "--json", json, "--engine", LAMMPS},
                    STDERR_FILENO, STDERR_FILENO);
  // until it runs
  const auto dump = [&] {
    for (const auto& entry : fs::recursive_directory_iterator(temporary))
      if (entry.path().filename() == "scene.dump") return true;
    return false;
  };
  for (int i = 0; i < 3000 && !dump(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  // as timeout(1) does: to the program, and at once again to its group
  kill(child, SIGINT);
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130);
  unsetenv("TMPDIR");
  EXPECT_FALSE(fs::exists(json));
  // Open MPI leaves files of its own
  for (const auto& entry : fs::directory_iterator(temporary)) EXPECT_FALSE(entry.path().filename().string().starts_with("hooke"));
}

}  // namespace
}  // namespace hooke
