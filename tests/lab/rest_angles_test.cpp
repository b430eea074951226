// The angles between faces as built, in scene files and recordings.
#include <gtest/gtest.h>

#include <cmath>

#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "sim/forces/terms/rows.h"
#include "support/parse_text.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

// Two faces, of which one is folded up by a right angle.
constexpr const char* corner = R"({"hooke": 1, "gravity": [0, 0, 0],
  "points": [{"position": [0, 0, 0]}, {"position": [0, 0, 1]}, {"position": [-1, 0, 0]}, {"position": [0, 1, 0]}],
  "springs": [{"points": [0, 1], "stiffness": 100}, {"points": [0, 2], "stiffness": 100}, {"points": [1, 2], "stiffness": 100},
              {"points": [0, 3], "stiffness": 100}, {"points": [1, 3], "stiffness": 100}],
  "faces": [[2, 0, 1], [3, 1, 0]], "forces": [{"type": "bending", "stiffness": 0.01, "rest": "as_built"}]})";

TEST(RestAngles, AreThoseDrawn) {
  const Scene scene = parse(corner);
  EXPECT_EQ(scene.system.forces[0].values[2], 1.0);
  EXPECT_NEAR(std::abs(scene.system.faces[0].rest_angle[0]), std::acos(0.0), 1e-15);
  EXPECT_EQ(scene.system.faces[0].rest_angle[0], scene.system.faces[1].rest_angle[0]);
  EXPECT_EQ(scene.system.faces[0].rest_angle[1], 0.0);
}

TEST(RestAngles, AreWrittenOnlyIfThePositionsAreOthers) {
  Scene scene = parse(corner);
  EXPECT_EQ(format_scene(scene).find("rest_angles"), std::string::npos);
  scene.state.position[3] = Vec3(0.3, 0.9, 0.0);
  const std::string text = format_scene(scene);
  EXPECT_NE(text.find("rest_angles"), std::string::npos);
  EXPECT_EQ(parse(text).system, scene.system);
  EXPECT_EQ(format_scene(parse(text)), text);
}

TEST(RestAngles, OfGeneratedFacesStayWithTheGenerator) {
  const Scene scene =
      parse(R"({"hooke": 1, "generators": [{"type": "jelly", "columns": 3, "rows": 3, "layers": 3, "spacing": 0.1, "density": 100,
    "young": 1000}], "forces": [{"type": "bending", "rest": "as_built"}]})");
  const std::string text = format_scene(scene);
  EXPECT_EQ(text.find("rest_angles"), std::string::npos);
  EXPECT_NE(text.find("generators"), std::string::npos);
  EXPECT_EQ(parse(text).system, scene.system);
}

TEST(RestAngles, OfARunThatIsSavedAndContinuedStayThoseAsBuilt) {
  Lab lab(parse(corner));
  lab.submit(SetGravity{{1.0, -9.81, 0.0}});
  for (int i = 0; i < 5; ++i) lab.step();
  const Scene again = parse(format_scene(lab.scene()));
  EXPECT_EQ(again.system.faces, lab.scene().system.faces);
  EXPECT_EQ(again.system.faces, parse(corner).system.faces);
}

TEST(RestAngles, ThatAreNotValidAreRefused) {
  const std::string text = corner;
  const auto refused = [&](const std::string& list) {
    std::string with = text;
    with.insert(with.rfind('}'), ", \"rest_angles\": " + list);
    try {
      parse(with);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refused("[[0, 0, 0], [0.5, 0, -3]]"), "accepted");
  EXPECT_NE(refused("[[0, 0, 0]]").find("rest_angles: 1 items: must be as many as the 2 faces"), std::string::npos);
  EXPECT_NE(refused("[[0, 0, 4], [0, 0, 0]]").find("rest_angles[0]"), std::string::npos);
  EXPECT_NE(refused("[[0, 0], [0, 0, 0]]").find("rest_angles[0]"), std::string::npos);
  EXPECT_NE(refused("3").find("rest_angles"), std::string::npos);
  std::string other = text;
  other.replace(other.find("as_built"), 8, "folded");
  try {
    parse(other);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("must be one of \"flat\", \"as_built\""), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hooke
