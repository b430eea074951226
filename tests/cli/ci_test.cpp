// What a job of a CI system uses: limits of the error, results that it shows, pictures of one capture only.

#include <gtest/gtest.h>

#include "base/build_info.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

TEST(ContinuousIntegration, ARunFailsAboveALimitOfTheError) {
  const Outcome failed = run_headless("run cloth --seconds 0.2 --fail-above 1e-15 -q");
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(failed.err.starts_with("frame 1, at 0.01667 s: estimated error ")) << failed.err;
  EXPECT_EQ(run_headless("run cloth --seconds 0.2 --fail-above 1 -q").code, 0);
  EXPECT_EQ(run_headless("run cloth --seconds 0.2 --fail-above 0 -q").code, 2);
}

TEST(ContinuousIntegration, ARunStatesItsVersionAndItsParameters) {
  const rapidjson::Document json =
      parse_json(run_headless("run two_masses --seconds 0.1 --set stiffness=200 --set drag=0.5 --json - -q").out);
  EXPECT_STREQ(json["version"].GetString(), program_version);
  EXPECT_EQ(json["parameters"]["stiffness"].GetDouble(), 200.0);
  EXPECT_EQ(json["parameters"]["drag"].GetDouble(), 0.5);
  EXPECT_STREQ(json["precision"].GetString(), "double");
  EXPECT_STREQ(json["device"].GetString(), "cpu");
  EXPECT_FALSE(json["interrupted"].GetBool());

  // also what the method does not use, and what exceeds the range of the slider
  const rapidjson::Document single = parse_json(
      run_headless(
          "run drum_32 --seconds 0.05 --precision single --set damped_springs=off --set substeps=2000 --set iterations=300 --json - -q")
          .out);
  EXPECT_STREQ(single["precision"].GetString(), "single");
  EXPECT_EQ(single["substeps"].GetInt(), 2000);
  EXPECT_EQ(single["parameters"]["iterations"].GetInt(), 300);
}

TEST(ContinuousIntegration, ChecksAreWrittenAsJsonAndAsJunit) {
  const ScratchFolder scratch;
  const Outcome outcome = run_headless("check two_masses --json - --junit junit.xml", scratch.folder);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const rapidjson::Document json = parse_json(outcome.out);
  EXPECT_EQ(json["failed"].GetInt(), 0);
  ASSERT_GT(json["checks"].Size(), 1u);
  EXPECT_STREQ(json["checks"][0]["scene"].GetString(), "two_masses");
  EXPECT_TRUE(json["checks"][0]["passed"].GetBool());
  const std::string junit = contents(scratch.folder / "junit.xml");
  EXPECT_NE(junit.find("<testsuite name=\"hooke check\" tests=\"" + std::to_string(json["checks"].Size()) + "\" failures=\"0\">"),
            std::string::npos)
      << junit;
  EXPECT_NE(junit.find("<testcase classname=\"two_masses\" name=\"tr_bdf2\"/>"), std::string::npos) << junit;
}

TEST(ContinuousIntegration, AFailedCheckIsAFailureWithItsFigures) {
  const ScratchFolder scratch;
  EXPECT_EQ(run_headless("convert two_masses scene.json", scratch.folder).code, 0);
  std::string text = contents(scratch.folder / "scene.json");
  const std::size_t at = text.find("0.45");
  ASSERT_NE(at, std::string::npos);
  write_file(scratch.folder / "bad.json", text.replace(at, 4, "0.84"));
  const Outcome outcome = run_headless("check bad.json --junit - -q", scratch.folder);
  EXPECT_EQ(outcome.code, 1) << outcome.out;
  EXPECT_NE(outcome.out.find("<failure message=\""), std::string::npos) << outcome.out;
}

TEST(ContinuousIntegration, ASecondCaptureLeavesNoPicturesOfTheFirst) {
  const ScratchFolder scratch;
  EXPECT_EQ(run_headless("capture two_masses --out frames --frames 4 --size 64x36 -q", scratch.folder).code, 0);
  write_file(scratch.folder / "frames" / "frame_notes.png", "mine");
  EXPECT_EQ(run_headless("capture two_masses --out frames --frames 2 --size 64x36 -q", scratch.folder).code, 0);
  EXPECT_TRUE(fs::exists(scratch.folder / "frames" / "frame_00001.png"));
  EXPECT_FALSE(fs::exists(scratch.folder / "frames" / "frame_00002.png"));
  EXPECT_TRUE(fs::exists(scratch.folder / "frames" / "frame_notes.png"));
}

TEST(ContinuousIntegration, TheErrorLimitNamesThePictureThatShowsIt) {
  const ScratchFolder scratch;
  const Outcome outcome =
      run_headless("capture cloth --out frames --seconds 0.2 --fps 10 --size 64x36 --fail-above 1e-15 -q", scratch.folder);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(outcome.err.starts_with("before frame_00001.png, at 0.01667 s: ")) << outcome.err;
}

}  // namespace
}  // namespace hooke
