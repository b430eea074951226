// Parts that are added to a scene.
#include "edit/append_parts.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "formats/scene_file.h"

namespace hooke {
namespace {

constexpr const char* cloth =
    R"("generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [4, 3],
  "mass": 0.2, "stiffness": 100, "nail": ["top"]}])";
constexpr const char* rope =
    R"("generators": [{"type": "rope", "from": [0, 1, 0], "to": [1, 1, 0], "points": 5, "mass": 0.1, "stiffness": 10}])";
constexpr const char* ball = R"("colliders": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.3}])";

Scene scene_of(const std::string& members, int dimensions = 3) {
  return parse_scene(R"({"hooke": 1, "dimensions": )" + std::to_string(dimensions) + (members.empty() ? "" : ", ") + members + "}", "test")
      .scene;
}

TEST(AppendParts, GivesTheSceneOfAFileWithBothParts) {
  Scene built = scene_of("");
  append_parts(built, scene_of(cloth));
  append_parts(built, scene_of(rope));
  append_parts(built, scene_of(ball));
  const std::string cloth_list = cloth, rope_list = rope;
  const Scene read = scene_of(cloth_list.substr(0, cloth_list.size() - 1) + ", " + rope_list.substr(rope_list.find('[') + 1) + ", " + ball);

  EXPECT_EQ(built.system, read.system);
  EXPECT_EQ(built.state.position, read.state.position);
  EXPECT_EQ(format_scene(built), format_scene(read)) << "generators stay generators";
  ASSERT_TRUE(built.sheet);
  EXPECT_EQ(built.sheet->area_of(built.system.points()[5].id), read.sheet->area_of(read.system.points()[5].id));
}

TEST(AppendParts, KeepsPointsThatWereThereBefore) {
  Scene built =
      scene_of(R"("points": [{"position": [5, 5, 5]}, {"position": [6, 5, 5]}], "springs": [{"points": [0, 1], "stiffness": 3}])");
  append_parts(built, scene_of(cloth));
  EXPECT_EQ(built.system.point_count(), 14);
  EXPECT_EQ(built.state.position[0], Vec3(5.0, 5.0, 5.0));
  const Scene again = parse_scene(format_scene(built), "test").scene;
  EXPECT_EQ(again.state.position, built.state.position);
  EXPECT_EQ(again.system.springs().size(), built.system.springs().size());
}

TEST(AppendParts, RefusesPartsInSpaceForAFlatScene) {
  Scene flat = scene_of("", 2);
  EXPECT_THROW(append_parts(flat, scene_of(cloth)), InputError);
  append_parts(flat, scene_of(rope, 2));
  EXPECT_EQ(flat.system.point_count(), 5);
}

}  // namespace
}  // namespace hooke
