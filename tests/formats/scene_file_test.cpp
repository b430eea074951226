// Scene files: the meaning of a text, what is preserved, and that a saved scene is read back bit for bit.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <random>
#include <sstream>

#include "base/atomic_write.h"
#include "base/bounds.h"
#include "base/json_field.h"
#include "formats/scene_file.h"
#include "sim/integrator.h"
#include "support/scratch_folder.h"
#include "support/trial.h"

namespace hooke {
namespace {

Scene parse(const std::string& text) { return parse_scene(text, "test.json").scene; }
std::vector<std::string> warnings_of(const std::string& text) { return parse_scene(text, "test.json").warnings; }

std::string generated(const std::string& generator) { return R"({"hooke": 1, "generators": [)" + generator + "]}"; }

TEST(SceneFile, OmittedFieldsHaveTheDocumentedValues) {
  const Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [3, 4, 0]}],
                                "springs": [{"points": [0, 1], "stiffness": 7}]})");
  EXPECT_EQ(scene.system.dimensions, 3);
  EXPECT_EQ(scene.system.gravity, Vec3(0.0, -9.81, 0.0));
  EXPECT_EQ(scene.system.drag, 0.0);
  EXPECT_TRUE(scene.system.drag_on && scene.system.dashpots_on);
  EXPECT_EQ(scene.system.points()[1].mass, 1.0);
  EXPECT_EQ(scene.system.points()[1].radius, 0.02);
  EXPECT_FALSE(scene.system.points()[1].nailed || scene.system.points()[1].color);
  EXPECT_EQ(scene.system.springs()[0].rest_length, 5.0);
  EXPECT_EQ(scene.system.springs()[0].damping, 0.0);
  EXPECT_EQ(scene.system.springs()[0].break_strain, never_breaks);
  EXPECT_EQ(scene.settings, Settings{});
  EXPECT_EQ(scene.settings.integrator->id, "velocity_verlet");
  EXPECT_EQ(scene.defaults, Defaults{});
  EXPECT_EQ(scene.view, ViewSettings{});
}

TEST(SceneFile, TwoSpringsBetweenTheSamePointsStayTwo) {
  const Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}],
                                "springs": [{"points": [0, 1], "stiffness": 1}, {"points": [1, 0], "stiffness": 2}]})");
  ASSERT_EQ(scene.system.spring_count(), 2);
  EXPECT_EQ(parse(format_scene(scene)).system, scene.system);
}

TEST(SceneFile, PositionsInTheXYPlaneMayHaveTwoNumbers) {
  const Scene scene = parse(R"({"hooke": 1, "points": [{"position": [1, 2], "velocity": [3, 4]}], "dimensions": 2, "gravity": [0, -1],
                                "colliders": [{"type": "box", "min": [0, 0], "max": [4, 1]}]})");
  EXPECT_EQ(scene.state.position[0], Vec3(1.0, 2.0, 0.0));
  EXPECT_EQ(scene.state.velocity[0], Vec3(3.0, 4.0, 0.0));
  // so deep inside that the nearest point of the surface is never along z
  EXPECT_EQ(std::get<Box>(scene.system.colliders[0].shape), (Box{{0.0, 0.0, -1.0}, {4.0, 1.0, 1.0}}));
}

TEST(SceneFile, NormalsBecomeUnitVectors) {
  const auto normal_of = [](const std::string& normal) {
    return std::get<Plane>(parse(R"({"hooke": 1, "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": )" + normal + "}]}")
                               .system.colliders[0]
                               .shape)
        .normal;
  };
  EXPECT_EQ(normal_of("[0, 5, 0]"), Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(glm::length(normal_of("[1e300, 1e300, 0]")), 1.0, 1e-15);
  EXPECT_NEAR(glm::length(normal_of("[1e-300, 1e-300, 1e-300]")), 1.0, 1e-15);
}

TEST(SceneFile, SpringsMayEndAtGeneratedPoints) {
  const Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 1, 0]}], "springs": [{"points": [0, 2], "stiffness": 5}],
                                "generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 3, "stiffness": 1}]})");
  ASSERT_EQ(scene.system.point_count(), 4);
  ASSERT_EQ(scene.system.spring_count(), 3);
  EXPECT_EQ(scene.system.springs()[0].rest_length, std::sqrt(1.25));
}

