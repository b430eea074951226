// Fields of forces that are refused.
#include <gtest/gtest.h>

#include "formats/scene_file.h"

namespace hooke {
namespace {

// The message of the reader; empty if it accepts the damping time.
std::string refusal_of(const std::string& damping_time) {
  try {
    parse_scene(R"({"hooke": 1, "forces": [{"type": "bending", "damping_time": )" + damping_time + "}]}", "bad.json");
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

// With 1e20 s, the masses are lost in the rounding of the matrices of implicit methods: bodies did not fall.
TEST(BadForces, ADampingTimeOfBendingThatDrownsMassesIsRefused) {
  EXPECT_EQ(refusal_of("1e20"), "bad.json: forces[0].damping_time: 1e+20: must be from 0 to 1000000");
  EXPECT_EQ(refusal_of("-1"), "bad.json: forces[0].damping_time: -1: must be from 0 to 1000000");
  for (const char* valid : {"0", "1e-200", "1e6"}) EXPECT_EQ(refusal_of(valid), "") << valid;
}

}  // namespace
}  // namespace hooke
