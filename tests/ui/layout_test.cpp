// The layout of the window at several sizes and scales, judged by the glyphs drawn: no text is clipped or overlaps, and the scene stays
// visible.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <regex>
#include <set>

#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "scene/shape.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "support/gui_fixture.h"
#include "support/gui_picture.h"
#include "support/gui_sheets.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// Windows that extend beyond the display.
std::set<std::string> outside() {
  std::set<std::string> found;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    if (!window->Active || window->Hidden || window->ParentWindow != nullptr || window->IsFallbackWindow) continue;
    const ImRect place = window->Rect();
    if (place.Min.x < -1.0f || place.Min.y < -1.0f || place.Max.x > size.x + 1.0f || place.Max.y > size.y + 1.0f)
      found.insert(std::string(window->Name) + " reaches out of the window");
  }
  return found;
}

// [pixels], for each window the height of its contents that the frame made room for, and that of what it drew.
std::vector<float> content_heights() {
  std::vector<float> heights;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active) heights.insert(heights.end(), {window->ContentSize.y, window->DC.CursorMaxPos.y - window->DC.CursorStartPos.y});
  return heights;
}

// Windows over the center of the scene.
std::set<std::string> over_the_scene(const Rect& scene) {
  std::set<std::string> found;
  const ImRect middle(static_cast<float>(scene.x + 0.25 * scene.width), static_cast<float>(scene.y + 0.25 * scene.height),
                      static_cast<float>(scene.x + 0.75 * scene.width), static_cast<float>(scene.y + 0.75 * scene.height));
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->Active && !window->Hidden && !window->IsFallbackWindow && window->Rect().Overlaps(middle)) found.insert(window->Name);
  return found;
}

// A cloth with everything that has a row: families, colliders, forces; a long name, and a nail.
Scene full_scene() {
  Scene scene = load_scene(find_scene("flag")).scene;
  scene.name = "A flag with quite a long name, as users choose them";
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  return scene;
}

TEST(LayoutFaults, AreDetectedInATestWindow) {
  GuiFixture gui;
  const auto faults_of = [](ImVec2 at, ImVec2 size) {
    ImGui::NewFrame();
    ImGui::SetNextWindowPos({10.0f, 10.0f});
    ImGui::SetNextWindowSize({200.0f, 60.0f});
    ImGui::Begin("planted", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoScrollbar);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect({10.0f, 10.0f}, {10.0f + size.x, 10.0f + size.y});
    list.AddText({20.0f, 20.0f}, IM_COL32_WHITE, "First words");
    list.AddText(at, IM_COL32_WHITE, "Second words");
    list.PopClipRect();
    ImGui::End();
    ImGui::Render();
    return faults(*ImGui::GetDrawData());
  };
  EXPECT_EQ(faults_of({20.0f, 40.0f}, {200.0f, 60.0f}), std::set<std::string>());
  EXPECT_EQ(faults_of({24.0f, 26.0f}, {200.0f, 60.0f}).size(), 1u);
  EXPECT_EQ(faults_of({20.0f, 40.0f}, {64.0f, 60.0f}), (std::set<std::string>{"planted: cut: Firstword", "planted: cut: Secondw"}));
  EXPECT_EQ(faults_of({20.0f, 40.0f}, {200.0f, 36.0f}), (std::set<std::string>{"planted: cut: Secondwords"}));
}

struct Place {
  double width, height, scale;
};
void PrintTo(const Place& place, std::ostream* out) { *out << place.width << "x" << place.height << " at scale " << place.scale; }

std::string name_of(const testing::TestParamInfo<Place>& info) {
  const auto whole = [](double number) { return std::to_string(static_cast<int>(number)); };
  return whole(info.param.width) + "x" + whole(info.param.height) + "at" + whole(info.param.scale);
}