TEST(SceneFile, WarnsAboutCoincidentPointsConnectedByASpring) {
  EXPECT_EQ(warnings_of(R"({"hooke": 1, "points": [{"position": [0, 1, 0]}, {"position": [0, 1, 0]}, {"position": [0, 1, 0]}],
                            "springs": [{"points": [0, 1], "stiffness": 1}, {"points": [1, 2], "stiffness": 1}]})"),
            std::vector<std::string>{
                "test.json: springs[0] and 1 more: connects two points at the same position: no force between them until they separate"});
}

TEST(SceneFile, WarnsAboutAStepBeyondTheStabilityLimitAndRecommendsAStableOne) {
  // a mass on a nailed spring: omega = 1000 1/s, so h < 2/1000 s, 8.33 substeps per frame
  const std::string scene = R"({"hooke": 1, "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [0, 1, 0]}],
                                "springs": [{"points": [0, 1], "stiffness": 1e6}], "simulation": {"integrator": ")";
  EXPECT_EQ(warnings_of(scene + R"(velocity_verlet", "substeps": 8}})"),
            std::vector<std::string>{"test.json: simulation.substeps: 8: may be too few for velocity_verlet here: its linear stability "
                                     "limit is 9 substeps per frame; 36 are recommended"});
  EXPECT_EQ(warnings_of(scene + R"(velocity_verlet", "substeps": 9}})"), std::vector<std::string>{});
  EXPECT_EQ(warnings_of(scene + R"(explicit_euler", "substeps": 1000}})"),
            std::vector<std::string>{"test.json: simulation.integrator: explicit_euler: amplifies undamped motion at every step here; "
                                     "velocity_verlet with 36 substeps per frame is recommended"});
}

TEST(SceneFile, UnknownKeysAreReportedAndKept) {
  const std::string text = R"({"hooke": 1, "mine": {"big": 12345678901234567890123, "list": [1, {"a": null}]},
    "points": [{"position": [0, 0, 0], "label": "A"}, {"position": [1, 0, 0], "label": "B\n"}],
    "springs": [{"points": [0, 1], "stiffness": 1, "material": "steel"}],
    "colliders": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.1, "glossy": true}],
    "simulation": {"threads": 4}, "view": {"camera": {"eye": [0, 0, 1], "lens": 35}, "fog": 0.5}, "defaults": {"shape": "round"},
    "controls": {"damping": [0, 1, 2]}})";
  EXPECT_EQ(warnings_of(text), (std::vector<std::string>{
                                   "test.json: controls.damping: unknown key, kept",
                                   "test.json: view.fog: unknown key, kept",
                                   "test.json: colliders[0].glossy: unknown key, kept",
                                   "test.json: points[0].label: unknown key, kept (2 times)",
                                   "test.json: view.camera.lens: unknown key, kept",
                                   "test.json: springs[0].material: unknown key, kept",
                                   "test.json: mine: unknown key, kept",
                                   "test.json: defaults.shape: unknown key, kept",
                                   "test.json: simulation.threads: unknown key, kept",
                               }));
  const std::string saved = format_scene(parse(text));
  for (const char* kept :
       {R"("mine": {"big": 12345678901234567890123, "list": [1, {"a": null}]})", R"("label": "B\n"})", R"("material": "steel")",
        R"("glossy": true)", R"("threads": 4)", R"("lens": 35)", R"("fog": 0.5)", R"("shape": "round")", R"("damping": [0, 1, 2])"})
    EXPECT_NE(saved.find(kept), std::string::npos) << kept << " in\n" << saved;
  EXPECT_EQ(format_scene(parse(saved)), saved);
}

TEST(SceneFile, AnUnknownKeyFollowsItsPointThroughEditsOfOthers) {
  Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0], "label": "B"}]})");
  scene.system.set_points({scene.system.points()[1]});
  scene.state.position.erase(scene.state.position.begin());
  scene.state.velocity.pop_back();
  EXPECT_NE(format_scene(scene).find(R"({"position": [1, 0, 0], "mass": 1, "radius": 0.02, "label": "B"})"), std::string::npos);
}

