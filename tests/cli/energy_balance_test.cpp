// The energy balance of `run` on scenes where a force, a limit or contact makes it difficult: correct runs are not accused, and failures
// are not explained away as the work of a force.
#include <gtest/gtest.h>

#include <cmath>
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
    {"pushed by a plane again and again, and stopped by a damping each time",
     R"({"hooke": 1, "points": [{"position": [-0.4, -0.1, -0.3], "mass": 0.127}],
         "colliders": [{"type": "plane", "point": [0, -0.4, 0], "normal": [0.2, 1, 0], "restitution": 1, "oscillate": [0.6, 0.2, 0.6],
                        "frequency": 1.77}],
         "forces": [{"type": "mass_center", "stiffness": 5.4, "damping": 323}]})"},
};

TEST(EnergyBalance, DoesNotAccuseCorrectRuns) {
  for (const auto& [name, scene] : correct_scenes)
    for (const char* method : {"velocity_verlet", "dop853", "implicit_midpoint"}) {
      const Outcome run = run_scene(scene, {"--seconds", "1", "--integrator", method, "--substeps", "100"});
      EXPECT_EQ(run.code, 0) << name << ", " << method << ": " << run.err;
      EXPECT_EQ(run.err.find("energy"), std::string::npos) << name << ", " << method << ": " << run.err;
    }
}

// The damping stops the point in a fraction of the first substep, in which the force cannot take more energy than is missing.
TEST(EnergyBalance, OfADampingThatSubstepsDoNotResolveIsTheWorkOfTheForce) {
  const std::string scene = R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0.1, 0, 0], "mass": 0.5, "velocity": [1, 0, 0]}],
    "forces": [{"type": "mass_center", "stiffness": 100, "damping": 517.5}]})";
  for (const char* method : {"blanes_moan4", "implicit_euler", "implicit_midpoint", "tr_bdf2", "baraff_witkin"})
    for (const char* seconds : {"0.1", "2"}) {
      const Outcome run = run_scene(scene, {"--seconds", seconds, "--integrator", method, "--substeps", "5"});
      EXPECT_EQ(run.code, 0) << method << ": " << run.err;
      EXPECT_EQ(run.err.find("energy balance off"), std::string::npos) << method << ", " << seconds << " s: " << run.err;
    }
}

// The method stops the vibration in a few steps. Drag could do so in a second, but has not by then.
TEST(EnergyBalance, ReportsALossThatDragCouldHaveCausedLater) {
  const Outcome run = run_scene(R"({"hooke": 1, "gravity": [0, 0, 0], "drag": 0.5, "points": [{"position": [0, 0, 0], "nailed": true},
    {"position": [1.2, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": 1000, "rest_length": 1}],
    "simulation": {"integrator": "implicit_euler", "substeps": 1}})",
                                {"--seconds", "4"});
  EXPECT_NE(run.err.find("of the energy supplied (loss until 0."), std::string::npos) << run.err;
}

// A box presses a cloth together, which contact stretches and the strain limit shortens in every substep: what one of them takes and the
// other returns is no gain.
TEST(EnergyBalance, OfContactAgainstTheStrainLimitIsNoGain) {
  const Outcome run = run_scene(R"({"hooke": 1, "strain_limit_percent": 1, "generators": [{"type": "cloth", "corner": [-0.5, 0.06, -0.5],
    "across": [1, 0.05, 0], "down": [0, 0, 1], "points": [5, 5], "density": 0.1, "stiffness": 500}],
    "contact": {"faces": true, "thickness": 0.006, "friction": 0.3},
    "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.3},
      {"type": "box", "min": [-0.2, 0.15, -0.2], "max": [0.2, 0.3, 0.2], "oscillate": [0, 0.15, 0], "frequency": 5, "phase": 1.5708}],
    "simulation": {"substeps": 40}})",
                                {"--seconds", "1", "--sample", "1", "--json", "-"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.err.find("energy balance off"), std::string::npos) << run.err;
  const rapidjson::Document json = parse_json(run.out);
  const auto& balance = json["samples"][json["samples"].Size() - 1]["energy_balance"];
  EXPECT_GT(balance["colliders"].GetDouble(), 0.0);
  EXPECT_LT(std::abs(balance["method"].GetDouble()), 0.02 * balance["colliders"].GetDouble());
}

