// The scene file: defaults, warnings, what is kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "sim/plan/surface_plan.h"
#include "support/parse_text.h"

namespace hooke {
namespace {

TEST(SceneFile, OmittedFieldsHaveTheDocumentedValues) {
  const Scene scene = parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [3, 4, 0]}],
                                "springs": [{"points": [0, 1], "stiffness": 7}]})");
  EXPECT_EQ(scene.system.dimensions, 3);
  EXPECT_EQ(scene.system.gravity, Vec3(0.0, -9.81, 0.0));
  EXPECT_EQ(scene.system.drag, 0.0);
  EXPECT_TRUE(scene.system.switches.drag && scene.system.switches.dashpots);
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

TEST(SceneFile, ContactBetweenPointsIsOffUnlessGivenAndIsKept) {
  EXPECT_EQ(parse(R"({"hooke": 1})").system.contact, PairContact{});
  EXPECT_EQ(format_scene(parse(R"({"hooke": 1})")).find("contact"), std::string::npos);
  const PairContact given{.points = true, .springs = true, .faces = true, .thickness = 0.004, .restitution = 0.5, .friction = 0.1};
  const Scene scene = parse(
      R"({"hooke": 1, "contact": {"points": true, "springs": true, "faces": true, "thickness": 0.004, "restitution": 0.5, "friction": 0.1}})");
  EXPECT_EQ(scene.system.contact, given);
  EXPECT_EQ(parse(format_scene(scene)).system.contact, given);
}

TEST(SceneFile, PointsThatTouchAndOverlapAreReported) {
  const std::string points = R"("points": [{"position": [0, 0, 0], "radius": 0.2}, {"position": [0.25, 0, 0], "radius": 0.2},
                                          {"position": [0.5, 0, 0], "radius": 0.2}, {"position": [0.7, 0, 0], "radius": 0.2}])";
  const auto scene = [&](const std::string& rest) { return "{\"hooke\": 1, \"dimensions\": 2, " + points + rest + "}"; };
  EXPECT_TRUE(warnings_of(scene("")).empty());
  EXPECT_EQ(warnings_of(scene(R"(, "contact": {"points": true})")),
            std::vector<std::string>{
                "test.json: contact.points: 3 pairs of points overlap, points 2 and 3 most, by 0.2 m: they cannot get closer; "
                "accelerations separate deep overlaps slowly"});
  // neither do those that a spring joins
  EXPECT_EQ(warnings_of(scene(
                R"(, "contact": {"points": true}, "springs": [{"points": [2, 3], "stiffness": 1}, {"points": [0, 1], "stiffness": 1}])")),
            std::vector<std::string>{
                "test.json: contact.points: 1 pair of points overlaps, points 1 and 2 most, by 0.15 m: they cannot get closer; "
                "accelerations separate deep overlaps slowly"});
}

TEST(SceneFile, FacesThatTouchAndPassThroughEachOtherAreReported) {
  const auto scene = [&](const std::string& height, const std::string& rest) {
    return R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, 1, 0]},
              {"position": [0.2, 0.2, )" +
           height + R"(]}, {"position": [0.2, 0.2, 1]}, {"position": [0.3, 0.2, 1]}], "faces": [[0, 1, 2], [3, 4, 5]])" + rest + "}";
  };
  EXPECT_TRUE(warnings_of(scene("-1", "")).empty());
  EXPECT_TRUE(warnings_of(scene("0.1", R"(, "contact": {"faces": true})")).empty());
  EXPECT_EQ(warnings_of(scene("-1", R"(, "contact": {"faces": true})")),
            std::vector<std::string>{
                "test.json: contact.faces: 2 edges pass through faces, the one of points 3 and 4 through that of points 0, 1 and "
                "2: they do not touch until they are apart"});
  EXPECT_EQ(warnings_of(R"({"hooke": 1, "dimensions": 2, "contact": {"faces": true}})"),
            std::vector<std::string>{"test.json: contact.faces: faces touch in scenes of 3 dimensions only: this one has 2"});
}