TEST(SceneFile, AScriptedHandIsReadBackBitForBitAndRemovedWithItsPoint) {
  Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}], "hand": {"point": 1, "circle":
    {"from": [0.1, -0.0, 1e-300], "center": [3, 0.2, 0], "axis": [1, 2, 2], "a": 1}, "speed": 0.3, "begin": -7e-3, "seconds": 1e3, "b": [2]}})");
  const ScriptedHand& hand = *scene.system.scripted_hand;
  EXPECT_EQ(hand.point, scene.system.points()[1].id);
  EXPECT_EQ(hand.axis, Vec3(1.0, 2.0, 2.0) / 3.0);
  EXPECT_EQ(hand.begin, -7e-3);
  const std::string text = format_scene(scene);
  const Scene again = parse(text);
  EXPECT_EQ(again.system, scene.system);
  EXPECT_TRUE(std::signbit(again.system.scripted_hand->from.y));
  EXPECT_EQ(format_scene(again), text);
  for (const char* kept : {"\"a\": 1", "\"b\": [2]"}) EXPECT_NE(text.find(kept), std::string::npos) << kept;

  scene.system.set_points({scene.system.points()[0]});
  scene.state.position.resize(1);
  scene.state.velocity.resize(1);
  EXPECT_EQ(format_scene(scene).find("\"hand\""), std::string::npos);
}

TEST(SceneFile, ManyUnknownKeysAreReportedInFewLines) {
  std::string text = R"({"hooke": 1)";
  for (int i = 0; i < 1000; ++i) text += ", \"k" + std::to_string(i) + "\": 0";
  const auto warnings = warnings_of(text + "}");
  ASSERT_EQ(warnings.size(), 21u);
  EXPECT_EQ(warnings.back(), "test.json: and 980 more unknown keys, kept");
}

TEST(Generators, AClothAsAPlainGraphHasEqualMassesAndTheGivenStiffness) {
  const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [2, 0, 0], "down": [0, -1, 0], "points": [3, 2],
      "mass_model": "equal", "density": 0.3, "stiffness": 1000, "damping": 2, "nail": ["top_left", 4]})"));
  ASSERT_EQ(scene.system.point_count(), 6);
  ASSERT_EQ(scene.system.spring_count(), 4 + 3 + 4);
  ASSERT_EQ(scene.system.faces.size(), 4u);
  for (const Point& point : scene.system.points()) EXPECT_DOUBLE_EQ(point.mass, 0.3 * 2.0 / 6.0);
  EXPECT_EQ(scene.state.position[4], Vec3(1.0, -1.0, 0.0));
  for (Index i = 0; i < 6; ++i) EXPECT_EQ(scene.system.points()[i].nailed, i == 0 || i == 4);
  for (const Spring& spring : scene.system.springs()) {
    const bool diagonal = spring.rest_length == std::sqrt(2.0);
    EXPECT_EQ(spring.stiffness, diagonal ? 500.0 : 1000.0);
    EXPECT_EQ(spring.damping, 2.0);
  }
}

TEST(Generators, AClothAsAMaterialHasHalfValuesOnTheBorderAndTheTotalMass) {
  const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [3, 0, 0], "down": [0, -3, 0], "points": [4, 4],
      "density": 0.5, "stiffness": 100, "damping": 4})"));
  double total = 0.0;
  for (const Point& point : scene.system.points()) total += point.mass;
  EXPECT_NEAR(total, 0.5 * 9.0, 1e-14);
  EXPECT_DOUBLE_EQ(scene.system.points()[0].mass, 0.125);
  EXPECT_DOUBLE_EQ(scene.system.points()[1].mass, 0.25);
  EXPECT_DOUBLE_EQ(scene.system.points()[5].mass, 0.5);
  for (const Spring& spring : scene.system.springs()) {
    const Vec3 first = scene.state.position[scene.system.index_of(spring.first)],
               second = scene.state.position[scene.system.index_of(spring.second)];
    const bool diagonal = spring.rest_length > 1.2;
    const bool border =
        (first.x == second.x && (first.x == 0.0 || first.x == 3.0)) || (first.y == second.y && (first.y == 0.0 || first.y == -3.0));
    EXPECT_DOUBLE_EQ(spring.stiffness, diagonal || border ? 50.0 : 100.0);
    EXPECT_DOUBLE_EQ(spring.damping, diagonal || border ? 2.0 : 4.0);
  }
}

