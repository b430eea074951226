// Texts of the window, in terms that users know from other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "formats/scene_file.h"
#include "support/document_fixture.h"
#include "support/gui_fixture.h"
#include "support/two_springs.h"
#include "ui/text.h"

namespace hooke {
namespace {

// On one line.
std::string text_of(GuiFixture& gui) {
  std::string text = gui.text();
  std::ranges::replace(text, '\n', ' ');
  return text;
}
bool is_shown_later(GuiFixture& gui, const std::string& text) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (text_of(gui).find(text) == std::string::npos)
    if (std::chrono::steady_clock::now() > until) return false;
  return true;
}
testing::AssertionResult shows(GuiFixture& gui, const std::string& text) {
  const std::string all = text_of(gui);
  if (all.find(text) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << text << " is not in " << all;
}

TEST(Wording, OfTheHintsBelowTheSliders) {
  Scene scene = load_scene(find_scene("cloth")).scene;
  scene.settings.integrator = &default_integrator();
  scene.settings.substeps = 40;
  GuiFixture gui(scene);
  EXPECT_TRUE(shows(gui, "\u03c9h = 1.7, 84 % of the limit"));
}

// Of two springs that oscillate equally fast, with different dashpots.
TEST(Wording, OfADampingRatioThatDiffers) {
  TestSim sim;
  for (const double x : {0.0, 1.0}) sim.join(sim.nail({x, 0.0, 0.0}), sim.add({x, -0.5, 0.0}), 100.0, 0.5, 1.0 + x);
  sim.system.gravity = Vec3(0.0);
  GuiFixture gui(flat_scene("Two dampers", sim));
  EXPECT_TRUE(is_shown_later(gui, "varies between parts")) << gui.text();
}

TEST(Wording, OfTheTimeThatSomethingTakes) {
  EXPECT_EQ(milliseconds_text(57.3), "57 ms");
  EXPECT_EQ(milliseconds_text(0.0391), "0.039 ms");
  EXPECT_EQ(milliseconds_text(1e-7), "0 ms");
  EXPECT_EQ(milliseconds_text(1234.0), "1234 ms");
}

TEST(Wording, OfTooltips) {
  GuiFixture gui(two_points());
  gui.find("side", {"stiffness", "##value"});
  gui.frames(2);
  EXPECT_TRUE(shows(gui, "right-click resets to 100 N/m."));
  gui.find("side", {"reading", "##choice"});
  gui.frames(2);
  EXPECT_TRUE(shows(gui, "a finer mesh behaves differently."));
}

TEST(Wording, OfTheSearchThatFindsNothing) {
  GuiFixture gui(two_points());
  gui.key(letter('P'), {.control = true, .shift = true});
  gui.type("no such thing");
  EXPECT_TRUE(shows(gui, "No matching command"));
}

TEST(Wording, OfTheKeysForTheSpeed) {
  EXPECT_EQ(shortcut_of(Action::Slower).text, "Half speed");
  EXPECT_EQ(shortcut_of(Action::Faster).text, "Double speed");
}

TEST(Wording, OfSavingAndRecording) {
  const DocumentFixture fixture;
  GuiFixture gui = fixture.open();
  std::ofstream(fixture.folder / "other.json") << "{}";
  gui.key(letter('S'), {.control = true, .shift = true});
  gui.frames(2);
  EXPECT_FALSE(shows(gui, "A file with this name"));
  // the field is created anew, since the one that has the keyboard keeps its text
  gui.app().panels().dialog.typed = (fixture.folder / "other.json").string();
  ++gui.app().panels().dialog.text_version;
  gui.frames(2);
  EXPECT_TRUE(shows(gui, "A file with this name exists"));
  EXPECT_TRUE(shows(gui, "Replace"));
  gui.key(Key::Escape);

  gui.key(letter('R'), {.control = true, .shift = true});
  gui.key(letter('R'), {.control = true, .shift = true});
  EXPECT_TRUE(shows(gui, "Recording saved to "));

  gui.unnail(0);
  gui.app().handle(CloseRequest{});
  gui.frames(2);
  EXPECT_TRUE(shows(gui, "Save changes to \"net\"?"));
}

TEST(Wording, OfAnEmptyFolderNamesWhatTheDialogLists) {
  const ScratchFolder folder;
  std::ofstream(folder.folder / "cloth.hookelog") << "a recording, which is opened but not saved over";
  GuiFixture gui(two_points());
  gui.app().panels().open_file_dialog(Dialog::Kind::Save, folder.folder);
  gui.frames(3);
  EXPECT_TRUE(shows(gui, "No folders or scenes here."));
  gui.app().panels().open_file_dialog(Dialog::Kind::Open, folder.folder);
  gui.frames(3);
  EXPECT_TRUE(shows(gui, "cloth.hookelog"));
}

// ImGui shows such a character as U+FFFD, and would write that into the name of a file.
TEST(Wording, OfNamesKeepsEmojiInTextFields) {
  std::string name = "a \U0001F388 \U0001F389.json", pasted = "a";
  {
    const RareCharacters kept(name), none(pasted);
    EXPECT_EQ(name, "a \ufffd \ufffd.json") << "with the length that is drawn";
    name.insert(5, " 2");
    pasted += " \ufffd";
  }
  EXPECT_EQ(name, "a \U0001F388 2 \U0001F389.json");
  EXPECT_EQ(pasted, "a \ufffd");
}

// A method with the error of the reference has no place on a logarithmic axis, but is no failure.
TEST(Wording, OfMethodsThatAreNotInTheChart) {
  GuiFixture gui(two_springs());
  MethodComparison compared;
  for (const Integrator& method : integrators())
    if (method.id != "explicit_euler")
      compared.record.rows.push_back({.method = std::string(method.id),
                                      .setting = "960 steps/s",
                                      .step = 1.0 / 960.0,
                                      .error = method.id == "dop853" ? 0.0 : 1e-3,
                                      .relative_error = 1e-3,
                                      .cpu_ms_per_s = 1.0,
                                      .status = "ok"});
  gui.app().panels().shown.comparison = true;
  for (int frame = 0; frame < 2; ++frame) {
    ImGui::NewFrame();
    PanelInput input = gui.app().panel_input({});
    input.results.comparison.result = std::make_shared<const MethodComparison>(compared);
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
  }
  std::string text = read_text(*ImGui::GetDrawData());
  std::ranges::replace(text, '\n', ' ');
  EXPECT_NE(text.find("The same as the reference: Dormand-Prince 8(5,3)"), std::string::npos) << text;
  EXPECT_NE(text.find("unstable here: Explicit Euler"), std::string::npos) << text;
}

}  // namespace
}  // namespace hooke