TEST(SceneFile, PartsThatStartFarCloserThanTheirThicknessAreReported) {
  const auto warnings = [](const std::string& height, const std::string& contact) {
    return warnings_of(R"({"hooke": 1, "points": [{"position": [-1, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, -1, )" + height +
                       R"(]}, {"position": [0, 1, )" + height + R"(]}], "springs": [{"points": [0, 1], "stiffness": 1},
                       {"points": [2, 3], "stiffness": 1}], "contact": )" +
                       contact + "}");
  };
  const std::string touching = R"({"springs": true, "thickness": 0.2})";
  EXPECT_TRUE(warnings("0.01", "{}").empty());
  EXPECT_TRUE(warnings("0.03", touching).empty());
  EXPECT_EQ(warnings("0.02", touching),
            std::vector<std::string>{
                "test.json: contact.springs: 1 pair starts closer than an eighth of the thickness, the edge of points 0 and 1 and that of "
                "points 2 and 3 most, by 0.18 m of 0.2 m: move them apart, because they separate slowly and may supply energy"});
}

TEST(SceneFile, BallsInSpringsAreReported) {
  const auto warnings = [](const std::string& y, const std::string& contact = R"({"springs": true})") {
    return warnings_of(R"({"hooke": 1, "dimensions": 2, "points": [{"position": [-1, 0]}, {"position": [1, 0]}, {"position": [0, )" + y +
                       R"(], "radius": 0.5}], "springs": [{"points": [0, 1], "stiffness": 1}], "contact": )" + contact + "}");
  };
  EXPECT_TRUE(warnings("0.65").empty());
  EXPECT_EQ(
      warnings("0.3"),
      std::vector<std::string>{
          "test.json: contact.springs: 1 point overlaps faces or springs, point 2 most, by 0.2 m: each leaves them on the side of its "
          "center"});
  EXPECT_TRUE(warnings("0.3", "{}").empty());

  // at its radius, it touches
  EXPECT_EQ(warnings("0.5"),
            std::vector<std::string>{
                "test.json: contact.springs: 1 pair starts closer than an eighth of the thickness, point 2 and the edge of points 0 and 1 "
                "most, by 0.1 m of 0.1 m: move them apart, because they separate slowly and may supply energy"});
}

TEST(SceneFile, PartsInTheSamePlaceAreReportedBecauseTheyNeverTouch) {
  const auto warnings = [](const std::string& x) {
    return warnings_of(R"({"hooke": 1, "points": [{"position": [-1, 0, 0]}, {"position": [1, 0, 0]}, {"position": [)" + x +
                       R"(, 0, 0]}, {"position": [1, 0, 0]}], "springs": [{"points": [0, 1], "stiffness": 1},
                       {"points": [2, 3], "stiffness": 1}], "contact": {"springs": true}})");
  };
  const std::string expected = "test.json: contact.springs: 1 pair is in the same place, where they never touch: move one of them apart";
  EXPECT_EQ(warnings("-1").back(), expected);
}

// A sheet of one face, and a spring of its own or tied to it.
TEST(SceneFile, SpringsThatPassThroughFacesOfOtherPartsAreReported) {
  const auto warnings = [](const std::string& contact, const std::string& spring = "3, 4", const std::string& nailed = "false") {
    const std::string end = R"(, "nailed": )" + nailed + "}";
    return warnings_of(R"({"hooke": 1, "points": [{"position": [-1, 0, 0])" + end + R"(, {"position": [1, 0, 0])" + end +
                       R"(, {"position": [0, 0, 2])" + end + R"(, {"position": [-1, 1, 1])" + end + R"(, {"position": [1, 1, 1])" + end +
                       R"(], "springs": [{"points": [)" + spring + R"(], "stiffness": 1}], "faces": [[0, 1, 2]], "contact": )" + contact +
                       "}");
  };
  EXPECT_EQ(warnings(R"({"faces": true})"),
            std::vector<std::string>{"test.json: contact.springs: off: springs such as that of points 3 and 4 pass through faces such as "
                                     "that of points 0, 1 and 2: switch it on"});
  EXPECT_EQ(warnings(R"({"springs": true})"),
            std::vector<std::string>{"test.json: contact.faces: off: springs such as that of points 3 and 4 pass through faces such as "
                                     "that of points 0, 1 and 2: switch it on"});
  for (const char* quiet : {R"({"faces": true, "springs": true})", R"({"points": true})", "{}"})
    EXPECT_TRUE(warnings(quiet).empty()) << quiet;
  EXPECT_TRUE(warnings(R"({"faces": true})", "2, 3").empty());
  EXPECT_TRUE(warnings(R"({"faces": true})", "3, 4", "true").empty());
}

