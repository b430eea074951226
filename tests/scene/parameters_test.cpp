// The table of parameters reads what it writes.
#include "scene/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/control/automatic.h"
#include "support/small_net.h"

namespace hooke {
namespace {

TEST(Parameters, ThatOtherModulesReferToAreRowsOfTheTable) {
  EXPECT_EQ(&substeps_parameter, find_parameter("substeps"));
  EXPECT_EQ(&stiffness_parameter, find_parameter("stiffness"));
  EXPECT_EQ(&dimensions_parameter, &parameters()[0]);
}

TEST(Parameters, ReadBackWhatWasWrittenWithinTheirRange) {
  Scene scene = small_net();
  // springs of every family
  std::vector<Spring> springs = scene.system.springs();
  for (std::size_t s = 0; s < springs.size(); ++s) springs[s].family = static_cast<SpringFamily>(s % spring_families);
  springs[0].law = SpringLaw{.amplitude = 0.1};
  scene.system.set_springs(springs);
  scene.sheet = std::make_shared<const SheetWeights>(
      SheetWeights{std::vector<double>(scene.system.points().size(), 0.3), std::vector<double>(springs.size(), 0.7)});
  for (const Parameter& parameter : parameters()) {
    scene.system.contact.points = true;
    bool applies = parameter.applies == nullptr;
    for (int parameterization = 3; parameterization >= 0; --parameterization) {
      scene.parameterization = static_cast<SpringParameterization>(parameterization);
      applies = applies || parameter.applies(scene);
    }
    for (const Integrator* method : {&automatic_method(), find_integrator("projective_dynamics")}) {
      scene.settings.integrator = method;
      applies = applies || parameter.applies(scene);
    }
    scene.settings.integrator = &default_integrator();
    EXPECT_TRUE(applies) << parameter.name;
    for (const double value : {parameter.min, parameter.max, parameter.default_value}) {
      parameter.write(scene, value);
      EXPECT_NEAR(parameter.read(scene), value, 1e-12 * std::abs(value)) << parameter.name;
    }
    EXPECT_EQ(clamp_to_range(parameter, -INFINITY), parameter.min) << parameter.name;
    EXPECT_EQ(clamp_to_range(parameter, INFINITY), parameter.max) << parameter.name;
    EXPECT_EQ(clamp_to_range(parameter, NAN), parameter.default_value) << parameter.name;
    EXPECT_FALSE(parameter.description.empty());
    EXPECT_EQ(find_parameter(parameter.name), &parameter);
    parameter.write(scene, parameter.default_value);
  }
}

}  // namespace
}  // namespace hooke