// A wall attracts a point so much at the end of its fall that the method gains energy there, and loses more in the impact.
TEST(EnergyBalance, SaysUntilWhenThereWasAGainThatIsGone) {
  const Outcome run = run_scene(R"({"hooke": 1, "points": [{"position": [0, 1, 0], "velocity": [0.3, 0, 0]}],
    "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "restitution": 0.9}],
    "forces": [{"type": "wall", "strength": -1, "power": 2, "core": 0.01}], "simulation": {"substeps": 4}})",
                                {"--seconds", "2", "--sample", "2", "--json", "-"});
  const rapidjson::Document json = parse_json(run.out);
  const auto& samples = json["samples"].GetArray();
  EXPECT_LT(samples[samples.Size() - 1]["energy_balance"]["method"].GetDouble(), 0.0);
  EXPECT_NE(run.err.find("of the energy supplied (gain until 0."), std::string::npos) << run.err;
}

// In its first step, explicit Euler gains energy before the force has done work.
TEST(EnergyBalance, DoesNotStopAStartFromRest) {
  const Outcome run = run_scene(R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [1, 0, 0]}],
    "forces": [{"type": "mass_center", "stiffness": 1, "damping": 0}], "simulation": {"integrator": "explicit_euler", "substeps": 1}})",
                                {"--seconds", "1"});
  EXPECT_EQ(run.code, 0) << run.err;
}

// The acceleration x^3 leads to infinity within two seconds.
TEST(EnergyBalance, StopsARepulsionThatGrowsWithTheDistance) {
  const std::string scene = R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [1, 0, 0]}],
    "forces": [{"type": "center", "strength": -1, "power": -3}]})";
  for (const char* method : {"velocity_verlet", "implicit_euler", "tr_bdf2"}) {
    const Outcome run = run_scene(scene, {"--seconds", "3", "--integrator", method, "--json", "/dev/null"});
    EXPECT_EQ(run.code, 4) << method << ": " << run.err;
    EXPECT_EQ(run.err.find("tested"), std::string::npos) << method << ", which nothing can cure: " << run.err;
  }
}

// A rope, springs that a hand winds around it, and a ball that moves: the method gains energy without bounds, which neither the hand nor
// the ball can have supplied.
TEST(EnergyBalance, StopsAnInstabilityOfContactBesideAMovingCollider) {
  const std::string scene =
      R"({"hooke": 1, "dimensions": 3, "gravity": [0, 0, 0], "generators": [{"type": "rope", "from": [0, 0, 0], "to": [0.5309547518490527, 
    0.2074457820622187, 0], "points": 14, "mass": 0.9136400559861352, "stiffness": 4815.301528366688, "damping": 0, "nail": ["from", 
    "to"]}], "points": [{"position": [0.38587739827647866, 0.48196488839241025, 0.14629715131862442], "mass": 1.0, 
    "velocity": [1.1217132809631045, 0.3587525519935578, -1.3236425914943653], "radius": 0.03709261653113803}, 
    {"position": [0.05935694825607751, 0.4899803599543281, 0.3465331321190194], "mass": 1.0, "velocity": [-0.8080840849132672, 
    -0.26282017467301055, -1.4490664522996894]}], "springs": [{"points": [0, 1], "stiffness": 84.83539792235159}, {"points": [1, 0], 
    "stiffness": 631.5892002736812}, {"points": [1, 0], "stiffness": 80.38461618788241}, {"points": [1, 0], 
    "stiffness": 508.20964373294566, "rest_length": 0.34764326501681525}, {"points": [1, 0], "stiffness": 243.70056822050134, 
    "rest_length": 0.4198859369028347}, {"points": [0, 1], "stiffness": 72.28823636687162}], "colliders": [{"type": "sphere", 
    "restitution": 0, "friction": 0, "center": [0.005759141692261181, -0.3185728511094316, 0.4334251499293591], 
    "radius": 0.1942835871502254, "oscillate": [-0.08264408891725279, 0.021367118848766353, 0], "frequency": 1.02003116618815}, 
    {"type": "plane", "restitution": 1, "friction": 0.7298609446276867, "point": [0, -0.38610651659326406, 0], 
    "normal": [0.19899676028902757, 1, 0]}], "contact": {"points": true, "springs": true, "faces": false, "thickness": 0.02, 
    "restitution": 0, "friction": 0.3}, "hand": {"point": 0, "circle": {"from": [0.40594502857541387, 0.08895224573616754, 0], 
    "center": [-0.03302799216923602, 0.5026299558189187, 0]}, "speed": 32.27609772087056, "seconds": 0.22124232955085332, 
    "begin": 0.19682020119908833}, "simulation": {"integrator": "symplectic_euler", "substeps": 8}})";
  const Outcome run = run_scene(scene, {"--seconds", "1", "--accuracy", "off"});
  EXPECT_EQ(run.code, 4) << run.err;
  EXPECT_NE(run.err.find("energy grew"), std::string::npos) << run.err;
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

