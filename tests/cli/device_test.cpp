// --device gpu, on whatever renderer this machine has.
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

const std::vector<std::string> run_cloth{"run", "cloth", "--integrator", "velocity_verlet_explicit", "--seconds", "0.2"};

Outcome run_with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return headless(words);
}

TEST(HeadlessDevice, NamesTheRenderer) {
  const Outcome version = headless({"--version"}), run = run_with(run_cloth, {"--device", "gpu", "--accuracy", "off"});
  EXPECT_EQ(run.code, 0) << run.err;
  const std::string renderer = lines_of(version.out).back().substr(5);
  EXPECT_NE(run.err.find("computed by " + renderer + "\n"), std::string::npos) << run.err;
  EXPECT_EQ(run_with(run_cloth, {"--device", "gpu", "--accuracy", "off", "--quiet"}).err, "");
}

TEST(HeadlessDevice, MeasuresTheErrorOfAFrame) {
  const auto error = [&](const char* device) {
    const Outcome outcome = run_with(run_cloth, {"--device", device, "--json", "-", "--quiet"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const rapidjson::Document result = parse_json(outcome.out);
    const auto& last = result["samples"][result["samples"].Size() - 1]["error"];
    EXPECT_TRUE(last["frame"].IsNumber() && last["accumulated"].IsNumber());
    return last["frame"].GetDouble();
  };
  const double expected = error("cpu");
  EXPECT_NEAR(error("gpu"), expected, 1e-3 * expected);
}

TEST(HeadlessDevice, IsRefusedByNameWithCodeTwo) {
  const auto refused = [](const Outcome& outcome, const std::string& part) {
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  };
  refused(run_with(run_cloth, {"--device", "tpu", "-q"}), "--device");
  refused(headless({"run", "cloth", "--integrator", "dop853", "--seconds", "1", "--device", "gpu", "-q"}),
          "--device gpu: not for the method dop853 (");
  refused(headless({"run", "newtons_cradle", "--seconds", "1", "--device", "gpu", "-q"}),
          "--device gpu: not for contact of points with each other");
  const Outcome old = run_process({"/usr/bin/env", "MESA_GL_VERSION_OVERRIDE=3.3", HOOKE_HEADLESS, "run", "two_masses", "--integrator",
                                   "symplectic_euler", "--seconds", "1", "--device", "gpu", "-q"});
  if (old.code != 0) refused(old, "no OpenGL 4.3");
}

TEST(HeadlessDevice, DrawsWhatItComputes) {
  const ScratchFolder scratch;
  const Outcome outcome = headless({"capture", "cloth", "--integrator", "velocity_verlet_explicit", "--seconds", "0.2", "--device", "gpu",
                                    "--out", scratch.folder / "cloth.png", "--size", "160x90"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(scratch.folder / "cloth.png"));
}

}  // namespace
}  // namespace hooke