// Two faces, and springs from one to the other.
TEST(SceneFile, SpringsFromOneSurfaceToAnotherAreReportedSinceTheyTouchNothing) {
  const auto text = [](const std::string& contact, const std::string& springs) {
    return R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, 1, 0]}, {"position": [0, 0, 2]},
              {"position": [1, 0, 2]}, {"position": [0, 1, 2]}, {"position": [0, 0, 1]}], "faces": [[0, 1, 2], [3, 4, 5]], "springs": [)" +
           springs + R"(], "contact": {"thickness": 0.06, )" + contact + "}}";
  };
  const auto touching_springs = [&](const std::string& scene) {
    const auto pieces = plan_surface(parse_scene(scene, "test.json").scene.system).pieces;
    return std::ranges::count_if(pieces, [](const SurfacePiece& piece) { return !piece.is_face && !piece.is_sphere(); });
  };
  const std::string both = R"("faces": true, "springs": true)", spring = R"({"points": [0, 3], "stiffness": 1})",
                    other = R"(, {"points": [1, 4], "stiffness": 1})",
                    divided = R"({"points": [0, 6], "stiffness": 1}, {"points": [6, 3], "stiffness": 1})";
  EXPECT_EQ(warnings_of(text(both, spring)),
            std::vector<std::string>{"test.json: contact.springs: 1 spring joins two surfaces and touches nothing, between points 0 and 3: "
                                     "divide it by a point, so that both halves touch"});
  EXPECT_EQ(warnings_of(text(both, spring + other)).at(0).substr(0, 90),
            "test.json: contact.springs: 2 springs join two surfaces and touch nothing, between points ");
  // what it says
  EXPECT_EQ(touching_springs(text(both, spring)), 0);
  EXPECT_EQ(touching_springs(text(both, divided)), 2);
  // along a surface, short ones, and where faces do not touch
  for (const std::string& quiet : {divided, std::string(R"({"points": [0, 1], "stiffness": 1})"),
                                   std::string(R"({"points": [0, 3], "stiffness": 1, "rest_length": 0.01})")})
    EXPECT_TRUE(warnings_of(text(both, quiet)).empty()) << quiet;
  EXPECT_EQ(touching_springs(text(R"("springs": true)", spring)), 1);
}

// Two faces of an edge, in either order of their corners.
TEST(SceneFile, RestAnglesThatContradictEachOtherAreReported) {
  const auto warnings = [](const std::string& other_face, const std::string& angles) {
    return warnings_of(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}, {"position": [0, 1, 0]},
                           {"position": [1, 1, 0]}], "faces": [[0, 1, 2], )" +
                       other_face + R"(], "rest_angles": )" + angles + "}");
  };
  EXPECT_TRUE(warnings("[3, 2, 1]", "[[0.5, 0, 0], [0.5, 0, 0]]").empty());
  EXPECT_TRUE(warnings("[3, 1, 2]", "[[0.5, 0, 0], [-0.5, 0, 0]]").empty());
  EXPECT_TRUE(warnings("[3, 2, 1]", "[[0.5, 0.1, 0], [0.5, 0, 0.2]]").empty());  // those without another face do not act
  EXPECT_TRUE(warnings("[3, 1, 2]", "[[3.141592653589793, 0, 0], [3.141592653589793, 0, 0]]").empty());
  EXPECT_EQ(warnings("[3, 2, 1]", "[[0.5, 0, 0], [0.2, 0, 0]]"),
            std::vector<std::string>{"test.json: rest_angles[1][0]: 0.2 rad: rest_angles[0][0] means 0.5 rad at the same edge: bending "
                                     "\"as_built\" rests between both"});
  EXPECT_EQ(warnings("[3, 1, 2]", "[[0.5, 0, 0], [0.5, 0, 0]]"),
            std::vector<std::string>{"test.json: rest_angles[1][0]: 0.5 rad: rest_angles[0][0] means -0.5 rad at the same edge: bending "
                                     "\"as_built\" rests between both"});
}

TEST(SceneFile, SpringsOfFlatScenesThatTouchAndCrossAreReported) {
  const auto warnings = [](const std::string& x, const std::string& contact) {
    return warnings_of(R"({"hooke": 1, "dimensions": 2, "points": [{"position": [-1, 0]}, {"position": [1, 0]}, {"position": [)" + x +
                       R"(, -1]}, {"position": [)" + x + R"(, 1]}], "springs": [{"points": [0, 1], "stiffness": 1},
                       {"points": [2, 3], "stiffness": 1}], "contact": )" +
                       contact + "}");
  };
  EXPECT_EQ(
      warnings("0.1", R"({"springs": true})"),
      std::vector<std::string>{"test.json: contact.springs: 1 pair of springs crosses, the one of points 0 and 1 that of points 2 and "
                               "3: they do not touch until they are apart"});
  EXPECT_TRUE(warnings("2", R"({"springs": true})").empty());
  EXPECT_TRUE(warnings("0.1", "{}").empty());
}

