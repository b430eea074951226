// Spring families: which ones a cloth has, and how they are tuned and switched.
#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <set>

#include "base/errors.h"
#include "edit/command.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/forces.h"
#include "support/parse_text.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr std::array families{SpringFamily::Structural, SpringFamily::Shear, SpringFamily::Bend};

// 5 x 4 points in square cells.
Scene cloth(const std::string& members) {
  return parse(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [4, 0, 0], "down": [0, -3, 0],
    "points": [5, 4], )" +
               members + "}]}");
}

std::array<Index, 3> count(const Scene& scene) {
  std::array<Index, 3> counts{};
  for (std::size_t f = 0; f < 3; ++f) counts[f] = scene.system.count_of(families[f]);
  return counts;
}

TEST(Stencil, DeterminesTheFamilies) {
  constexpr Index structural = 4 * 4 + 5 * 3, shear = 2 * 4 * 3, bend = 3 * 4 + 5 * 2;
  EXPECT_EQ(count(cloth(R"("stiffness": 8, "stencil": 4)")), (std::array{structural, 0, 0}));
  EXPECT_EQ(count(cloth(R"("stiffness": 8, "stencil": 8)")), (std::array{structural, shear, 0}));
  EXPECT_EQ(count(cloth(R"("stiffness": 8, "stencil": 12)")), (std::array{structural, shear, bend}));
  // without a stencil: the families that have a stiffness
  EXPECT_EQ(count(cloth(R"("stiffness": 8)")), (std::array{structural, shear, 0}));
  EXPECT_EQ(count(cloth(R"("stiffness": 8, "shear_stiffness": 0, "bend_stiffness": 1)")), (std::array{structural, 0, bend}));
  // with a stencil: also those of zero stiffness, to be tuned later
  EXPECT_EQ(count(cloth(R"("stiffness": 8, "stencil": 12, "shear_stiffness": 0, "bend_stiffness": 0)")),
            (std::array{structural, shear, bend}));
}

TEST(Stencil, GivesEachFamilyItsOwnStiffness) {
  const auto k_of = [](const Scene& scene, SpringFamily family) {
    std::set<double> stiffnesses;
    for (const Spring& spring : scene.system.springs())
      if (spring.family == family) stiffnesses.insert(spring.stiffness);
    return stiffnesses;
  };
  const Scene default_value = cloth(R"("stiffness": 8, "stencil": 12, "mass_model": "equal")");
  EXPECT_EQ(k_of(default_value, SpringFamily::Structural), std::set{8.0});
  EXPECT_EQ(k_of(default_value, SpringFamily::Shear), std::set{4.0});
  EXPECT_EQ(k_of(default_value, SpringFamily::Bend), std::set{4.0});
  const Scene own = cloth(R"("stiffness": 8, "stencil": 12, "shear_stiffness": 3, "bend_stiffness": 2, "mass_model": "equal")");
  EXPECT_EQ(k_of(own, SpringFamily::Shear), std::set{3.0});
  EXPECT_EQ(k_of(own, SpringFamily::Bend), std::set{2.0});
}

TEST(Stencil, IsRefusedIfItLacksAFamilyThatHasAStiffness) {
  const auto refusal = [](const std::string& members) -> std::string {
    try {
      cloth(members);
      return "";
    } catch (const InputError& refused) {
      return refused.what();
    }
  };
  EXPECT_NE(refusal(R"("stiffness": 8, "stencil": 6)").find("generators[0].stencil: 6: must be 4, 8 or 12"), std::string::npos);
  EXPECT_NE(refusal(R"("stiffness": 8, "stencil": 4, "shear_stiffness": 1)").find("must have a stencil of 8 or 12"), std::string::npos);
  EXPECT_NE(refusal(R"("stiffness": 8, "stencil": 8, "bend_stiffness": 1)").find("must have a stencil of 12"), std::string::npos);
}

