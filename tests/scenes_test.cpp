// The scenes that ship: they load, hold what they say, and run.

#include <gtest/gtest.h>

#include "lab/lab.h"
#include "lab/scene_file.h"

namespace hooke {
namespace {

Scene shipped(const std::string& id) { return load_scene(find_scene(id)).scene; }

TEST(ShippedScenes, LoadWithoutWarningsSaveTheUnstableOne) {
  for (const ShippedScene& scene : shipped_scenes()) {
    const LoadedScene loaded = load_scene(scene.file);
    EXPECT_EQ(loaded.scene.name, scene.title);
    EXPECT_FALSE(loaded.scene.description.empty()) << scene.id;
    EXPECT_EQ(loaded.warnings.size(), scene.id == "unstable" ? 1u : 0u)
        << scene.id << ": " << (loaded.warnings.empty() ? "" : loaded.warnings.front());
  }
}

TEST(ShippedScenes, RunForTwoSecondsAndOnlyTheUnstableOneDiverges) {
  for (const ShippedScene& scene : shipped_scenes()) {
    Lab lab(shipped(scene.id));
    bool sound = true;
    for (int frame = 0; frame < 120 && sound; ++frame) sound = lab.step();
    EXPECT_TRUE(sound || scene.id == "unstable") << scene.id;
    EXPECT_TRUE(is_finite(lab.scene().state)) << scene.id;
  }
}

TEST(ShippedScenes, TheUnstableOneDivergesWithinTenSeconds) {
  Lab lab(shipped("unstable"));
  int frame = 0;
  while (frame < 600 && lab.step()) ++frame;
  EXPECT_LT(frame, 600);
}

TEST(ShippedScenes, ComeBackFromASaveAsTheyWere) {
  for (const ShippedScene& scene : shipped_scenes()) {
    const Scene first = shipped(scene.id);
    const std::string text = format_scene(first);
    const Scene again = parse_scene(text, "again").scene;
    EXPECT_TRUE(again.system == first.system) << scene.id;
    EXPECT_TRUE(again.state == first.state) << scene.id;
    EXPECT_EQ(format_scene(again), text) << scene.id;
    EXPECT_EQ(text.find("\"generators\"") == std::string::npos, first.kept.generators.empty()) << scene.id;
  }
}

}  // namespace
}  // namespace hooke
