// Scene files of every version stay readable, and a file of a later version is refused with that version.
#include <gtest/gtest.h>

#include "base/file_limits.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

std::filesystem::path scene_of_version(int version) {
  return std::filesystem::path(DOCS_FOLDER) / "../tests/formats/versions" / ("scene_" + std::to_string(version) + ".json");
}

// These files are never changed, and a new version of the format adds one.
TEST(SceneVersions, AFileOfEachIsReadCompletely) {
  for (int version = 1; version <= newest_scene_version; ++version) {
    const LoadedScene loaded = load_scene(scene_of_version(version));
    // what it contains is known, but its method does not use the tolerance
    ASSERT_EQ(loaded.warnings.size(), 1U) << version;
    EXPECT_NE(loaded.warnings[0].find("simulation.tolerance: 1e-06: has no effect with implicit_euler"), std::string::npos)
        << loaded.warnings[0];
    EXPECT_EQ(loaded.scene.name, "Version " + std::to_string(version));
    EXPECT_GT(loaded.scene.system.point_count(), 0);
    EXPECT_TRUE(parse_scene(format_scene(loaded.scene), "again").scene.system == loaded.scene.system) << version;
  }
}

TEST(SceneVersions, ALaterOneIsReported) {
  try {
    parse_scene(R"({"hooke": 7})", "later.json");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "later.json: hooke: 7: must be at most 1: scenes of version 7 need a newer Hooke");
  }
}

}  // namespace
}  // namespace hooke
