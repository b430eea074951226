// `hooke convert` to LAMMPS, with the real LAMMPS of Debian.
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "formats/lammps/lammps_dump.h"
#include "support/contents.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

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

Outcome headless(Words words) {
  words.insert(words.begin(), HOOKE_HEADLESS);
  return run_process(words);
}

rapidjson::Document run_json(const Words& words) {
  const Outcome outcome = headless(words);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(outcome.out.c_str());
  EXPECT_FALSE(document.HasParseError()) << outcome.out.substr(0, 200);
  return document;
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

}  // namespace
}  // namespace hooke
