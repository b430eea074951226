// Scene checks: each law passes and fails where it should; quantities have the values that their names promise.
#include "study/check_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "formats/scene_file.h"
#include "scene/quantity.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

// One mass on a spring of k = 4 pi^2 without gravity, released 0.1 m from equilibrium: it oscillates with period 1 s.
std::string swinging(const std::string& check, double damping = 0.0) {
  return R"({"hooke": 1, "dimensions": 2, "gravity": [0, 0, 0],
    "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [1.1, 0, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 39.47841760435743, "rest_length": 1, "damping": )" +
         std::to_string(damping) + R"(}], "check": )" + check + "}";
}

std::vector<CheckResult> results(const std::string& check, double damping = 0.0) {
  return check_scene(parse_scene(swinging(check, damping), "swinging").scene);
}
bool holds(const std::string& law, double damping = 0.0) {
  return results(R"({"seconds": 3, "laws": [)" + law + "]}", damping).at(0).passed;
}

TEST(SceneChecks, EachLawPassesAndFailsWhereItShould) {
  EXPECT_TRUE(holds(R"({"law": "constant", "of": "total", "within": 1e-4})"));
  EXPECT_FALSE(holds(R"({"law": "constant", "of": "total", "within": 1e-4})", 0.5));
  EXPECT_TRUE(holds(R"({"law": "never_rises", "of": "total", "within": 1e-4})", 0.5));
  EXPECT_FALSE(holds(R"({"law": "never_rises", "of": "kinetic", "within": 1e-4})"));
  EXPECT_TRUE(holds(R"({"law": "period", "of": "x1", "value": 1, "within": 0.001})"));
  EXPECT_FALSE(holds(R"({"law": "period", "of": "x1", "value": 1.01, "within": 0.001})"));
  EXPECT_TRUE(holds(R"({"law": "ends_at", "of": "x1", "value": 1.1, "within": 0.001})"));
  EXPECT_FALSE(holds(R"({"law": "ends_at", "of": "x1", "value": 1.09, "within": 0.001})"));
  EXPECT_TRUE(holds(R"({"law": "peaks_at", "of": "vx1", "value": 0.6283, "within": 0.001})"));
  EXPECT_FALSE(holds(R"({"law": "peaks_at", "of": "vx1", "value": 0.6, "within": 0.001})"));
  EXPECT_TRUE(holds(R"({"law": "between", "of": "strain0", "least": -0.1001, "most": 0.1001})"));
  EXPECT_FALSE(holds(R"({"law": "between", "of": "strain0", "least": -0.05})"));
  EXPECT_FALSE(holds(R"({"law": "between", "of": "strain0", "most": 0.05})"));
}

TEST(SceneChecks, TimesBeforeTheStartOfALawAreIgnored) {
  EXPECT_TRUE(holds(R"({"law": "between", "of": "length0", "most": 1.05, "from": 2})", 5.0));
  EXPECT_FALSE(holds(R"({"law": "between", "of": "length0", "most": 1.05})", 5.0));
  EXPECT_FALSE(holds(R"({"law": "between", "of": "length0", "most": 2, "from": 50})")) << "there is nothing to measure";
}

TEST(SceneChecks, EveryListedMethodIsRunWithItsSubsteps) {
  const auto tried = results(
      R"({"seconds": 3, "methods": ["runge_kutta4", {"method": "implicit_euler", "substeps": 3}], "laws": [{"law": "constant", "of": "total", "within": 1e-3}]})");
  ASSERT_EQ(tried.size(), 2u);
  EXPECT_EQ(tried[0].method->id, "runge_kutta4");
  EXPECT_TRUE(tried[0].passed) << tried[0].measured;
  EXPECT_EQ(tried[1].method->id, "implicit_euler");
  EXPECT_FALSE(tried[1].passed) << "it loses energy";
  EXPECT_NE(tried[1].measured.find("FAILED: total changes by"), std::string::npos) << tried[1].measured;
}

TEST(SceneChecks, ASceneWithoutAnyRunsForTwoSeconds) {
  const auto tried = check_scene(parse_scene(R"({"hooke": 1})", "bare").scene);
  ASSERT_EQ(tried.size(), 1u);
  EXPECT_TRUE(tried[0].passed);
}

TEST(SceneChecks, FailIfAnExpectedStopDoesNotOccur) { EXPECT_FALSE(results(R"({"stops": true})").at(0).passed); }

