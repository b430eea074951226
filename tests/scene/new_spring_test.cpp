// The laws of springs that the tools add.
#include <gtest/gtest.h>

#include "scene/spring_laws.h"

namespace hooke {
namespace {

TEST(NewSprings, OfEveryLawAreValidAtAnyLength) {
  for (std::size_t i = 0; i < new_springs.size(); ++i)
    for (const double length : {0.0, 1e-3, 25.0}) {
      const Spring spring{.stiffness = 300.0, .rest_length = length, .law = new_spring_law(static_cast<int>(i), 300.0, length)};
      EXPECT_EQ(error_of(spring).limit, "") << new_springs[i].id << " " << length;
    }
}

TEST(NewSprings, HaveTheLawOfTheirName) {
  EXPECT_FALSE(new_spring_law(0, 100.0, 0.5));
  for (std::size_t i = 1; i < spring_forces.size(); ++i)
    EXPECT_EQ(new_spring_law(static_cast<int>(i), 100.0, 0.5)->force, static_cast<SpringForce>(i));
  // twice the force of a linear spring at a strain of 1
  EXPECT_EQ(response_of(*new_spring_law(3, 100.0, 0.5), 100.0, 0.5).tension, 2.0 * 100.0 * 0.5);
  EXPECT_TRUE(new_spring_law(4, 100.0, 0.5)->moves());
  EXPECT_LT(rest_length_at(*new_spring_law(5, 100.0, 0.5), 0.5, 3.0).length, 0.5);
  EXPECT_EQ(rest_length_at(*new_spring_law(5, 100.0, 0.5), 0.5, 100.0).length, 0.1);
}

}  // namespace
}  // namespace hooke