// A ball of 1 kg falls by 1 m and comes to rest: 9.81 J, of which the method is to be blamed for nothing. Until it rests, the energy of
// Euler methods oscillates by m g h v / 2, 4e-2 J.
TEST(EnergyBalance, OfAFallOntoTheFloorIsTheLossOfContactWithEveryMethod) {
  const std::string scene = R"({"hooke": 1, "points": [{"position": [0, 1.02, 0], "radius": 0.02}],
    "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "restitution": 0.3}]})";
  for (const char* method : {"explicit_euler", "symplectic_euler", "velocity_verlet", "runge_kutta4", "xpbd", "implicit_euler",
                             "baraff_witkin", "implicit_midpoint", "tr_bdf2", "esdirk4", "dop853"}) {
    const Outcome run = run_scene(scene, {"--seconds", "3", "--sample", "3", "--integrator", method, "--substeps", "8", "--json", "-"});
    EXPECT_EQ(run.code, 0) << method << ": " << run.err;
    EXPECT_EQ(run.err.find("energy"), std::string::npos) << method << ": " << run.err;
    const rapidjson::Document json = parse_json(run.out);
    const auto& samples = json["samples"].GetArray();
    const auto& balance = samples[samples.Size() - 1]["energy_balance"];
    EXPECT_NEAR(balance["contact"].GetDouble(), -9.81, 3e-3) << method;
    EXPECT_NEAR(balance["method"].GetDouble(), 0.0, 3e-3) << method;
  }
}

// The hand swings a point around its nail by a meter in each of two steps per frame, by a spring that only the hand stretches.
TEST(EnergyBalance, OfAFastHandOnASpringToANailIsExact) {
  const std::string scene =
      R"({"hooke": 1, "gravity": [0, 0, 0], "points": [{"position": [0, 0, 0]}, {"position": [0, 0.1, 0], "nailed": true}],
    "springs": [{"points": [0, 1], "stiffness": 500, "rest_length": 0.5}],
    "hand": {"point": 0, "circle": {"from": [0, 0, 0], "center": [-0.3, 0, 0]}, "speed": 50, "seconds": 10}})";
  for (const char* method : {"velocity_verlet", "blanes_moan4", "implicit_euler"}) {
    const Outcome run = run_scene(scene, {"--seconds", "0.4", "--sample", "0.1", "--integrator", method, "--substeps", "2", "--json", "-"});
    EXPECT_EQ(run.err, "") << method;
    const rapidjson::Document json = parse_json(run.out);
    for (const auto& sample : json["samples"].GetArray()) EXPECT_NEAR(sample["energy_balance"]["method"].GetDouble(), 0.0, 1e-9) << method;
  }
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