class Layouts : public testing::TestWithParam<Place> {
 protected:
  // `words`: text that shows whether it is open
  void expect_in_order(GuiFixture& gui, const char* when, const char* words) {
    expect_in_order(gui, when, words, [&] { gui.frame(); });
  }
  template <class Build>
  void expect_in_order(GuiFixture& gui, const char* when, const char* words, const Build& build) {
    SCOPED_TRACE(when);
    resize(gui);
    for (int frame = 0; frame < 3; ++frame) build();
    // a measurement that ends now adds a line, which its window makes room for in the next frame
    std::vector<float> heights;
    for (int frame = 0; frame < 100 && heights != content_heights(); ++frame) {
      heights = content_heights();
      build();
    }
    EXPECT_EQ(heights, content_heights());
    EXPECT_NE(all_letters(*ImGui::GetDrawData()).find(without_spaces(words)), std::string::npos);
    EXPECT_EQ(faults(*ImGui::GetDrawData()), std::set<std::string>());
    EXPECT_EQ(split_quantities(*ImGui::GetDrawData()), std::set<std::string>());
    EXPECT_EQ(outside(), std::set<std::string>());
    // numbers for people have no "1.505e+05"; the random name of a temporary folder may have "4e3" in it
    EXPECT_FALSE(std::regex_search(read_text(*ImGui::GetDrawData()), std::regex("(^|[^A-Za-z0-9-])[0-9.]+e[+-]?[0-9]")))
        << read_text(*ImGui::GetDrawData());
    for (const Look look : {Look::Light, Look::Dark}) {
      gui.app().panels().look = look;
      build();
      save_picture(gui, name_of({GetParam(), 0}) + (look == Look::Light ? "_light_" : "_dark_") + when, build);
      EXPECT_EQ(faint_text(*ImGui::GetDrawData(), to_imgui(background_of(look))), std::set<std::string>())
          << (look == Look::Light ? "light" : "dark");
    }
  }
  // The buttons of a panel that places something are visible without scrolling, and its preview is not below it.
  static void expect_preview_beside_panel(GuiFixture& gui) {
    const ImGuiWindow& panel = *ImGui::FindWindowByName("placing");
    EXPECT_EQ(panel.ScrollMax.y, 0.0f);
    EXPECT_EQ(crop_of(panel, "PlaceCancel"), "");
    const Rect& scene = gui.app().layout().scene;
    const ImRect box = panel.Rect();
    int hidden = 0;
    for (const auto& [from, to] : gui.app().marks().ghost_lines)
      for (const Vec3& end : {from, to}) {
        const glm::dvec2 at = gui.seen(end);
        hidden += !scene.contains(at.x, at.y) || box.Contains({static_cast<float>(at.x), static_cast<float>(at.y)});
      }
    EXPECT_EQ(hidden, 0);
  }
  // What is missing in the letters that the window itself draws.
  static std::string crop_of(const ImGuiWindow& window, const std::string& words) {
    for (const Sheet& sheet : read_sheets(*ImGui::GetDrawData())) {
      std::string letters;
      for (const Letter& letter : sheet.letters)
        if (letter.is_seen()) append_utf8(letters, letter.code);
      if (sheet.window == window.Name) return letters.find(words) != letters.npos ? "" : words + " is not in " + letters;
    }
    return "no window";
  }
  void resize(GuiFixture& gui) { gui.resize({GetParam().width, GetParam().height}, GetParam().scale); }
};
INSTANTIATE_TEST_SUITE_P(Sizes, Layouts, testing::Values(Place{640, 420, 1}, Place{700, 450, 2}, Place{1280, 800, 1}, Place{1920, 1080, 2}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Nightly, Layouts,
                         testing::Values(Place{700, 450, 1}, Place{960, 600, 1}, Place{1280, 800, 2}, Place{2560, 1440, 1},
                                         Place{2560, 1440, 2}, Place{1280, 720, 0.75}, Place{1280, 720, 1}, Place{1920, 1080, 1},
                                         Place{1280, 720, 2}),
                         name_of);

TEST_P(Layouts, ThePanelsLeaveTheSceneVisibleAndTheirTextUnclipped) {
  GuiFixture gui(full_scene());
  resize(gui);
  expect_in_order(gui, "at the start", "Substeps");
  EXPECT_EQ(over_the_scene(gui.app().layout().scene), std::set<std::string>());
  gui.key(letter('P'));
  gui.app().handle(Request(Control(RunTo{0.25})));
  EXPECT_TRUE(gui.wait_for_end_of_run());
  expect_in_order(gui, "with plots", "Choose");
  EXPECT_EQ(over_the_scene(gui.app().layout().scene), std::set<std::string>());
  gui.key(letter('P'));
  gui.key(letter('A'), {.control = true});
  expect_in_order(gui, "with everything selected", "Selection");
  gui.app().panels().shown.panels = false;
  expect_in_order(gui, "without panels", "File");
  gui.key(Key::Escape);
  gui.app().panels().view.springs = gui.app().panels().view.strain_colors = true;
  expect_in_order(gui, "legend without panels", "Strain");
}

TEST_P(Layouts, DialogsAreWithinTheWindow) {
  GuiFixture gui(full_scene());
  resize(gui);
  Panels& panels = gui.app().panels();
  gui.key(Key::F1);
  expect_in_order(gui, "keys", "Select and move");
  gui.key(Key::Escape);
  gui.key(letter('P'), {.control = true, .shift = true});
  expect_in_order(gui, "search", "Attach two points");
  gui.key(Key::Escape);
  gui.key(letter('E'), {.control = true});
  expect_in_order(gui, "export", "Wavefront");
  gui.key(Key::Escape);
  for (const ShapeKind& kind : placeable_shapes()) {
    gui.app().handle(Request(StartPlacement{&kind}));
    expect_in_order(gui, kind.label.data(), kind.label.data());
    expect_preview_beside_panel(gui);
    gui.key(Key::Escape);
  }
  gui.app().handle(Request(StartPlacement{nullptr}));
  expect_in_order(gui, "mesh", "From a mesh");
  gui.key(Key::Escape);
  gui.key(letter('G'));
  expect_in_order(gui, "gallery", "Gallery");
  gui.key(Key::Escape);

  gui.key(letter('O'), {.control = true});
  expect_in_order(gui, "open", "Open scene");
  gui.key(Key::Escape);
  gui.key(letter('S'), {.control = true, .shift = true});
  expect_in_order(gui, "save", "Save scene as");
  gui.key(Key::Escape);
  panels.open_dialog(Dialog::Kind::Unsaved);
  expect_in_order(gui, "unsaved", "Discard");
  gui.key(Key::Escape);
  panels.show_message(
      "Cannot open the scene",
      "scene.json: points[17].mass: -1: must be more than 0. The scene that was open before is still open, and nothing is lost.");
  expect_in_order(gui, "message", "points[17]");
  gui.key(Key::Escape);
  panels.show_toast(
      "Stiffness of the springs between the flag and its pole must be between 0.01 and 1000000 N/m, which makes this a long line");
  expect_in_order(gui, "toast", "Stiffness of the springs");
  panels.banners.file_warnings =
      "flag.json: points[3].color: unknown, kept unchanged; the scene needs so many substeps that it will run slowly";
  expect_in_order(gui, "banner", "Dismiss");
}

// As "Compare methods" finds them, over more decades of time than usual.
MethodComparison compared_methods() {
  MethodComparison comparison;
  double cost = 1e-5;
  for (const Integrator& method : integrators())
    for (int i = 0; i < 4; ++i, cost *= 1.4)
      comparison.record.rows.push_back({.method = std::string(method.id),
                                        .setting = "960 steps/s",
                                        .step = 1.0 / (960.0 * (1 << i)),
                                        .error = 1e-2 / std::pow(8.0, i),
                                        .relative_error = 1e-3,
                                        .cpu_ms_per_s = cost,
                                        .status = "ok"});
  comparison.note = "Compared over 0.5 s: the motion cannot be predicted for 2 s.";
  return comparison;
}

// Accuracy, comparison, the lesson about accuracy, the banner.
TEST_P(Layouts, PanelsAboutErrorsAreReadable) {
  GuiFixture gui(load_scene(find_scene("how_wrong")).scene);
  resize(gui);
  expect_in_order(gui, "lesson", "How wrong is it");
  gui.app().handle(Request(Control(RunTo{0.5})));
  EXPECT_TRUE(gui.wait_for_end_of_run());
  gui.app().panels().shown.accuracy = true;
  expect_in_order(gui, "accuracy", "Error of a frame");
  gui.app().handle(Request(Control(SetAccuracy{AccuracyMode::Off})));
  gui.frames(2);
  expect_in_order(gui, "accuracy off", "Switched off");
  gui.app().panels().shown.accuracy = false;

  gui.app().panels().shown.comparison = true;
  ResultStatus<MethodComparison> comparison;
  const auto build = [&] {
    ImGui::NewFrame();
    PanelInput input = gui.app().panel_input({});
    input.results.comparison = comparison;
    Requests requests;
    build_panels(input, gui.app().panels(), requests);
    ImGui::Render();
  };
  expect_in_order(gui, "comparison", "Nothing compared yet", build);
  comparison = {.is_running = true, .fraction = 0.0, .seconds = 12.0};
  expect_in_order(gui, "comparison reference", "for 12 s so far", build);
  comparison = {
      .is_running = true, .fraction = 0.4, .seconds = 12.0, .result = std::make_shared<const MethodComparison>(compared_methods())};
  expect_in_order(gui, "comparison in progress", "Measuring the methods", build);
  comparison.is_running = false;
  expect_in_order(gui, "comparison result", "Again", build);
}

TEST_P(Layouts, TheBannerOfAFailedRunIsReadable) {
  Scene scene = full_scene();
  scene.settings.substeps = 1;
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s)->stiffness = 1e7;
  GuiFixture gui(scene);
  resize(gui);
  gui.key(Key::Space);
  EXPECT_TRUE(gui.wait_until([&] { return !gui.status().diagnosis.message.empty(); }));
  expect_in_order(gui, "banner", "The simulation blew up");
}