// The energy of a small uniform strain per area must not depend on the number of points: E = 1/2 sum k (dl)^2.
TEST(Generators, AMaterialClothStoresTheSameEnergyAtEveryResolution) {
  const auto energy_of = [](int columns, int rows, const glm::dmat2& strain) {
    const Scene scene = parse(
        generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -0.6, 0], "stiffness": 80, "points": [)" +
                  std::to_string(columns) + ", " + std::to_string(rows) + "]}"));
    double energy = 0.0;
    for (const Spring& spring : scene.system.springs()) {
      const glm::dvec2 along(scene.state.position[scene.system.index_of(spring.second)] -
                             scene.state.position[scene.system.index_of(spring.first)]);
      const double longer = glm::dot(along, strain * along) / spring.rest_length;
      energy += 0.5 * spring.stiffness * longer * longer;
    }
    return energy;
  };
  for (const glm::dmat2& strain : {glm::dmat2(1, 0, 0, 0), glm::dmat2(0, 0, 0, 1), glm::dmat2(0, 1, 1, 0)}) {
    const double coarse = energy_of(6, 4, strain);
    EXPECT_NEAR(energy_of(11, 7, strain), coarse, 1e-12 * coarse);
    EXPECT_NEAR(energy_of(51, 31, strain), coarse, 1e-12 * coarse);
  }
}

// Without diagonals each column hangs independently. Its springs, n = N - 1 down, carry (n - r - 1/2) / n^2 of the mass M of the sheet, r =
// 0 .. n - 1; the two border columns carry half as much and are half as stiff. In total the lowest row sags by M g / (2 k).
TEST(Generators, AMaterialClothSagsByHalfItsWeightOverItsStiffnessAtEveryResolution) {
  for (const int n : {2, 5, 17}) {
    const Scene scene = parse(generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "density": 1.3,
        "stiffness": 200, "shear_stiffness": 0, "nail": ["top"], "points": [)" +
                                        std::to_string(n) + ", " + std::to_string(n) + "]}"));
    Trial trial{scene.system, scene.state};
    trial.system.drag = 5.0;
    trial.run(*find_integrator("baraff_witkin"), 20.0, 400);
    for (int column = 0; column < n; ++column) {
      const Vec3 lowest(column / (n - 1.0), -1.0 - 1.3 * 9.81 / (2.0 * 200.0), 0.0);
      EXPECT_LT(glm::distance(trial.state.position[(n - 1) * n + column], lowest), 1e-11) << "N = " << n;
    }
  }
}

TEST(Generators, RopesTakeMassAndStiffnessPerPartOrOfTheWhole) {
  const std::string rope =
      R"({"type": "rope", "from": [0, 0, 0], "to": [2, 0, 0], "points": 5, "mass": 1, "stiffness": 10, "damping": 3, "nail": ["from", "to"])";
  const Scene graph = parse(generated(rope + "}")), whole = parse(generated(rope + R"(, "mass_model": "tributary"})"));
  for (Index i = 0; i < 5; ++i) {
    EXPECT_DOUBLE_EQ(graph.system.points()[i].mass, 0.2);
    EXPECT_DOUBLE_EQ(whole.system.points()[i].mass, i == 0 || i == 4 ? 0.125 : 0.25);
    EXPECT_EQ(graph.system.points()[i].nailed, i == 0 || i == 4);
  }
  for (Index s = 0; s < 4; ++s) {
    EXPECT_EQ(graph.system.springs()[s].stiffness, 10.0);
    EXPECT_EQ(graph.system.springs()[s].damping, 3.0);
    // four springs in series are as stiff as the whole
    EXPECT_EQ(whole.system.springs()[s].stiffness, 40.0);
    EXPECT_EQ(whole.system.springs()[s].damping, 12.0);
  }
}

TEST(Generators, StiffnessPerStrainIsDividedByEachRestLength) {
  const Scene scene = parse(generated(
      R"({"type": "cloth", "corner": [0, 0, 0], "across": [3, 0, 0], "down": [0, -4, 0], "points": [2, 2], "stiffness_per_strain": 60})"));
  ASSERT_EQ(scene.system.spring_count(), 6);
  for (const Spring& spring : scene.system.springs()) EXPECT_DOUBLE_EQ(spring.stiffness, 60.0 / spring.rest_length);
}