TEST(Families, AreReadBackFromAFileWithTheirSwitches) {
  Scene scene = cloth(R"("stiffness": 8, "stencil": 12)");
  scene.state.position[0].z = 1.0;  // no longer as generated, so everything is listed
  scene.system.switches.families = {true, true, false, false};
  const std::string text = format_scene(scene);
  EXPECT_EQ(text.find("generators"), std::string::npos);
  EXPECT_EQ(parse(text).system, scene.system);
  EXPECT_THROW(parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0]}, {"position": [1, 0, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 1, "family": "diagonal"}]})"),
               InputError);
}

// A cloth with a stencil of twelve, deformed, and the same cloth without the springs of one family.
TEST(Families, SwitchedOffBehaveAsIfAbsent) {
  for (const SpringFamily family : families) {
    Scene off = cloth(R"("stiffness": 8, "damping": 0.5, "stencil": 12)");
    for (Index i = 0; i < off.system.point_count(); ++i) {
      off.state.position[i] += 0.1 * Vec3(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i));
      off.state.velocity[i] = Vec3(std::cos(2.0 * i), std::sin(11.0 * i), std::cos(13.0 * i));
    }
    Scene without = off;
    std::vector<Spring> kept = without.system.springs();
    std::erase_if(kept, [&](const Spring& spring) { return spring.family == family; });
    without.system.set_springs(kept);
    off.system.switches.families[static_cast<std::size_t>(family)] = false;

    EXPECT_NEAR(compute_energy(off.system, off.state).total(), compute_energy(without.system, without.state).total(), 1e-12);
    EXPECT_NEAR(bound_spectrum(off.system).omega, bound_spectrum(without.system).omega, 1e-12);
    for (const Integrator& method : integrators()) {
      TestSim a{off.system, off.state}, b{without.system, without.state};
      a.run(method, 0.02, 4);
      b.run(method, 0.02, 4);
      for (Index i = 0; i < a.system.point_count(); ++i) {
        // two of the methods process springs one after the other, and therefore in a different order
        const double slack = method.id == "xpbd" ? 1e-3 : 1e-4;
        EXPECT_LT(glm::distance(a.state.position[i], b.state.position[i]), slack) << method.id;
      }
    }
  }
}

TEST(Families, AreTunedBySeparateSlidersAndUndone) {
  Scene scene = cloth(R"("stiffness": 8, "stencil": 12)");
  const System before = scene.system;
  Effect effect;
  const auto inverse = apply(scene, SetParameter{find_parameter("shear_stiffness"), 77.0}, effect);
  EXPECT_TRUE(effect.values);
  for (Index s = 0; s < scene.system.spring_count(); ++s) {
    const Spring& spring = scene.system.springs()[s];
    EXPECT_EQ(spring.stiffness, spring.family == SpringFamily::Shear ? 77.0 : before.springs()[s].stiffness);
  }
  EXPECT_EQ(find_parameter("shear_stiffness")->read(scene), 77.0);
  for (const Command& command : inverse) apply(scene, command, effect);
  EXPECT_EQ(scene.system, before);

  const auto back = apply(scene, SetParameter{find_parameter("bend_springs"), 0.0}, effect);
  EXPECT_FALSE(scene.system.switches.families[static_cast<std::size_t>(SpringFamily::Bend)]);
  for (const Command& command : back) apply(scene, command, effect);
  EXPECT_EQ(scene.system, before);
}

TEST(Families, HaveRowsOnlyWhereSuchSpringsExist) {
  const auto applies = [](const Scene& scene, const char* name) { return find_parameter(name)->applies(scene); };
  const Scene net = cloth(R"("stiffness": 8, "stencil": 4)"), empty = empty_scene();
  EXPECT_TRUE(applies(net, "structural_stiffness"));
  EXPECT_TRUE(applies(net, "structural_springs"));
  EXPECT_FALSE(applies(net, "shear_stiffness"));
  EXPECT_FALSE(applies(net, "bend_springs"));
  EXPECT_FALSE(applies(empty, "structural_stiffness"));
}

}  // namespace
}  // namespace hooke
