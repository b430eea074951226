// The checks of the shipped scenes fail without what the scene is about: contact, friction, bending, pressure and other forces.
#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "study/check_scene.h"

namespace hooke {
namespace {

struct Removal {
  const char *scene, *feature;
  const char* quantity;  // whose criterion fails
  double seconds = 0.0;  // simulated time after which it does; 0: all of the check
};

constexpr Removal removals[] = {
    {"marbles", "contact", "center_y"},
    {"marble_run", "contact", "center_y", 9.1},
    {"newtons_cradle", "contact", "x14"},
    {"reef_knot", "contact", "largest_strain"},
    {"reef_knot", "contact", "y29", 1.0},
    {"reef_knot", "contact", "y60", 1.0},
    {"folded_napkin", "contact", "crossings", 0.1},
    {"stacked_jelly", "contact", "crossings", 0.2},
    {"dominoes", "contact", "crossings", 0.2},
    {"bubble_raft", "contact", "crossings", 0.1},
    {"towel", "contact", "crossings", 0.4},
    {"jelly_cubes", "contact", "crossings", 0.6},
    {"hammock", "contact", "crossings", 0.4},
    {"cloth_on_ball", "contact", "crossings", 0.4},
    {"curtain", "contact", "crossings", 0.5},
    {"trampoline", "contact", "y0", 0.8},
    {"reef_knot", "contact friction", "largest_strain"},
    {"reef_knot", "contact friction", "y28"},
    {"reef_knot", "contact friction", "y29"},
    {"reef_knot", "contact friction", "y60"},
    {"dominoes", "contact friction", "x72"},
    {"paper", "bending", "lowest"},
    {"sheet_metal", "bending", "lowest"},
    {"balloon", "pressure", "largest_strain"},
    {"bouncing_ball", "pressure", "center_y"},
    {"soft_wheels", "pressure", "y20", 0.5},
    {"bubble_raft", "center", "x255", 1.1},
};
// Those that take seconds.
constexpr Removal slow_removals[] = {
    {"folded_napkin", "bending", "y216"},       {"stacked_jelly", "contact friction", "center_y"},
    {"tablecloth", "collider friction", "z26"}, {"gathered_curtain", "contact", "crossings", 0.6},
    {"balloon", "buoyancy", "center_y"},        {"tablecloth", "contact", "crossings", 0.4},
    {"gathered_curtain", "bending", "z573"},    {"bubble_raft", "pressure", "largest_strain"},
};

void remove(const std::string& feature, System& system) {
  if (feature == "contact")
    system.contact = {};
  else if (feature == "contact friction")
    system.contact.friction = 0.0;
  else if (feature == "collider friction")
    for (Collider& collider : system.colliders) collider.friction = 0.0;
  else
    ASSERT_GT(std::erase_if(system.forces, [&](const Force& force) { return force.term->id == feature; }), 0u);
}

class SceneFeatures : public testing::TestWithParam<Removal> {};

TEST_P(SceneFeatures, AreWhatTheCheckOfTheSceneProves) {
  const Removal& removal = GetParam();
  Scene scene = load_scene(find_scene(removal.scene)).scene;
  const System before = scene.system;
  remove(removal.feature, scene.system);
  ASSERT_FALSE(scene.system == before);
  SceneCheck check = check_of(scene);
  if (removal.seconds > 0.0) check.seconds = removal.seconds;
  check.methods.resize(1);
  for (const CheckResult& result : run_check(check, scene)) {
    EXPECT_FALSE(result.passed) << result.measured;
    EXPECT_NE(result.measured.find("FAILED: " + std::string(removal.quantity) + " "), std::string::npos) << result.measured;
  }
}

std::string name_of(const testing::TestParamInfo<Removal>& removal) {
  std::string name = std::string(removal.param.scene) + "_without_" + removal.param.feature + "_" + removal.param.quantity;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Shipped, SceneFeatures, testing::ValuesIn(removals), name_of);
INSTANTIATE_TEST_SUITE_P(Nightly, SceneFeatures, testing::ValuesIn(slow_removals), name_of);

}  // namespace
}  // namespace hooke
