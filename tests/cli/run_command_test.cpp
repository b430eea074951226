// hooke-headless run: the fields of its JSON and CSV, options, the summary and warnings.

#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "sim/model/hash.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

TEST(Headless, RunWritesEveryFieldOfItsJson) {
  const ScratchFolder scratch;
  const std::string scene = write_file(scratch.folder / "free.json", free_point);
  const Outcome outcome = headless({"run", scene, "--seconds", "1", "--sample", "0.25", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const rapidjson::Document json = parse_json(outcome.out);
  EXPECT_EQ(json.MemberCount(), 20u);
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
    EXPECT_EQ(sample.MemberCount(), 7u);
    EXPECT_TRUE(sample.HasMember("half_error"));
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
  const rapidjson::Document json = parse_json(headless({"run", "two_masses", "--seconds", "0.5", "--points", "1", "--json", "-"}).out);
  ASSERT_EQ(json["samples"].Size(), 1u);
  EXPECT_NEAR(json["samples"][0]["time"].GetDouble(), 0.5, 1e-12);
  EXPECT_EQ(json["samples"][0]["positions"].Size(), 1u);
}

TEST(Headless, RunStepsWholeFramesUntilTheSecondsAreCovered) {
  const auto seconds_of = [](const std::string& seconds) {
    return parse_json(headless({"run", "two_masses", "--seconds", seconds, "--frame-rate", "10", "--json", "-"}).out)["seconds"]
        .GetDouble();
  };
  EXPECT_EQ(seconds_of("0"), 0.0);
  EXPECT_NEAR(seconds_of("0.3"), 0.3, 1e-12);
  EXPECT_NEAR(seconds_of("0.31"), 0.4, 1e-12);
  EXPECT_NEAR(seconds_of("1e-300"), 0.1, 1e-12);
}

TEST(Headless, ReportsTheHashThatALaboratoryComputes) {
  Lab lab(load_scene(find_scene("two_masses_bouncy")).scene);
  for (int frame = 0; frame < 60; ++frame) ASSERT_TRUE(lab.step());
  const rapidjson::Document json = parse_json(headless({"run", "two_masses_bouncy", "--seconds", "1", "--json", "-"}).out);
  for (rapidjson::SizeType c = 0; c < 3; ++c) {
    EXPECT_EQ(json["samples"][0]["positions"][1][c].GetDouble(), lab.scene().state.position[1][static_cast<int>(c)]);
    EXPECT_EQ(json["samples"][0]["velocities"][1][c].GetDouble(), lab.scene().state.velocity[1][static_cast<int>(c)]);
  }
  EXPECT_EQ(std::stoull(json["hash"].GetString(), nullptr, 16), hash_state(lab.scene().state));
}

TEST(Headless, EqualRunsHaveEqualHashesAndDifferentRunsDifferentOnes) {
  const auto hash_of = [](const char* substeps) {
    return std::string(
        parse_json(headless({"run", "rope", "--seconds", "0.1", "--substeps", substeps, "--points", "0", "--json", "-"}).out)["hash"]
            .GetString());
  };
  EXPECT_EQ(hash_of("40"), hash_of("40"));
  EXPECT_NE(hash_of("40"), hash_of("41"));
}

TEST(Headless, OptionsOverrideTheScene) {
  const rapidjson::Document json =
      parse_json(headless({"run", "rope", "--seconds", "0.1", "--integrator", "runge_kutta4", "--substeps", "7", "--frame-rate", "120",
                           "--set", "gravity=0", "--set", "damped_springs=off", "--points", "47", "--json", "-", "-q"})
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
  EXPECT_NE(refused.err.find("--quantities y2: must be y0 to y1\n"), std::string::npos) << refused.err;
  const Outcome unknown = headless({"run", "two_masses", "--seconds", "0", "--csv", file, "--quantities", "time,speed"});
  EXPECT_NE(unknown.err.find("--quantities speed: must be one of time, kinetic"), std::string::npos) << unknown.err;
  const Outcome spring = headless({"run", "two_masses", "--seconds", "0", "--csv", file, "--quantities", "strain7"});
  EXPECT_NE(spring.err.find("--quantities strain7: must be strain0\n"), std::string::npos) << spring.err;
}

TEST(Headless, SubstepsAreSaidToBeUnusedByAuto) {
  const Outcome both = headless({"run", "two_masses", "--seconds", "0.1", "--tolerance", "1e-3", "--substeps", "7"});
  EXPECT_EQ(both.code, 0);
  EXPECT_NE(both.err.find("warning: substeps: 7: not used: auto chooses the substeps\n"), std::string::npos) << both.err;
  const Outcome named =
      headless({"run", "two_masses", "--seconds", "0.1", "--integrator", "dop853", "--tolerance", "1e-3", "--substeps", "7"});
  EXPECT_EQ(named.err.find("not used"), std::string::npos) << named.err;
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
  EXPECT_EQ(loud.err.find("warning: simulation.substeps: 1: may be too few for velocity_verlet_explicit here: "), 0u) << loud.err;
  EXPECT_EQ(loud.out.front(), '{');
  std::vector<std::string> quiet = words;
  quiet.emplace_back("--quiet");
  EXPECT_EQ(headless(quiet).err, "");
}

// A square filled with gas, of which one side is weak.
TEST(Headless, TearsThatReleaseGasAreReported) {
  const ScratchFolder scratch;
  const std::string scene = write_file(scratch.folder / "weak.json", R"({"hooke": 1, "dimensions": 2, "gravity": [0, 0, 0],
    "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [1, 1, 0]}, {"position": [0, 1, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 50, "break_strain": 0.05}, {"points": [1, 2], "stiffness": 50},
      {"points": [2, 3], "stiffness": 50}, {"points": [3, 0], "stiffness": 50}],
    "forces": [{"type": "pressure", "pressure": 20}], "simulation": {"substeps": 10}})");
  const Outcome outcome = headless({"run", scene, "--seconds", "1", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const rapidjson::Document json = parse_json(outcome.out);
  ASSERT_TRUE(json.HasMember("gas_releases"));
  ASSERT_EQ(json["gas_releases"].Size(), 1u);
  EXPECT_GT(json["gas_releases"][0].GetDouble(), 0.05);
  EXPECT_LT(json["gas_releases"][0].GetDouble(), 0.5);
  EXPECT_EQ(outcome.err.find("warning: tears released the gas of 1 surface, from 0."), 0u) << outcome.err;
}

TEST(Headless, OnlyTheSelectedMethodAndStepAreWarnedAbout) {
  EXPECT_EQ(headless({"run", "unstable", "--seconds", "0", "--integrator", "symplectic_euler", "--json", "-"}).err, "");
}

// 50 points in one place that fall into a center for 35 s: copies of the whole run take much of the work limit of the search.
TEST(Headless, ARunThatDivergesLateIsExplained) {
  const ScratchFolder scratch;
  std::string points;
  for (int i = 0; i < 50; ++i) points += std::string(i == 0 ? "" : ", ") + R"({"position": [10, 0, 0], "mass": 1})";
  const std::string scene = write_file(scratch.folder / "late.json", R"({"hooke": 1, "gravity": [0, 0, 0],
    "points": [)" + points + R"(], "forces": [{"type": "center", "strength": 1, "power": 2, "core": 1e-6}],
    "simulation": {"integrator": "tr_bdf2", "substeps": 20}})");
  const Outcome outcome = headless({"run", scene, "--seconds", "60", "--accuracy", "off"});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(outcome.err.find("do not diverge"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(" does not diverge (tested for "), std::string::npos) << outcome.err;
}

// A spring of which implicit Euler dissipates the vibration.
TEST(Headless, RunWarnsOfAnAccumulatedErrorThatIsLargeInComparisonWithTheMotion) {
  const ScratchFolder scratch;
  const std::string scene = write_file(scratch.folder / "scene.json", R"({"hooke": 1, "gravity": [0, 0, 0],
    "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [1.5, 0, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 100, "rest_length": 1}]})");
  const auto err_of = [&](std::vector<std::string> options) {
    std::vector<std::string> words{"run", scene, "--seconds", "0.4", "--substeps", "1", "--json", "/dev/null"};
    words.insert(words.end(), options.begin(), options.end());
    return headless(words).err;
  };
  const std::string warning = "warning: accumulated error of about ";
  EXPECT_NE(err_of({"--integrator", "implicit_euler"}).find(warning), std::string::npos);
  EXPECT_EQ(err_of({"--integrator", "implicit_euler", "--accuracy", "off"}).find(warning), std::string::npos);
  EXPECT_EQ(err_of({"--integrator", "implicit_euler", "--quiet"}), "");
  EXPECT_EQ(err_of({"--integrator", "runge_kutta4"}), "");
}

// A hand pulls the corner of a triangle through a nailed one, and out of it again.
TEST(Headless, RunWarnsOfWhatHeldPointsForceThroughFaces) {
  const ScratchFolder scratch;
  const std::string scene = write_file(scratch.folder / "scene.json", R"({"hooke": 1, "gravity": [0, 0, 0], "contact": {"faces": true},
    "points": [{"position": [-1, 0, -1], "nailed": true}, {"position": [1, 0, -1], "nailed": true}, {"position": [0, 0, 1], "nailed": true},
               {"position": [0, 0.2, 0]}, {"position": [0.3, 0.4, 0]}, {"position": [-0.3, 0.4, 0]}],
    "springs": [{"points": [3, 4], "stiffness": 100}, {"points": [4, 5], "stiffness": 100}, {"points": [5, 3], "stiffness": 100}],
    "faces": [[0, 1, 2], [3, 4, 5]],
    "hand": {"point": 3, "circle": {"from": [0, 0.2, 0], "center": [0, 0, 0], "axis": [0, 0, 1]}, "speed": 1, "seconds": 0.6}})");
  EXPECT_NE(headless({"run", scene, "--seconds", "0.8"}).err.find("up to 2 edges pass through faces or springs, from 0."),
            std::string::npos);
  EXPECT_EQ(headless({"run", scene, "--seconds", "0.2"}).err.find("through"), std::string::npos);
}

}  // namespace
}  // namespace hooke