TEST(Generators, EveryWordForNailsNailsTheCorrectPoints) {
  const auto nails_of = [](const std::string& word) {
    const Scene scene = parse(generated(
        R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [3, 3], "stiffness": 1, "nail": [")" +
        word + "\"]}"));
    std::string nails;
    for (const Point& point : scene.system.points()) nails += point.nailed ? 'x' : '.';
    return nails;
  };
  EXPECT_EQ(nails_of("top"), "xxx......");
  EXPECT_EQ(nails_of("bottom"), "......xxx");
  EXPECT_EQ(nails_of("left"), "x..x..x..");
  EXPECT_EQ(nails_of("right"), "..x..x..x");
  EXPECT_EQ(nails_of("border"), "xxxx.xxxx");
  EXPECT_EQ(nails_of("corners"), "x.x...x.x");
  EXPECT_EQ(nails_of("top_left"), "x........");
  EXPECT_EQ(nails_of("top_right"), "..x......");
  EXPECT_EQ(nails_of("bottom_left"), "......x..");
  EXPECT_EQ(nails_of("bottom_right"), "........x");
}

TEST(Generators, ArePreservedWhenSavedUnedited) {
  const std::string list = R"([{"type": "rope",   "from": [0, 0, 0], "to": [1, 0, 0], "points": 5, "stiffness": 1}])";
  Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 1, 0]}], "generators": )" + list + "}");
  EXPECT_NE(format_scene(scene).find("\"generators\": " + list), std::string::npos);

  // a listed point does not belong to them
  scene.state.position[0] = Vec3(5.0);
  EXPECT_NE(format_scene(scene).find("\"generators\": " + list), std::string::npos);
}

TEST(Generators, AreReplacedByPointsAndSpringsOnceAnyOfThoseIsEdited) {
  const Scene scene = parse(
      generated(R"({"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0], "points": [3, 3], "stiffness": 1})"));
  const auto expect_listed = [](const Scene& edited) {
    const std::string text = format_scene(edited);
    EXPECT_EQ(text.find("generators"), std::string::npos);
    const Scene again = parse(text);
    EXPECT_EQ(again.system, edited.system);
    EXPECT_EQ(again.state.position, edited.state.position);
    EXPECT_EQ(again.state.velocity, edited.state.velocity);
  };
  Scene edited = scene;
  edited.state.position[4].x = std::nextafter(edited.state.position[4].x, 1.0);
  expect_listed(edited);
  edited = scene;
  edited.state.velocity[4].y = -0.0;
  expect_listed(edited);
  edited = scene;
  edited.system.point(0).nailed = true;
  expect_listed(edited);
  edited = scene;
  edited.system.spring(3).stiffness = 2.0;
  expect_listed(edited);
  edited = scene;
  edited.system.faces.pop_back();
  expect_listed(edited);
  edited = scene;
  edited.system.append_point({.id = edited.system.new_point_id()});
  edited.state.position.emplace_back(0.0);
  edited.state.velocity.emplace_back(0.0);
  expect_listed(edited);
}