TEST(SceneFile, AThicknessThatFacesCannotHaveIsReported) {
  const auto warnings = [](const std::string& thickness) {
    return warnings_of(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1],
                        "points": [5, 5], "density": 0.2, "stiffness": 100}], "contact": {"faces": true, "thickness": )" +
                       thickness + "}}");
  };
  EXPECT_TRUE(warnings("0").empty());
  EXPECT_TRUE(warnings("0.05").empty());
  EXPECT_EQ(warnings("0.2"),
            std::vector<std::string>{"test.json: contact.thickness: 0.2 m: is more than half of the smallest faces or springs, "
                                     "which touch at 0.0884 m"});
  EXPECT_EQ(warnings("0.001"),
            std::vector<std::string>{"test.json: contact.thickness: 1 mm: is less than a twentieth of the largest faces or "
                                     "springs, which touch at 8.84 mm"});
}

TEST(SceneFile, AThicknessThatSomeSpringsAreTooShortForAndOthersTooLongIsReportedOnce) {
  EXPECT_EQ(
      warnings_of(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [0.01, 0, 0]}, {"position": [0, 1, 0]},
                             {"position": [2, 1, 0]}], "springs": [{"points": [0, 1], "stiffness": 1}, {"points": [2, 3], "stiffness": 1}],
                             "contact": {"springs": true, "thickness": 0.02}})"),
      std::vector<std::string>{"test.json: contact.thickness: 0.02 m: is more than half of the smallest faces or springs, which touch at "
                               "5 mm, and less than a twentieth of the largest faces or springs, which touch at 0.1 m"});
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

TEST(SceneFile, WarnsAboutSettingsThatTheMethodDoesNotUse) {
  const auto scene = [](const std::string& simulation) {
    return R"({"hooke": 1, "points": [{"position": [0, 0, 0]}], "simulation": {)" + simulation + "}}";
  };
  EXPECT_EQ(warnings_of(scene(R"("tolerance": 1e-3)")),
            std::vector<std::string>{"test.json: simulation.tolerance: 0.001: has no effect with velocity_verlet, which does not adapt its "
                                     "step; auto and dop853 do"});
  EXPECT_EQ(warnings_of(scene(R"("budget": 4, "integrator": "dop853")")),
            std::vector<std::string>{"test.json: simulation.budget: 4: has no effect with dop853, only with auto"});
  EXPECT_TRUE(warnings_of(scene(R"("tolerance": 1e-3, "integrator": "dop853")")).empty());
  EXPECT_TRUE(warnings_of(scene(R"("tolerance": 1e-3, "budget": 4, "integrator": "auto")")).empty());
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

// The bound of a steep force is that of its core, which the scene may never reach. The step of a passage through it is recommended with
// what it costs, if there is one; a method that adapts its steps is not, because it is not tested.
TEST(SceneFile, WarnsAboutTheStepOfASteepForceWithTheCostOfTheRecommendation) {
  const auto warnings_at = [](const std::string& strength) {
    return warnings_of(
        R"({"hooke": 1, "points": [{"position": [1, 0, 0]}], "forces": [{"type": "center", "power": 4, "core": 1e-3, "strength": )" +
        strength + R"(}], "simulation": {"integrator": "velocity_verlet", "substeps": 20}})");
  };
  EXPECT_EQ(
      warnings_at("1e-6"),
      std::vector<std::string>{"test.json: simulation.substeps: 20: may be too few for velocity_verlet here: its linear stability limit "
                               "is 528 substeps per frame where the listed forces are strongest; 14,385 are recommended, which take about "
                               "719 times as long"});
  for (const char* strength : {"1e-3", "1", "1000"})
    EXPECT_EQ(
        warnings_at(strength),
        std::vector<std::string>{"test.json: simulation.integrator: velocity_verlet: needs more than 1,000,000 substeps per frame here"})
        << strength;
}

TEST(SceneFile, UnknownKeysAreReportedAndKept) {
  const std::string text = R"({"hooke": 1, "mine": {"big": 12345678901234567890123, "list": [1, {"a": null}]},
    "points": [{"position": [0, 0, 0], "label": "A"}, {"position": [1, 0, 0], "label": "B\n"}],
    "springs": [{"points": [0, 1], "stiffness": 1, "material": "steel"}],
    "colliders": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.5, "glossy": true}],
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

}  // namespace
}  // namespace hooke
