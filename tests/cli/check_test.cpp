// `hooke check` as used by scripts.

#include <gtest/gtest.h>
#include <rapidjson/document.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <thread>

#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Outcome check(std::vector<std::string> words) {
  words.insert(words.begin(), {HOOKE_HEADLESS, "check"});
  return run_process(words);
}

TEST(Check, TheQuickHardCasesGiveTheExpectedResults) {
  const Outcome outcome = check({"--hard", "--quick"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("none unexpected"), std::string::npos);
  std::istringstream lines(outcome.out);
  int cases = 0;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    cases += line.size() > 32 && (line[1] >= '0' && line[1] <= '9') ? 1 : 0;
  }
  // all but the methods that take more than a few seconds per case
  EXPECT_GE(cases, 20);
}

TEST(Check, AnUnexpectedFailureIsCodeOne) {
  // a reported failure is accepted, except with --strict
  EXPECT_EQ(check({"--hard", "--cases", "9", "--methods", "implicit_euler", "--quiet"}).code, 0);
  const Outcome outcome = check({"--hard", "--cases", "9", "--methods", "implicit_euler", "--strict"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.out.find("! 9 Resonance, implicit_euler: failed openly, expected to hold"), std::string::npos) << outcome.out;
}

// An installation that has lost its scenes has nothing to check.
TEST(Check, WithoutShippedScenesFails) {
  const ScratchFolder scratch;
  const std::filesystem::path program = scratch.folder / "bin/hooke-headless";
  std::filesystem::create_directories(program.parent_path());
  std::filesystem::create_directories(scratch.folder / "share/hooke/scenes");
  std::filesystem::copy_file(HOOKE_HEADLESS, program);
  const Outcome outcome = run_process({program.string(), "check"});
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find("scenes: no scenes found"), std::string::npos) << outcome.err;
}

TEST(Check, CasesAndMethodsCanBeChosenAndWrittenAsJson) {
  const Outcome outcome = check({"--hard", "--cases", "20,5", "--methods", "xpbd,velocity_verlet", "--json", "-"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "");
  rapidjson::Document document;
  document.Parse(outcome.out.c_str());
  ASSERT_FALSE(document.HasParseError()) << outcome.out;
  ASSERT_EQ(document["cases"].Size(), 2u);
  EXPECT_EQ(document["cases"][0]["number"].GetInt(), 5);
  ASSERT_EQ(document["cases"][1]["results"].Size(), 2u);
  EXPECT_STREQ(document["cases"][1]["results"][0]["method"].GetString(), "velocity_verlet");
}

// Where its tolerance allows more than the criterion, it says how large its errors are: cases 5 and 9 once failed in silence.
TEST(Check, AutoHoldsOrReportsInTheCasesOfHarmonicMotionAndResonance) {
  const Outcome outcome = check({"--hard", "--cases", "5,9", "--methods", "auto"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("none unexpected"), std::string::npos) << outcome.out;
}

// A mouse at 50 m/s: the peak strain is bounded, and the energy does not rise after the release.
TEST(Check, TheDefaultMethodIsAccurateUnderAFastMouse) {
  const Outcome outcome = check({"fast_mouse"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("passed  fast_mouse, velocity_verlet"), std::string::npos) << outcome.out;
}

TEST(Check, WrongUsageIsCodeTwo) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--hard", "--cases", "36"},
                                                {"--hard", "--cases", "0"},
                                                {"--hard", "--methods", "magic"},
                                                {"--quick"},
                                                {"--hard", "two_masses"},
                                                {"--hard", "--threads", "0"},
                                                {"--hard", "--quick", "--cases", "30"},
                                                {"--hard", "--cases", "14"}}) {
    const Outcome outcome = check(words);
    EXPECT_EQ(outcome.code, 2) << words.back();
    EXPECT_EQ(outcome.out, "") << words.back();
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

// What `check` prints that is interrupted after this time. Case 19 takes half a minute, the other almost no time.
std::string interrupted_after(std::chrono::milliseconds time) {
  int out[2];
  if (pipe(out) != 0) return "no pipe";
  const pid_t child = start_process(
      {HOOKE_HEADLESS, "check", "--hard", "--cases", "19,20", "--methods", "velocity_verlet", "--threads", "2"}, out[1], STDERR_FILENO);
  close(out[1]);
  std::this_thread::sleep_for(time);
  kill(child, SIGINT);
  std::string text(1 << 16, '\0');
  std::size_t size = 0;
  for (ssize_t count = 0; (count = read(out[0], text.data() + size, text.size() - size)) > 0;) size += static_cast<std::size_t>(count);
  close(out[0]);
  EXPECT_EQ(wait_for(child), 130);
  text.resize(size);
  return text;
}

TEST(Check, CtrlCPrintsFinishedResults) {
  std::string text;
  // later on a machine that has finished nothing by then
  for (const int ms : {500, 4000, 16'000}) {
    text = interrupted_after(std::chrono::milliseconds(ms));
    if (text.find("1 not run") != std::string::npos) break;
  }
  EXPECT_NE(text.find("20 High-speed impact"), std::string::npos) << text;
  EXPECT_NE(text.find("1 not run"), std::string::npos) << text;
}

// The test scene_checks runs all of them.
TEST(Check, ASceneMeetsItsOwnChecksUnderEveryMethodItLists) {
  const Outcome outcome = check({"two_masses"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_EQ(outcome.out.find("FAILED"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("passed  two_masses, tr_bdf2: "), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace hooke
