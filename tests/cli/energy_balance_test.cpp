// The energy balance of `run` on scenes where a force, a limit or contact makes it difficult: correct runs are not accused, and failures
// are not explained away as the work of a force.
#include <gtest/gtest.h>

#include <map>

#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Outcome run_scene(const std::string& scene, const std::vector<std::string>& options) {
  const ScratchFolder scratch;
  std::vector<std::string> words{"run", write_file(scratch.folder / "scene.json", scene)};
  words.insert(words.end(), options.begin(), options.end());
  return headless(words);
}

const std::map<std::string, std::string> correct_scenes{
    {"at rest in the target of a pull",
     R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0.1, 0, 0]}, {"position": [0.2, 0, 0]}, {"position": [0.3, 0, 0]}],
         "forces": [{"type": "mass_center", "x": 0.2}]})"},
    {"far from a steep attraction",
     R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [10, 0, 0]}], "forces": [{"type": "center", "power": 4}]})"},
    {"far from a steep wall",
     R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0, 5, 0], "velocity": [0.001, 0, 0]}],
         "forces": [{"type": "wall", "power": 4, "core": 1e-3}],
         "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]}]})"},
    {"longer than the strain limit, in still air",
     R"({"hooke": 1, "gravity": [0, 0, 0], "strain_limit_percent": 50, "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [2, 0, 0]}],
         "springs": [{"points": [0, 1], "stiffness": 10, "rest_length": 1}], "forces": [{"type": "wind", "x": 0, "y": 0, "z": 0}]})"},
    {"longer than the strain limit, damped",
     R"({"hooke": 1, "gravity": [0, 0, 0], "strain_limit_percent": 5, "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [2, 0, 0]}],
         "springs": [{"points": [0, 1], "stiffness": 10, "rest_length": 1}],
         "forces": [{"type": "mass_center", "x": 0.5, "stiffness": 0, "damping": 100}]})"},
};

TEST(EnergyBalance, DoesNotAccuseCorrectRuns) {
  for (const auto& [name, scene] : correct_scenes)
    for (const char* method : {"velocity_verlet", "dop853", "implicit_midpoint"}) {
      const Outcome run = run_scene(scene, {"--seconds", "1", "--integrator", method, "--substeps", "100"});
      EXPECT_EQ(run.code, 0) << name << ", " << method << ": " << run.err;
      EXPECT_EQ(run.err.find("energy"), std::string::npos) << name << ", " << method << ": " << run.err;
    }
}

// The acceleration x^3 leads to infinity within two seconds.
TEST(EnergyBalance, StopsARepulsionThatGrowsWithTheDistance) {
  const std::string scene = R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [1, 0, 0]}],
    "forces": [{"type": "center", "strength": -1, "power": -3}]})";
  for (const char* method : {"velocity_verlet", "implicit_euler", "esdirk4", "tr_bdf2", "implicit_midpoint", "runge_kutta4"}) {
    const Outcome run = run_scene(scene, {"--seconds", "3", "--integrator", method, "--json", "/dev/null"});
    EXPECT_EQ(run.code, 4) << method << ": " << run.err;
    EXPECT_EQ(run.err.find("tested"), std::string::npos) << method << ", which nothing can cure: " << run.err;
  }
}

// The energy that an attraction gives and takes on each orbit is not supplied again and again, which would hide the error of the method.
TEST(EnergyBalance, OfAnOrbitIsRelativeToTheEnergyOfTheOrbit) {
  const std::string scene =
      R"({"hooke": 1, "dimensions": 2, "gravity": [0, 0, 0], "points": [{"position": [1, 0, 0], "velocity": [0, 0.3, 0]}],
    "forces": [{"type": "center", "strength": 1, "power": 2, "core": 0.01}]})";
  for (const char* seconds : {"20", "60"}) {
    const Outcome run = run_scene(scene, {"--seconds", seconds, "--integrator", "tr_bdf2", "--substeps", "2"});
    EXPECT_NE(run.err.find("energy balance off by"), std::string::npos) << seconds << " s: " << run.err;
  }
  const Outcome exact = run_scene(scene, {"--seconds", "60", "--integrator", "dop853"});
  EXPECT_EQ(exact.err, "");
}

// Contact moves the point by half a meter in a substep, which is no motion in which the air works.
TEST(EnergyBalance, OfAPointThatIsPushedOutOfTheFloorDoesNotDependOnStillAir) {
  const std::string begin = R"({"hooke": 1, "points": [{"position": [0, -0.5, 0]}, {"position": [0, 1, 0]}],
    "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]}])";
  const Outcome without = run_scene(begin + "}", {"--seconds", "1"});
  const Outcome with = run_scene(begin + R"(, "forces": [{"type": "wind", "x": 0, "y": 0, "z": 0}]})", {"--seconds", "1"});
  EXPECT_EQ(with.code, 0);
  EXPECT_EQ(with.err, without.err);
}

TEST(EnergyBalance, DashpotsNeverSupplyEnergyAndTheMethodIsSeparatedUntilRest) {
  const std::string scene =
      R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [1.5, 0, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 1000, "damping": 20, "rest_length": 1}]})";
  for (const char* method : {"xpbd", "velocity_verlet"}) {
    const Outcome run = run_scene(scene, {"--seconds", "4", "--sample", "0.1", "--integrator", method, "--substeps", "40", "--json", "-"});
    const rapidjson::Document json = parse_json(run.out);
    double before = 0.0;
    for (const auto& sample : json["samples"].GetArray()) {
      const auto& balance = sample["energy_balance"];
      const double dashpots = balance["dashpots"].GetDouble();
      EXPECT_LE(dashpots, before + 1e-12) << method;
      EXPECT_GE(dashpots, -125.0 * 1.01) << method;
      before = dashpots;
    }
    EXPECT_LE(before, -0.8 * 125.0) << method;
  }
}

TEST(Outputs, DoNotReplaceTheSceneOrEachOther) {
  const ScratchFolder scratch;
  const std::string text = R"({"hooke": 1, "points": [{"position": [0, 0, 0]}]})";
  const std::string scene = write_file(scratch.folder / "scene.json", text), other = (scratch.folder / "out").string();
  std::filesystem::create_symlink("scene.json", scratch.folder / "link.json");
  const std::string link = (scratch.folder / "link.json").string();
  const std::string around = (scratch.folder / ".." / scratch.folder.filename() / "scene.json").string();
  for (const char* option : {"--json", "--csv", "--pc2"})
    for (const std::string& file : {scene, link, around}) {
      const Outcome run = headless({"run", scene, "--seconds", "0.1", option, file});
      EXPECT_EQ(run.code, 2) << option << " " << file;
      EXPECT_NE(run.err.find("would replace the scene"), std::string::npos) << run.err;
      EXPECT_EQ(contents(scene), text);
    }
  EXPECT_EQ(headless({"run", scene, "--seconds", "0.1", "--json", other, "--csv", other}).code, 2);
  EXPECT_EQ(headless({"run", scene, "--seconds", "0.1", "--json", "-", "--csv", "-"}).code, 2);
  EXPECT_EQ(headless({"run", scene, "--seconds", "0.1", "--json", "/dev/null", "--csv", "/dev/null"}).code, 0);
}

}  // namespace
}  // namespace hooke
