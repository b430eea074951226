// The figures of the status bar and of the line about the error: what is left out where there is no room.
#include <gtest/gtest.h>

#include "lab/accuracy/accuracy_text.h"
#include "support/gui_sheets.h"
#include "support/two_springs.h"

namespace hooke {
namespace {

Accuracy measured(double frame, std::optional<double> total, std::optional<double> predictable) {
  Accuracy accuracy;
  accuracy.is_on = true;
  accuracy.frame.value = frame;
  accuracy.accumulated.value = total;
  accuracy.predictable.value = predictable;
  return accuracy;
}

TEST(AccuracyLines, LeaveOutThePredictabilityAndThenTheTotal) {
  EXPECT_EQ(accuracy_lines(measured(2.1e-5, 3e-4, INFINITY)),
            (std::vector<std::string>{"error 21 \u03bcm/frame, 300 \u03bcm in total, predictable",
                                      "error 21 \u03bcm/frame, 300 \u03bcm in total", "error 21 \u03bcm/frame"}));
  EXPECT_EQ(accuracy_lines(measured(2.1e-5, {}, {})), std::vector<std::string>{"error 21 \u03bcm/frame"});
  EXPECT_EQ(accuracy_line(measured(3e-14, 0.0, {})), "error < 1 pm/frame, 0 m in total");
  EXPECT_EQ(accuracy_line(measured(1e-9, 1.0, 2.0)), "error 1 nm/frame, 1 m in total, predictable for 2 s");
}

TEST(AccuracyLines, NameTheTimeOfATotalThatIsLate) {
  Accuracy accuracy = measured(1e-5, 7e-9, INFINITY);
  accuracy.frame_time = 2.1;
  accuracy.accumulated_time = 2.0;
  EXPECT_EQ(accuracy_line(accuracy), "error 10 \u03bcm/frame, 7 nm in total, predictable");
  accuracy.accumulated_time = 0.5;
  EXPECT_EQ(accuracy_line(accuracy), "error 10 \u03bcm/frame, 7 nm in total at 0.5 s, predictable");
}

std::string text_of(GuiFixture& gui, const Accuracy& accuracy, const char* window) {
  Status status = gui.status();
  status.accuracy = accuracy;
  const PanelInput shown = gui.app().panel_input({.frames_per_second = 60.0, .draw_ms = 1.0});
  const PanelInput input{.status = status,
                         .selection = shown.selection,
                         .layout = shown.layout,
                         .tool = shown.tool,
                         .file = {},
                         .frames_per_second = 60.0,
                         .draw_ms = 1.0};
  ImGui::NewFrame();
  Requests requests;
  build_panels(input, gui.app().panels(), requests);
  ImGui::Render();
  std::string text;
  for (const Sheet& sheet : read_sheets(*ImGui::GetDrawData()))
    for (const Letter& letter : sheet.letters)
      if (sheet.window == window) append_utf8(text, letter.code);
  return text;
}

bool has_text_in(const char* window, ImU32 color, const std::string& words) {
  std::string text;
  for (const Sheet& sheet : read_sheets(*ImGui::GetDrawData()))
    for (const Letter& letter : sheet.letters)
      if (sheet.window == window && letter.color == color) append_utf8(text, letter.code);
  return text.find(words) != std::string::npos;
}

TEST(StatusBar, TheLineAndThePanelHaveTheSameColorAndWords) {
  GuiFixture gui(two_springs());
  gui.resize({2560.0, 1440.0}, 1.0);
  gui.app().panels().shown.accuracy = true;
  Accuracy bad = measured(1.4e-5, {}, INFINITY);
  bad.loss = Loss::Dissipated;
  bad.energy.change = -0.448;
  bad.energy.scale = 0.45;
  text_of(gui, bad, "status");
  EXPECT_TRUE(has_text_in("status", palette::bad, "motiondissipatedbythemethod:100%oftheenergy"));
  EXPECT_TRUE(has_text_in("side", palette::bad, "motiondissipated"));
  Accuracy doubtful = measured(2e-3, {}, INFINITY);
  text_of(gui, doubtful, "status");
  EXPECT_TRUE(has_text_in("status", palette::warning, "errorofaframe2mm"));
  EXPECT_TRUE(has_text_in("side", palette::warning, "frame"));
  text_of(gui, measured(1.4e-5, {}, 0.5), "status");
  EXPECT_TRUE(has_text_in("status", palette::dim, "14\u03bcm/frame"));
  EXPECT_TRUE(has_text_in("side", palette::dim, "14\u03bcm/frame"));
}

// A speed of the frames before is none of one that has been computed for seconds.
TEST(StatusBar, SaysHowLongAFrameHasBeenComputed) {
  GuiFixture gui(two_springs());
  Status status = gui.status();
  status.run.running = true;
  status.run.speed = 0.85;
  const PanelInput shown = gui.app().panel_input({});
  for (const double seconds : {0.1, 4.0}) {
    const PanelInput input{
        .status = status, .selection = shown.selection, .layout = shown.layout, .tool = shown.tool, .file = {}, .waiting_seconds = seconds};
    ImGui::NewFrame();
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
    const std::string text = read_text(*ImGui::GetDrawData());
    EXPECT_EQ(text.find("this frame: 4 s so far") != std::string::npos, seconds > 1.0) << text;
    EXPECT_EQ(text.find("0.85\u00d7 real time") != std::string::npos, seconds < 1.0) << text;
  }
}

// The error is what Hooke is for: everything else makes room for it.
TEST(StatusBar, ShowsTheErrorAtEveryWidth) {
  GuiFixture gui(two_springs());
  const Accuracy accuracy = measured(2.1e-5, 3e-4, INFINITY);
  for (const double width : {640.0, 700.0, 800.0, 1000.0, 1280.0, 2560.0}) {
    gui.resize({width, 450.0}, 1.0);
    for (const char* window : {"status", "side"}) {
      const std::string text = text_of(gui, accuracy, window);
      EXPECT_NE(text.find("21\u03bcm/frame"), std::string::npos) << width << ' ' << text;
      // nothing of it is cut
      EXPECT_EQ(text.find("frame..."), std::string::npos) << width << ' ' << text;
      EXPECT_EQ(text.find("intotal..."), std::string::npos) << width << ' ' << text;
    }
  }
  gui.resize({2560.0, 1440.0}, 1.0);
  EXPECT_NE(text_of(gui, accuracy, "status").find("300\u03bcmintotal,predictable"), std::string::npos);
}

}  // namespace
}  // namespace hooke
