// Fields of forces that are refused.
#include <gtest/gtest.h>

#include "base/bounds.h"
#include "formats/scene_file.h"
#include "sim/forces/force_terms.h"

namespace hooke {
namespace {

Scene scene_with_force(std::string_view type, std::string_view name, const std::string& value) {
  return parse_scene(R"({"hooke": 1, "forces": [{"type": ")" + std::string(type) + R"(", ")" + std::string(name) + "\": " + value + "}]}",
                     "bad.json")
      .scene;
}

// The message of the reader; empty if it accepts the value.
std::string refusal_of(std::string_view type, std::string_view name, const std::string& value) {
  try {
    scene_with_force(type, name, value);
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

// With 1e20 s, the masses are lost in the rounding of the matrices of implicit methods: bodies did not fall.
TEST(BadForces, ADampingTimeOfBendingThatDrownsMassesIsRefused) {
  const auto refusal = [](const std::string& value) { return refusal_of("bending", "damping_time", value); };
  EXPECT_EQ(refusal("1e20"), "bad.json: forces[0].damping_time: 1e+20: must be from 0 to 1000000");
  EXPECT_EQ(refusal("-1"), "bad.json: forces[0].damping_time: -1: must be from 0 to 1000000");
  for (const char* valid : {"0", "1e-200", "1e6"}) EXPECT_EQ(refusal(valid), "") << valid;
}

// As docs/reference/scene-format.md says, of every number of every force.
TEST(BadForces, AFileMayExceedTheRangesOfTheSlidersExceptAMinimumOfZeroOrMore) {
  int refused = 0;
  for (const ForceTerm& term : force_terms())
    for (std::size_t i = 0; i < term.numbers.size(); ++i) {
      const ForceParameter& row = term.numbers[i];
      if (!row.choices.empty()) continue;
      const double above = 1.5 * row.max, below = row.min - 1.0;
      EXPECT_EQ(scene_with_force(term.id, row.name, format_exact(above)).system.forces.at(0).values[i], above)
          << term.id << ' ' << row.name;
      const std::string refusal = refusal_of(term.id, row.name, format_exact(below));
      EXPECT_EQ(refusal.empty(), row.min < 0.0) << term.id << ' ' << row.name;
      if (row.min < 0.0) continue;
      ++refused;
      const std::string expected = "bad.json: forces[0]." + std::string(row.name) + ": " + format_exact(below) + ": must be ";
      EXPECT_EQ(refusal.substr(0, expected.size()), expected);
    }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace hooke
