// How meshes are read by the subcommands, and what they say about them.
#include <gtest/gtest.h>

#include <fstream>

#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

std::string write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file.string();
}

constexpr const char* millimeters = "v 0 0 0\nv 1000 0 0\nv 0 0 500\nf 1 2 3\n";

TEST(ImportOptions, AreThoseOfEverySubcommandThatReadsAMesh) {
  const ScratchFolder scratch;
  const std::string mesh = write_file(scratch.folder / "sheet.obj", millimeters), out = (scratch.folder / "out.json").string();
  const Outcome run = headless({"run", mesh, "--seconds", "0.02", "--scale", "0.001", "--up", "z"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find(mesh + ": 1 x 0.5 x 0 m, 3 points\n"), std::string::npos) << run.err;

  const Outcome converted = headless({"convert", mesh, out, "--mesh-scale", "0.001", "--mesh-up", "z", "--weld", "0"});
  EXPECT_EQ(converted.code, 0) << converted.err;
  EXPECT_EQ(converted.err, mesh + ": 1 x 0.5 x 0 m, 3 points\n");
  EXPECT_NE(contents(out).find("[0, 0.5, "), std::string::npos) << contents(out);
  EXPECT_EQ(headless({"convert", mesh, out, "-q"}).err, "");
  EXPECT_NE(headless({"convert", mesh, out}).err.find("millimeters? (--scale 0.001)"), std::string::npos);
  EXPECT_NE(headless({"capture", "--help"}).out.find("--mesh-scale"), std::string::npos);
}

TEST(ImportOptions, AreRefusedWithTheirNames) {
  const ScratchFolder scratch;
  const std::string mesh = write_file(scratch.folder / "sheet.obj", millimeters);
  const auto refusal = [](const std::vector<std::string>& words) {
    const Outcome outcome = headless(words);
    EXPECT_NE(outcome.code, 0);
    return outcome.err;
  };
  EXPECT_NE(refusal({"run", mesh, "--scale", "-1"}).find("--scale -1: must be more than 0"), std::string::npos);
  EXPECT_NE(refusal({"run", mesh, "--up", "x"}).find("--up x: must be y or z"), std::string::npos);
  EXPECT_NE(refusal({"run", mesh, "--weld", "much"}).find("--weld much: "), std::string::npos);
  EXPECT_NE(refusal({"run", "cloth", "--seconds", "1", "--weld", "1"}).find("weld, scale and up: only of a mesh"), std::string::npos);
  EXPECT_NE(
      refusal({"run", write_file(scratch.folder / "a.stl", "solid a\n"), "--seconds", "1"}).find(".stl: must be .json, .obj, .xsp or .xml"),
      std::string::npos);
}

TEST(Run, APointCacheFarFromTheOriginWarnsOfItsPrecision) {
  const ScratchFolder scratch;
  const std::string mesh = write_file(scratch.folder / "sheet.obj", "v 0 9000 0\nv 1 9000 0\nv 0 9000 1\nf 1 2 3\n");
  const std::string cache = (scratch.folder / "sheet.pc2").string();
  EXPECT_NE(headless({"run", mesh, "--seconds", "0", "--pc2", cache}).err.find("warning: point cache: positions are rounded by up to"),
            std::string::npos);
  EXPECT_EQ(headless({"run", "cloth", "--seconds", "0", "--pc2", cache}).err.find("point cache"), std::string::npos);
}

}  // namespace
}  // namespace hooke
