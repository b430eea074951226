// What `run` and `capture` report about the accuracy.
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <cmath>

#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

TEST(AccuracyReports, EverySampleHasItsErrorsOrAReason) {
  const rapidjson::Document json = parse_json(run_headless("run cloth --seconds 1.2 --sample 0.4 --points 0 --json -").out);
  ASSERT_EQ(json["samples"].Size(), 4u);
  EXPECT_GT(json["accuracy_cpu_seconds"].GetDouble(), 0.0);
  for (rapidjson::SizeType i = 0; i < 4; ++i) {
    const auto& error = json["samples"][i]["error"];
    const std::string reason = error["reason"].IsNull() ? "" : error["reason"].GetString();
    for (const char* key : {"frame", "frame_max", "accumulated", "amplification", "growth_rate", "predictable_seconds"}) {
      if (error[key].IsNull())
        EXPECT_NE(reason.find(std::string(key) + ": "), std::string::npos) << key << " is null at sample " << i << ": " << reason;
      else
        EXPECT_GE(error[key].GetDouble(), 0.0);
    }
    EXPECT_EQ(error["frame"].IsNull(), i == 0);
  }
  const auto& last = json["samples"][3];
  EXPECT_GT(last["error"]["amplification"].GetDouble(), 0.0);
  const auto& balance = last["energy_balance"];
  double sum = 0.0;
  for (const char* key : {"hand", "edits", "forces", "colliders", "limits", "drag", "dashpots", "contact", "method"})
    sum += balance[key].GetDouble();
  const double change = json["samples"][3]["energy"]["total"].GetDouble() - json["samples"][0]["energy"]["total"].GetDouble();
  EXPECT_NEAR(balance["change"].GetDouble(), change, 1e-9);
  EXPECT_NEAR(sum, change, 1e-9);
}

TEST(AccuracyReports, WhatIsNotMeasuredHasAReason) {
  const rapidjson::Document off = parse_json(run_headless("run cloth --seconds 0.1 --points 0 --json - --accuracy off").out);
  EXPECT_TRUE(off["samples"][0]["error"]["frame"].IsNull());
  EXPECT_NE(std::string(off["samples"][0]["error"]["reason"].GetString()).find("switched off"), std::string::npos);
  EXPECT_TRUE(off["samples"][0]["energy_balance"].IsNull());
  EXPECT_NE(std::string(off["samples"][0]["error"]["reason"].GetString()).find("energy_balance: switched off"), std::string::npos);
  EXPECT_EQ(off["accuracy_cpu_seconds"].GetDouble(), 0.0);
  const rapidjson::Document frame = parse_json(run_headless("run cloth --seconds 0.1 --points 0 --json - --accuracy frame").out);
  EXPECT_GE(frame["samples"][0]["error"]["frame"].GetDouble(), 0.0);
  EXPECT_TRUE(frame["samples"][0]["error"]["accumulated"].IsNull());
  EXPECT_STREQ(off["hash"].GetString(), frame["hash"].GetString());
  EXPECT_EQ(run_headless("run cloth --seconds 0.1 --accuracy some").code, 2);
}

TEST(AccuracyReports, TheSummaryOfARunEndsWithItsError) {
  const auto last_line = [](const std::string& arguments) { return lines_of(run_headless(arguments).out).back(); };
  const std::string plain = last_line("run two_masses --seconds 1.2"), full = last_line("run two_masses --seconds 1.2 --accuracy full");
  EXPECT_EQ(plain.find("error of a frame at t = "), 0u) << plain;
  EXPECT_NE(plain.find(" % of the size); accumulated, predictability: not measured without --accuracy full"), std::string::npos) << plain;
  EXPECT_EQ(full.find("error of a frame at t = "), 0u) << full;
  EXPECT_NE(full.find("; accumulated: "), std::string::npos) << full;
  EXPECT_NE(full.find("predictable"), std::string::npos) << full;
  EXPECT_EQ(last_line("run two_masses --seconds 1.2 --accuracy off"),
            "error of a frame, accumulated, predictability: not measured with --accuracy off");
}

TEST(AccuracyReports, ColumnsOfCsvAreEmptyWhereNothingIsKnown) {
  const auto lines =
      lines_of(run_headless("run cloth --seconds 0.2 --sample 0.1 --csv - --quantities time,error,accumulated_error,energy_method").out);
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "time [s],error [m],accumulated_error [m],energy_method [J]");
  EXPECT_EQ(lines[1].substr(0, 4), "0,,,");
  EXPECT_EQ(lines[2].find(",,"), std::string::npos) << lines[2];
}

