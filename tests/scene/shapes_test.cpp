// Shapes: what each row of the table generates.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/shape.h"
#include "scene/shapes/rows.h"

namespace hooke {
namespace {

Network made(const Shape& shape) {
  Network network;
  generate(shape, network);
  return network;
}

Shape default_value(std::string_view id) { return default_shape(*find_shape_kind(id)); }

void set(Shape& shape, std::string_view name, double value) {
  const auto row = std::ranges::find(shape.kind->numbers, name, &ShapeNumber::name);
  ASSERT_NE(row, shape.kind->numbers.end()) << name;
  shape.values[static_cast<std::size_t>(row - shape.kind->numbers.begin())] = value;
}

double mass_of(const Network& network, bool nails_too = true) {
  double sum = 0.0;
  for (const Point& point : network.points) sum += nails_too || !point.nailed ? point.mass : 0.0;
  return sum;
}

// All shapes with every support, at default, minimum and some unusual parameters.
std::vector<Shape> all_shapes() {
  std::vector<Shape> shapes;
  for (const ShapeKind& kind : placeable_shapes())
    for (std::size_t support = 0; support < kind.supports.size(); ++support) {
      shapes.push_back(default_shape(kind));
      shapes.back().support = support;
      for (const double fraction : {0.0, 0.03}) {
        Shape odd = shapes.back();
        for (std::size_t i = 0; i < kind.numbers.size(); ++i)
          if (kind.numbers[i].integer)
            odd.values[i] = std::round(kind.numbers[i].min + fraction * (kind.numbers[i].max - kind.numbers[i].min));
        shapes.push_back(odd);
      }
    }
  return shapes;
}

TEST(Shapes, AreTheConstantsOfTheirFiles) {
  EXPECT_EQ(&cloth_shape, find_shape_kind("cloth"));
  for (const ShapeKind& kind : shape_kinds()) EXPECT_EQ(&kind, find_shape_kind(kind.id)) << kind.id;
}

TEST(Shapes, GenerateAsManyPointsAndSpringsAsAnnounced) {
  for (const Shape& shape : all_shapes()) {
    const Network network = made(shape);
    const ElementCount element_count = element_count_of(shape);
    EXPECT_EQ(network.points.size(), element_count.points) << shape.kind->id;
    EXPECT_EQ(network.springs.size(), element_count.springs) << shape.kind->id;
    EXPECT_EQ(network.faces.size(), element_count.faces) << shape.kind->id;
  }
}

TEST(Shapes, StartUnstrainedAndConnectEveryPairOfPositionsOnce) {
  for (const Shape& shape : all_shapes()) {
    const Network network = made(shape);
    std::set<std::pair<PointId, PointId>> joined;
    for (const Spring& spring : network.springs) {
      const auto i = static_cast<std::size_t>(spring.first), j = static_cast<std::size_t>(spring.second);
      const double length = glm::length(network.position[j] - network.position[i]);
      EXPECT_GT(length, 0.0) << shape.kind->id;
      EXPECT_TRUE(joined.insert(std::minmax(spring.first, spring.second)).second) << shape.kind->id;
      // the folds of a curtain are straight, so only springs across a fold are shorter than in the flat cloth
      if (shape.kind->id == "curtain")
        EXPECT_LT(length, spring.rest_length * (1.0 + 1e-9));
      else
        EXPECT_NEAR(length, spring.rest_length, 1e-9 * spring.rest_length) << shape.kind->id;
    }
  }
}

TEST(Shapes, AreNailedByTheirSupport) {
  for (const Shape& shape : all_shapes()) {
    const Network network = made(shape);
    const bool has_nails = std::ranges::any_of(network.points, &Point::nailed);
    EXPECT_EQ(has_nails, shape.support_name() != "nothing") << shape.kind->id << " by " << shape.support_name();
  }
  Shape sheet = default_value("sheet");
  const auto nails = [&](std::string_view support_name) {
    sheet.support = static_cast<std::size_t>(std::ranges::find(sheet.kind->supports, support_name) - sheet.kind->supports.begin());
    return std::ranges::count(made(sheet).points, true, &Point::nailed);
  };
  EXPECT_EQ(nails("top_corners"), 2);
  EXPECT_EQ(nails("corners"), 4);
  EXPECT_EQ(nails("edge"), 24);
  EXPECT_EQ(nails("ring"), 4 * 23);
  EXPECT_EQ(nails("nothing"), 0);
}

TEST(Shapes, HaveTheirPositionAndOrientation) {
  Shape sheet = default_value("sheet");
  sheet.at = {1.0, 2.0, 3.0};
  sheet.tilt = 90.0;
  const Network lying = made(sheet);
  for (const Vec3& place : lying.position) EXPECT_NEAR(place.y, 2.0, 1e-12);
  EXPECT_NEAR(glm::length(lying.position.front() + lying.position.back() - 2.0 * sheet.at), 0.0, 1e-12);
  sheet.tilt = 0.0;
  sheet.turn = 90.0;
  for (const Vec3& place : made(sheet).position) EXPECT_NEAR(place.x, 1.0, 1e-12);
}

TEST(Shapes, HaveTheMassGivenByTheirParameters) {
  EXPECT_NEAR(mass_of(made(default_value("hanging_rope"))), 0.15, 1e-12);
  EXPECT_NEAR(mass_of(made(default_value("chain"))), 0.4, 1e-12);
  EXPECT_NEAR(mass_of(made(default_value("net"))), 0.4, 1e-12);
  EXPECT_NEAR(mass_of(made(default_value("bridge"))), 4.0, 1e-12);
  EXPECT_NEAR(mass_of(made(default_value("sheet"))), 0.2, 1e-12);
  EXPECT_NEAR(mass_of(made(default_value("jelly"))), 100.0 * 0.4 * 0.4 * 0.4, 1e-12);
}

TEST(Shapes, ACurtainWithFullnessIsAsLongAsItsCloth) {
  const Shape curtain = default_value("curtain");
  const Network network = made(curtain);
  double length = 0.0;
  for (const Spring& spring : network.springs) {
    const auto i = static_cast<std::size_t>(spring.first), j = static_cast<std::size_t>(spring.second);
    if (i + 1 == j && j <= 32) length += glm::length(network.position[j] - network.position[i]);
  }
  EXPECT_NEAR(length, 1.5 * 1.4, 1e-12);
}

// For small strains, the energy per volume of an extension along x is C11 e^2 / 2 with C11 = 3 k / a = 6/5 E, and of a shear C44 g^2 / 2
// with C44 = k / a = 2/5 E, for any number of points.
TEST(Shapes, JellyIsTheSameIsotropicSolidAtAnySpacing) {
  for (const double points : {2.0, 4.0, 9.0}) {
    Shape jelly = default_value("jelly");
    for (const char* side : {"columns", "rows", "layers"}) set(jelly, side, points);
    set(jelly, "spacing", 0.4 / (points - 1.0));
    const Network network = made(jelly);
    const auto energy_when = [&](auto deform) {
      double sum = 0.0;
      for (const Spring& spring : network.springs) {
        const Vec3 between = deform(network.position[static_cast<std::size_t>(spring.second)]) -
                             deform(network.position[static_cast<std::size_t>(spring.first)]);
        const double stretch = glm::length(between) - spring.rest_length;
        sum += 0.5 * spring.stiffness * stretch * stretch;
      }
      return sum;
    };
    const double e = 1e-5, volume = 0.4 * 0.4 * 0.4, young = 6000.0;
    const double pulled = energy_when([&](const Vec3& x) { return x + Vec3(e * x.x, 0.0, 0.0); });
    const double sheared = energy_when([&](const Vec3& x) { return x + Vec3(e * x.y, 0.0, 0.0); });
    const double pulled_up = energy_when([&](const Vec3& x) { return x + Vec3(0.0, e * x.y, 0.0); });
    EXPECT_NEAR(pulled, 0.5 * 1.2 * young * e * e * volume, 1e-4 * pulled) << points;
    EXPECT_NEAR(pulled_up, pulled, 1e-9 * pulled) << points;
    EXPECT_NEAR(sheared, 0.5 * 0.4 * young * e * e * volume, 1e-4 * sheared) << points;
  }
}

TEST(Shapes, SolidsHaveOutwardFaces) {
  const Network network = made(default_value("jelly"));
  double volume = 0.0;
  for (const Face& face : network.faces) {
    const auto corner = [&](int i) { return network.position[static_cast<std::size_t>(face.points[i])]; };
    volume += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6.0;
  }
  EXPECT_NEAR(volume, 0.4 * 0.4 * 0.4, 1e-12);
}

std::string scene_with(const std::string& generator, int dimensions = 3) {
  return R"({"hooke": 1, "dimensions": )" + std::to_string(dimensions) + R"(, "generators": [)" + generator + "]}";
}

TEST(Shapes, AreReadBackFromAFileUnchanged) {
  for (const ShapeKind& kind : placeable_shapes()) {
    const std::string text =
        scene_with(R"({"type": ")" + std::string(kind.id) + R"(", "at": [0.1, 0.2, 0.3], "turn": 30, "tilt": 10, "color": "#102030"})");
    const LoadedScene first = parse_scene(text, "first");
    const std::string saved = format_scene(first.scene);
    EXPECT_NE(saved.find("\"generators\""), std::string::npos) << kind.id;
    const Scene again = parse_scene(saved, "again").scene;
    EXPECT_TRUE(again.system == first.scene.system) << kind.id;
    EXPECT_TRUE(again.state == first.scene.state) << kind.id;
  }
}

TEST(Shapes, RunForASecondAtTheirDefaults) {
  for (const ShapeKind& kind : placeable_shapes()) {
    Scene scene = parse_scene(scene_with(R"({"type": ")" + std::string(kind.id) + R"("})"), kind.id.data()).scene;
    scene.settings.substeps = 60;
    Lab lab(std::move(scene));
    bool stable = true;
    for (int frame = 0; frame < 60 && stable; ++frame) stable = lab.step();
    EXPECT_TRUE(stable) << kind.id;
  }
}

std::string refusal(const std::string& text) {
  try {
    parse_scene(text, "x.json");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(Shapes, AreRefusedWhereTheyAreInvalid) {
  EXPECT_EQ(refusal(scene_with(R"({"type": "jelly"})", 2)),
            "x.json: generators[0]: position of a point: z = -0.2: must be 0 in a 2-D scene");
  EXPECT_EQ(refusal(scene_with(R"({"type": "sheet"})", 2)), "accepted");
  EXPECT_EQ(refusal(scene_with(R"({"type": "sheet", "columns": 1})")),
            "x.json: generators[0].columns: 1: must be a whole number from 2 to 100000");
  EXPECT_NE(
      refusal(scene_with(R"({"type": "sheet", "columns": 100000, "rows": 100000})")).find("10000000000 points: must be at most 5000000"),
      std::string::npos);
  EXPECT_EQ(refusal(scene_with(R"({"type": "net", "held": "tightly"})")),
            "x.json: generators[0].held: \"tightly\": must be one of top_corners, corners, edge, ring, nothing");
  EXPECT_NE(refusal(scene_with(R"({"type": "net", "mass": -1})")).find("mass"), std::string::npos);
  EXPECT_NE(refusal(scene_with(R"({"type": "bridge", "span": 1e400})")), "accepted");
}

}  // namespace
}  // namespace hooke
