// Lines of text: where they are broken, and where not.
#include <gtest/gtest.h>

#include <sstream>

#include "support/gui_fixture.h"
#include "ui/wrapped_text.h"

namespace hooke {
namespace {

class WrappedText : public testing::Test {
 protected:
  void SetUp() override { ImGui::NewFrame(); }
  void TearDown() override { ImGui::EndFrame(); }
  static float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }
  GuiFixture gui_;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(WrappedText, KeepsNumbersAndTheirUnitsTogetherAtEveryWidth) {
  const std::string text =
      "With 39716 substeps and k = 49.05 N/m, turned by 30 degrees, the weight sags by 0.5 m, 2.5 times as far; d = 0.05 N s/m gives 3 % "
      "in 12 ms (5 kg). Up to 10 \u03bcm, 9.81 "
      "m/s^2.";
  for (float width = 112.0f; width < 900.0f; width += 3.0f) {
    const auto lines = lines_of(wrapped(text, width));
    std::string again;
    for (const std::string& line : lines) {
      EXPECT_LE(width_of(line), width) << line;
      for (const char* unit : {"m", "N/m", "%", "ms", "kg", "s/m", "\u03bcm", "m/s", "substeps", "degrees"})
        EXPECT_NE(line.find(unit), 0u) << line << " at " << width;
      again += (again.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(again, text) << width;
  }
}

TEST_F(WrappedText, BreaksAWordOnlyWhereItIsWiderThanALine) {
  const std::string path = "/home/student/scenes/a_folder_with_a_long_name/\u00fcbung.json";
  for (float width = 1.0f; width < 500.0f; width += 7.0f) {
    std::string again;
    for (const std::string& line : lines_of(wrapped(path, width))) again += line;
    EXPECT_EQ(again, path);
  }
  EXPECT_EQ(wrapped("one two", width_of("one ") + width_of("tw")), "one\ntwo");
}

TEST_F(WrappedText, KeepsLineBreaksAndTheSpacesWithinALine) {
  EXPECT_EQ(wrapped("Undo   Ctrl+Z\n\nand more", 1000.0f), "Undo   Ctrl+Z\n\nand more");
  EXPECT_EQ(wrapped("", 10.0f), "");
}

TEST_F(WrappedText, OfTooManyLinesEndsWithAnEllipsisThatFits) {
  const std::string text = "one two three four five six seven eight nine ten";
  EXPECT_EQ(wrapped(text, 1000.0f, 1), text);
  for (float width = 60.0f; width < 300.0f; width += 5.0f) {
    const std::string some = wrapped(text, width, 2);
    const auto lines = lines_of(some);
    EXPECT_LE(lines.size(), 2u);
    for (const std::string& line : lines) EXPECT_LE(width_of(line), width);
    EXPECT_EQ(some.ends_with(" ..."), lines_of(wrapped(text, width)).size() > 2u) << width;
  }
}

}  // namespace
}  // namespace hooke