TEST_P(Layouts, EveryMenuIsReadable) {
  GuiFixture gui(full_scene());
  resize(gui);
  const std::pair<const char*, const char*> menus[] = {{"File", "Save as"},       {"Scenes", "Flag in the wind"}, {"Edit", "Paste"},
                                                       {"Add", "Chain of links"}, {"Run", "Back to start"},       {"View", "Frame all"}};
  for (const auto& [menu, line] : menus) {
    const Rect& bar = gui.app().layout().menu;
    const ImGuiID id = ImHashStr(menu, 0, ImGui::FindWindowByName("menu")->ID);
    for (double x = 4.0; x < bar.width; x += 8.0) {
      gui.move({x, bar.y + 0.5 * bar.height});
      if (ImGui::GetCurrentContext()->HoveredId != id) continue;
      gui.click({x, bar.y + 0.5 * bar.height});
      break;
    }
    gui.frames(3);
    expect_in_order(gui, menu, line);
    gui.key(Key::Escape);
    gui.frames(2);
  }
}

// WCAG AA: 4.5 for text. Each color of text on each ground that it is drawn on.
TEST(Contrast, OfAllTextIsSufficientInBothThemes) {
  GuiFixture gui;
  for (const Look look : {Look::Dark, Look::Light}) {
    use_look(look);
    SCOPED_TRACE(look == Look::Dark ? "dark" : "light");
    using namespace palette;
    for (const ImU32 ground : {panel, raised, hovered, box, tinted, alarm, notice, shade}) EXPECT_GE(contrast(text, ground), 4.5);
    for (const ImU32 ground : {panel, raised, hovered, box, tinted, shade}) EXPECT_GE(contrast(dim, ground), 4.5);
    // values and keys beside them
    for (const ImU32 ink : {accent, good, warning, bad}) EXPECT_GE(contrast(ink, panel), 4.5);
    // graphics without text: 3
    for (const ImU32 axis : {axis_x, axis_y, axis_z}) EXPECT_GE(contrast(axis, panel), 3.0);
    for (const ImU32 ink : inks) EXPECT_GE(contrast(ink, box), 3.0);
  }
}

