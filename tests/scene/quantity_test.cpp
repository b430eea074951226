#include "scene/quantity.h"

#include <gtest/gtest.h>

#include "support/test_sim.h"

namespace hooke {
namespace {

// Springs from a nail to nails at these distances [m], of a rest length of 1 m.
Measurement measure_springs(std::initializer_list<double> lengths) {
  static TestSim sim;
  sim = {};
  const PointId center = sim.nail(Vec3(0.0));
  for (const double length : lengths) sim.join(center, sim.nail({length, 0.0, 0.0}), 1.0, 1.0);
  return measure(sim.system, sim.state);
}

TEST(StrainRange, IsThatOfTheSpringsAlsoIfAllAreStretchedOrCompressed) {
  EXPECT_DOUBLE_EQ(measure_springs({1.5, 2.0}).min_strain, 0.5);
  EXPECT_DOUBLE_EQ(measure_springs({1.5, 2.0}).largest_strain, 1.0);
  EXPECT_DOUBLE_EQ(measure_springs({0.5, 0.75}).min_strain, -0.5);
  EXPECT_DOUBLE_EQ(measure_springs({0.5, 0.75}).largest_strain, -0.25);
  EXPECT_EQ(measure_springs({}).min_strain, 0.0);
}

}  // namespace
}  // namespace hooke