TEST(AccuracyReports, CaptureWritesTheAccuracyOfEveryPicture) {
  const ScratchFolder scratch;
  const std::string common = "capture cloth --out frames --seconds 0.2 --fps 10 --size 160x90 --report report --quiet";
  EXPECT_EQ(run_headless(common, scratch.folder).code, 0);
  const auto lines = lines_of(contents(scratch.folder / "report/report.csv"));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_TRUE(lines[0].starts_with("file,time [s],")) << lines[0];
  EXPECT_TRUE(lines[0].ends_with(",hash")) << lines[0];
  EXPECT_TRUE(lines[3].starts_with("frame_00002.png,0.2")) << lines[3];
  const rapidjson::Document json = parse_json(contents(scratch.folder / "report/report.json"));
  ASSERT_EQ(json["frames"].Size(), 3u);
  EXPECT_GT(json["frames"][2]["error"]["frame"].GetDouble(), 0.0);
  EXPECT_GT(json["frames"][2]["half_error"]["cost"].GetDouble(), 1.0);
  EXPECT_TRUE(json["frames"][0]["half_error"]["cost"].IsNull());
  EXPECT_STREQ(json["frames"][0]["half_error"]["reason"].GetString(), "no frame yet");
  const std::string hash = json["frames"][2]["hash"].GetString();
  EXPECT_TRUE(lines[3].ends_with(hash));
  const rapidjson::Document run = parse_json(run_headless("run cloth --seconds 0.2 --points 0 --json - --accuracy full").out);
  EXPECT_EQ(hash, run["hash"].GetString());
  EXPECT_EQ(json["frames"][2]["error"]["accumulated"].GetDouble(), run["samples"][0]["error"]["accumulated"].GetDouble());
}

TEST(AccuracyReports, FailAboveNamesTheFirstFrameAndExitsWithOne) {
  const ScratchFolder scratch;
  const Outcome failed = run_headless("capture cloth --out a.png --seconds 0.2 --size 80x60 --fail-above 1e-15 --quiet", scratch.folder);
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(failed.err.starts_with("frame ")) << failed.err;
  EXPECT_NE(failed.err.find("m, limit 1e-15 m"), std::string::npos) << failed.err;
  EXPECT_EQ(run_headless("capture cloth --out a.png --seconds 0.2 --size 80x60 --fail-above 1 --quiet", scratch.folder).code, 0);
  EXPECT_EQ(run_headless("capture cloth --out a.png --fail-above 0", scratch.folder).code, 2);
}

// Stretched to 14 times its length, the first spring passes through zero length 17 times a frame, by 2 cm in a step. 1500 and 3000 substeps
// happen to lead to nearly the same positions, more than 100 mm from those of 24,000.
TEST(AccuracyReports, ClaimNoErrorWhereStepsDoNotResolveAPassThroughZeroLength) {
  const ScratchFolder scratch;
  const std::string scene =
      write_file(scratch.folder / "scene.json",
                 R"({"hooke": 1, "dimensions": 2, "points": [{"position": [0.26312256128472705, 0.38784996127584287, 0], "mass":
    0.06841094832257809, "velocity": [-0.20970661679889532, -0.014855617414772437, 0], "radius":
    0.015356878759650344}, {"position": [-0.30755216912629113, 0.3514501344534309, 0], "nailed": true, "radius":
    0.013344240762579805}, {"position": [-0.11539614044797525, -0.849606042002724, 0], "mass":
    0.06841094832257809, "velocity": [-3.1014860317252912, 2.109022628295563, 0], "radius": 0.022515899565743933},
    {"position": [-0.2835795892938302, 0.5179500229084211, 0], "mass": 5.907771271326557e-05}], "springs":
    [{"points": [0, 1], "stiffness": 215980.3144564464, "damping": 0.007455247294453734, "rest_length":
    0.04103414898278937}, {"points": [1, 2], "stiffness": 8.865624850966144, "damping": 45.500890930318846},
    {"points": [2, 3], "stiffness": 439.2610482383349}], "drag": 0.017488412092486947, "simulation":
    {"frame_rate": 30}})");
  const auto run = [&](const char* substeps) {
    return headless(
        {"run", scene, "--seconds", "0.5", "--sample", "0.5", "--integrator", "velocity_verlet", "--substeps", substeps, "--json", "-"});
  };
  const Outcome coarse = run("1500"), fine = run("24000");
  EXPECT_NE(coarse.err.find("accumulated error not known: springs pass through zero length faster than the steps resolve"),
            std::string::npos)
      << coarse.err;
  EXPECT_TRUE(parse_json(coarse.out)["samples"][1]["error"]["accumulated"].IsNull());
  EXPECT_EQ(fine.err, "");
  EXPECT_LT(parse_json(fine.out)["samples"][1]["error"]["accumulated"].GetDouble(), 0.02);
}

TEST(AccuracyReports, TheStampChangesACornerOfThePicture) {
  const ScratchFolder scratch;
  EXPECT_EQ(run_headless("capture cloth --out plain.png --seconds 0.1 --size 640x360 --quiet", scratch.folder).code, 0);
  EXPECT_EQ(run_headless("capture cloth --out stamped.png --seconds 0.1 --size 640x360 --stamp --quiet", scratch.folder).code, 0);
  EXPECT_NE(contents(scratch.folder / "plain.png"), contents(scratch.folder / "stamped.png"));
}

}  // namespace
}  // namespace hooke