TEST_P(Layouts, EveryTooltipIsWithinTheWindowAndUnclipped) {
  GuiFixture gui(full_scene());
  resize(gui);
  // over the side panel, the tools and the menu bar, where everything explains itself
  const Layout& layout = gui.app().layout();
  std::set<std::string> found;
  std::set<std::pair<ImGuiID, float>> seen;
  for (const Rect& panel : {layout.side, layout.tools, layout.menu, layout.timeline})
    for (double y = panel.y + 4.0; y < panel.y + panel.height; y += 14.0 * GetParam().scale)
      for (const double fraction : {0.1, 0.45, 0.75, 0.95}) {
        gui.move({panel.x + fraction * panel.width, y});
        const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
        if (tip == nullptr || !tip->Active || !seen.insert({ImGui::GetCurrentContext()->HoveredId, tip->ContentSize.x}).second) continue;
        gui.frames(2);
        for (const std::string& fault : outside()) found.insert(fault);
        for (const std::string& fault : faults(*ImGui::GetDrawData()))
          if (fault.starts_with("##Tooltip")) found.insert(fault);
        for (const Look look : {Look::Light, Look::Dark}) {
          gui.app().panels().look = look;
          gui.frame();
          found.merge(faint_text(*ImGui::GetDrawData(), to_imgui(background_of(look))));
        }
      }
  EXPECT_EQ(found, std::set<std::string>());
}