TEST(SceneChecks, FailIfTheyNameAMissingQuantity) { EXPECT_FALSE(holds(R"({"law": "ends_at", "of": "y7", "value": 0, "within": 1})")); }

std::string refusal(const std::string& check) {
  try {
    parse_scene(swinging(check), "x.json");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(SceneChecks, AreRefusedIfTheyAreInvalid) {
  EXPECT_EQ(refusal(R"({"laws": [{"law": "constant", "of": "total", "within": 1}]})"), "accepted");
  EXPECT_NE(refusal(R"({"laws": [{"law": "fair", "of": "total"}]})").find("check.laws[0].law: \"fair\": must be one of constant"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"laws": [{"law": "constant", "of": "beauty", "within": 1}]})").find("must have \"of\", one of time, kinetic"),
            std::string::npos);
  EXPECT_NE(refusal(R"({"laws": [{"law": "constant", "of": "total"}]})").find("must have within"), std::string::npos);
  EXPECT_NE(refusal(R"({"laws": [{"law": "between", "of": "total"}]})").find("must have least or most"), std::string::npos);
  EXPECT_NE(refusal(R"({"methods": ["luck"]})").find("check.methods[0]: \"luck\": must be the id of a method"), std::string::npos);
  EXPECT_NE(refusal(R"({"minutes": 1})").find("must be seconds, methods, laws or stops"), std::string::npos);
}

TEST(SceneChecks, ArePreservedInTheFile) {
  const std::string check = R"({"seconds": 3, "laws": [{"law": "constant", "of": "total", "within": 1e-4}]})";
  const std::string saved = format_scene(parse_scene(swinging(check), "first").scene);
  EXPECT_NE(saved.find(check), std::string::npos);
  EXPECT_EQ(format_scene(parse_scene(saved, "again").scene), saved);
}

TEST(ShippedScenes, EachHasACheck) {
  for (const ShippedScene& shipped : shipped_scenes()) {
    const SceneCheck check = check_of(load_scene(shipped.file).scene);
    EXPECT_TRUE(check.expects_divergence || !check.criteria.empty()) << shipped.id;
  }
}

TEST(Quantities, HaveTheValuesThatTheirNamesPromise) {
  const Scene scene = parse_scene(R"({"hooke": 1, "time": 3, "points": [{"position": [0, 1, 0], "nailed": true},
    {"position": [0, -2, 4], "velocity": [1, 2, 2], "mass": 2}], "springs": [{"points": [0, 1], "stiffness": 1, "rest_length": 4}],
    "colliders": [{"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0]}]})",
                                  "x")
                          .scene;
  const Measurement measured = measure(scene.system, scene.state);
  const auto value = [&](std::string_view name) { return find_quantity(name, 2, 1).value().of(measured); };
  EXPECT_EQ(value("time"), 3.0);
  EXPECT_EQ(value("kinetic"), 9.0);
  EXPECT_DOUBLE_EQ(value("elastic"), 0.5);
  EXPECT_DOUBLE_EQ(value("gravitational"), 2.0 * 9.81 * -2.0);
  EXPECT_DOUBLE_EQ(value("total"), 9.0 + 0.5 - 39.24);
  EXPECT_EQ(value("momentum_y"), 4.0);
  EXPECT_EQ(value("center_z"), 4.0);
  EXPECT_EQ(value("y1"), -2.0);
  EXPECT_EQ(value("vz1"), 2.0);
  EXPECT_EQ(value("length0"), 5.0);
  EXPECT_EQ(value("strain0"), 0.25);
  EXPECT_EQ(value("largest_strain"), 0.25);
  EXPECT_EQ(value("fastest"), 3.0);
  EXPECT_EQ(value("lowest"), -2.0);
  EXPECT_DOUBLE_EQ(value("depth"), 1.02);
  EXPECT_EQ(value("crossings"), 0.0);
  EXPECT_EQ(find_quantity("y1", 2, 1)->heading(), "y1 [m]");
}

TEST(Quantities, UnknownOnesAreNotFound) {
  for (const char* name : {"", "y", "y2", "total1", "strain1", "y-1", "y1x", "beauty", "y99999999999"})
    EXPECT_FALSE(find_quantity(name, 2, 1)) << name;
}

}  // namespace
}  // namespace hooke