// Numbers that are difficult for writers and readers of decimal digits.
double hard_number(std::mt19937_64& random) {
  constexpr double special[] = {
      0.0, -0.0, 5e-324, 2.2250738585072011e-308, 1.7976931348623157e308, 9007199254740993.0, 1e22, 1e23, 0.1, 123456789012345680.0, 0.3};
  if (random() % 4 == 0) return special[random() % std::size(special)];
  if (random() % 4 == 0) return static_cast<double>(random() % 1000) / 100.0;
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

TEST(SceneFile, DigitsAreReadAsTheNearestNumber) {
  JsonParser parser;
  for (const auto& [text, value] : {std::pair{"1e-400", 0.0},
                                    {"2.4703282292062327e-324", 0.0},
                                    {"2.4703282292062328e-324", 5e-324},
                                    {"9007199254740993", 9007199254740992.0},
                                    {"179769313486231570e291", 1.7976931348623157e308},
                                    {"1.00000000000000011102230246251565404236316680908203126", 1.0000000000000002},
                                    {"0.000000000000000000000000000000000000000000000000000000000000001", 1e-63},
                                    {"-0", -0.0}})
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parser.parse(text).GetDouble()), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(SceneFile, EveryNumberIsReadBackBitForBit) {
  std::mt19937_64 random(1);
  JsonParser parser;
  for (int i = 0; i < 200'000; ++i) {
    const double value = hard_number(random);
    const std::string text = format_exact(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parser.parse(text).GetDouble()), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

// Random scenes with any numbers a file may contain, with gaps in the ids.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {}

  Scene make() {
    Scene scene;
    scene.name = text();
    scene.description = text();
    System& system = scene.system;
    system.dimensions = flat_ ? 2 : 3;
    system.gravity = place();
    system.wind = place();
    system.drag = not_negative();
    system.drag_on = random_() % 2;
    system.dashpots_on = random_() % 2;
    for (std::size_t family = 1; family < spring_families; ++family) system.family_on[family] = random_() % 2;
    scene.state.time = hard_number(random_);
    add_points(scene);
    add_springs(scene);
    for (std::uint64_t f = random_() % 3; f > 0 && system.point_count() >= 3; --f) {
      const Index first = below(system.point_count() - 2);
      system.faces.push_back({{system.points()[first].id, system.points()[first + 2].id, system.points()[first + 1].id}});
    }
    for (std::uint64_t c = random_() % 4; c > 0; --c) system.colliders.push_back(collider());
    set_settings(scene);
    return scene;
  }

 private:
  Index below(Index count) { return static_cast<Index>(random_() % static_cast<std::uint64_t>(count)); }
  double not_negative() { return std::abs(hard_number(random_)); }
  double positive() {
    const double value = not_negative();
    return std::isnormal(value) ? value : 1.0;
  }
  Vec3 anywhere() { return {hard_number(random_), hard_number(random_), hard_number(random_)}; }
  Vec3 place() {
    Vec3 place = anywhere();
    if (flat_) place.z = random_() % 2 ? 0.0 : -0.0;
    return place;
  }
  Color color() {
    return {static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_())};
  }
  std::string text() {
    constexpr const char* pieces[] = {"a", "\"", "\\", "\n", "\u00e9", "\u2028", "\U0001f600", "/", "", " ", "\x1b", "\x7f"};
    std::string text;
    for (std::uint64_t i = random_() % 8; i > 0; --i) {
      const std::size_t piece = random_() % std::size(pieces);
      text += piece == 8 ? std::string(1, '\0') : std::string(pieces[piece]);
    }
    return text;
  }

  void add_points(Scene& scene) {
    for (std::uint64_t i = random_() % 6; i > 0; --i) {
      if (random_() % 3 == 0) scene.system.new_point_id();
      Point point{.id = scene.system.new_point_id(), .nailed = random_() % 2 == 0, .mass = positive(), .radius = not_negative()};
      if (random_() % 2) point.color = color();
      scene.system.append_point(point);
      scene.state.position.push_back(place());
      scene.state.velocity.push_back(random_() % 2 ? place() : Vec3(0.0));
    }
  }
  void add_springs(Scene& scene) {
    const Index count = scene.system.point_count();
    for (std::uint64_t i = random_() % 6; i > 0 && count >= 2; --i) {
      const Index first = below(count), second = (first + 1 + below(count - 1)) % count;
      if (random_() % 3 == 0) scene.system.new_spring_id();
      scene.system.append_spring({.id = scene.system.new_spring_id(),
                                  .first = scene.system.points()[first].id,
                                  .second = scene.system.points()[second].id,
                                  .family = static_cast<SpringFamily>(random_() % spring_families),
                                  .stiffness = not_negative(),
                                  .damping = not_negative(),
                                  .rest_length = not_negative(),
                                  .break_strain = random_() % 2 ? never_breaks : positive()});
    }
  }
  Collider collider() {
    Collider collider{.restitution = static_cast<double>(random_() % 101) / 100.0, .friction = not_negative(), .solid = random_() % 2 == 0};
    const auto small = [&] { return static_cast<double>(random_()) / 1e19 - 0.9; };
    switch (random_() % 3) {
      case 0:
        collider.shape = Plane{anywhere(), glm::normalize(Vec3(small(), small(), small()))};
        break;
      case 1:
        collider.shape = Sphere{anywhere(), positive()};
        break;
      default:
        collider.shape = Box{{-not_negative() - 1.0, -1.0, -0.1}, {0.0, -0.0, 5e-324}};
    }
    return collider;
  }
  void set_settings(Scene& scene) {
    const auto methods = integrators();
    scene.settings = {.integrator = &methods[random_() % methods.size()],
                      .frame_rate = positive(),
                      .substeps = 1 + below(1'000'000),
                      .speed = positive()};
    if (random_() % 2) scene.settings.tolerance = positive();
    if (random_() % 2) {
      scene.view.camera =
          CameraPose{.eye = anywhere(), .target = anywhere(), .orthographic = random_() % 2 == 0, .follows = random_() % 2 == 0};
      if (scene.view.camera->eye == scene.view.camera->target)
        scene.view.camera.reset();
      else if (random_() % 2)
        scene.view.camera->up = Vec3(0.0, positive(), -0.0);
    }
    if (random_() % 2) scene.view.background = color();
    if (random_() % 2)
      scene.defaults = {positive(),     not_negative(), not_negative(),
                        not_negative(), not_negative(), random_() % 2 ? GrabKind::Hold : GrabKind::Pull};
    if (random_() % 2) scene.controls = {0.25, 0.25 + 1e-3 + static_cast<double>(random_() % 100), positive()};
  }

  std::mt19937_64 random_;
  bool flat_ = random_() % 2 == 0;
};

// Equal to the last bit, unlike ==, which takes -0.0 for 0.0. Ids matter only by the items they refer to.
std::string bits_of(const Scene& scene) {
  std::ostringstream text;
  const auto add = [&](auto... values) { ((text << std::hex << std::bit_cast<std::uint64_t>(static_cast<double>(values)) << ' '), ...); };
  const auto add_vector = [&](const Vec3& v) { add(v.x, v.y, v.z); };
  const auto add_color = [&](const std::optional<Color>& c) { text << (c ? c->red * 65536 + c->green * 256 + c->blue : -1) << ' '; };
  const System& system = scene.system;
  text << scene.name.size() << scene.name << scene.description.size() << scene.description << system.dimensions << system.drag_on
       << system.dashpots_on << system.family_on[1] << system.family_on[2] << system.family_on[3] << ' ';
  add(scene.state.time, system.drag);
  add_vector(system.gravity);
  add_vector(system.wind);
  for (Index i = 0; i < system.point_count(); ++i) {
    add(system.points()[i].nailed, system.points()[i].mass, system.points()[i].radius);
    add_color(system.points()[i].color);
    add_vector(scene.state.position[i]);
    add_vector(scene.state.velocity[i]);
  }
  for (const Spring& spring : system.springs())
    add(system.index_of(spring.first), system.index_of(spring.second), spring.family, spring.stiffness, spring.damping, spring.rest_length,
        spring.break_strain);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) add(system.index_of(id));
  for (const Collider& collider : system.colliders) {
    add(collider.shape.index(), collider.restitution, collider.friction, collider.solid);
    if (const auto* plane = std::get_if<Plane>(&collider.shape)) add_vector(plane->point), add_vector(plane->normal);
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) add_vector(sphere->center), add(sphere->radius);
    if (const auto* box = std::get_if<Box>(&collider.shape)) add_vector(box->min), add_vector(box->max);
  }
  text << scene.settings.integrator->id << ' ';
  add(scene.settings.frame_rate, scene.settings.substeps, scene.settings.speed, scene.settings.tolerance.value_or(-1.0));
  if (scene.view.camera) {
    add_vector(scene.view.camera->eye);
    add_vector(scene.view.camera->target);
    add_vector(scene.view.camera->up.value_or(Vec3(-7.0)));
    add(scene.view.camera->orthographic);
    add(scene.view.camera->follows);
  }
  add_color(scene.view.background);
  const Defaults& d = scene.defaults;
  add(d.mass, d.radius, d.stiffness, d.damping, d.pull_stiffness, d.grab == GrabKind::Hold);
  add(scene.controls.stiffness_min, scene.controls.stiffness_max, scene.controls.stiffness_step);
  return text.str();
}

TEST(SceneFile, RandomScenesAreReadBackBitForBit) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Scene scene = RandomScene(seed).make();
    const std::string text = format_scene(scene);
    ASSERT_EQ(bits_of(parse(text)), bits_of(scene)) << "seed " << seed << "\n" << text;
    ASSERT_EQ(format_scene(parse(text)), text) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hooke