TEST(Labels, OfRowsFitBesideTheirFields) {
  GuiFixture gui(full_scene());
  const auto check = [](std::string_view label) {
    constexpr float column = 132.0f - 14.0f;
    const ImFont& small = *fonts().small;
    const float width = small.CalcTextSizeA(small.FontSize, FLT_MAX, 0.0f, label.data(), label.data() + label.size()).x;
    EXPECT_LE(width, column) << label;
  };
  for (const Parameter& row : parameters()) check(row.label);
  for (const ShapeKind& kind : placeable_shapes())
    for (const ShapeNumber& number : kind.numbers) check(number.label);
  for (const ForceTerm& term : force_terms())
    for (const ForceParameter& number : term.numbers) check(number.label);
}

TEST(AnySizeOfTheWindow, IsHandled) {
  GuiFixture gui(full_scene());
  const auto try_all = [&](const glm::dvec2& size) {
    for (const double scale : {1.0, 2.0}) {
      gui.resize(size, scale);
      for (const auto& [key, modifiers] : {std::pair{letter('P'), Modifiers{}},
                                           {Key::F1, {}},
                                           {letter('E'), {.control = true}},
                                           {letter('G'), {}},
                                           {letter('O'), {.control = true}}}) {
        gui.key(key, modifiers);
        gui.resize(size, scale);
        gui.key(Key::Escape);
      }
    }
  };
  for (const glm::dvec2& size : {glm::dvec2(1, 1), {1, 900}, {900, 1}, {3, 7}, {120, 80}, {8000, 8000}, {8000, 40}}) {
    SCOPED_TRACE(testing::Message() << size.x << " x " << size.y);
    try_all(size);
    for (const Vec3& x : gui.status().snapshot->state.position) ASSERT_TRUE(std::isfinite(x.x + x.y + x.z));
  }
  gui.resize({1280.0, 720.0}, 1.0);
  EXPECT_NE(gui.text().find("Substeps"), std::string::npos);
}

}  // namespace
}  // namespace hooke
