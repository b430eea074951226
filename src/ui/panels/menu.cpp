// The menu bar: menus, run buttons, undo and redo, the clock.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "base/printable.h"
#include "formats/scene_file.h"
#include "formats/texture.h"
#include "ui/panels.h"
#include "ui/text.h"
#include "ui/widgets.h"

namespace hooke {
namespace {

std::string detail_of(Needs needs, const Status& status) {
  return needs == Needs::UndoStep ? status.history.undo_name : needs == Needs::RedoStep ? status.history.redo_name : std::string();
}

bool is_met(Needs needs, const PanelInput& input) {
  switch (needs) {
    case Needs::Nothing:
    case Needs::Scene:
      return true;
    case Needs::Selection:
      return !input.selection.empty();
    case Needs::Space:
      return input.status.snapshot->system->dimensions == 3;
    case Needs::UndoStep:
    case Needs::RedoStep:
      return !detail_of(needs, input.status).empty();
  }
  return true;
}

void item(const ActionRow& row, const PanelInput& input, Requests& requests) {
  const std::string detail = detail_of(row.needs, input.status);
  const std::string label = std::string(row.text) + (detail.empty() ? "" : ": " + detail);
  const std::string keys = key_text(row.keys.chords[0]);
  if (ImGui::MenuItem(label.c_str(), keys.c_str(), false, is_met(row.needs, input))) requests.emplace_back(row.action);
}

// The items of some sections of a menu, with separators. Returns false if there are none.
bool sections(Menu menu, int first, int last, const PanelInput& input, Requests& requests) {
  bool any = false;
  for (int section = first; section <= last; ++section) {
    bool is_first = true;
    for (const ActionRow& row : actions()) {
      if (row.position.menu != menu || row.position.section != section) continue;
      if (std::exchange(is_first, false) && std::exchange(any, true)) ImGui::Separator();
      item(row, input, requests);
    }
  }
  return any;
}
constexpr int last_section = 9;

void recent_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  const bool is_open = ImGui::BeginMenu("Open recent", !input.recent.empty());
  panels.menus.on_submenu = ImGui::IsItemFocused();
  if (!is_open) return;
  for (const std::filesystem::path& file : input.recent) {
    ImGui::PushID(file.c_str());
    follow_text(file.native());
    if (ImGui::MenuItem(printable(file.filename().native(), 40).c_str())) requests.emplace_back(OpenFile{file});
    tooltip(printable(file.native()));
    ImGui::PopID();
  }
  ImGui::EndMenu();
}

void file_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  sections(Menu::File, 1, 1, input, requests);
  recent_menu(input, panels, requests);
  ImGui::Separator();
  sections(Menu::File, 2, last_section, input, requests);
}

void scenes_of_group(std::string_view group, const PanelInput& input, Requests& requests) {
  text_in(palette::accent, std::string(group));
  for (const ShippedScene& scene : shipped_scenes()) {
    if (scene.group != group) continue;
    ImGui::PushID(scene.id.c_str());
    const std::string title = printable(scene.title);
    if (ImGui::Selectable(title.c_str(), input.file == scene.file, 0, {units(220.0), 0.0f})) requests.emplace_back(OpenFile{scene.file});
    ImGui::PopID();
  }
}

// Two columns of equal length: each group goes to the shorter one.
std::array<std::vector<std::string_view>, 2> groups_by_column() {
  std::array<std::vector<std::string_view>, 2> columns;
  std::array<std::ptrdiff_t, 2> lines{};
  std::string_view group;
  for (const ShippedScene& scene : shipped_scenes()) {
    if (scene.group == std::exchange(group, scene.group)) continue;
    const std::size_t column = lines[0] <= lines[1] ? 0 : 1;
    columns[column].push_back(group);
    lines[column] += 1 + std::ranges::count(shipped_scenes(), group, &ShippedScene::group);
  }
  return columns;
}

void scenes_menu(const PanelInput& input, Panels&, Requests& requests) {
  sections(Menu::Scenes, 1, last_section, input, requests);
  ImGui::Separator();
  const auto columns = groups_by_column();
  for (std::size_t column = 0; column < columns.size(); ++column) {
    if (column > 0) ImGui::SameLine(0.0f, units(24.0));
    ImGui::BeginGroup();
    for (const std::string_view group : columns[column]) scenes_of_group(group, input, requests);
    ImGui::EndGroup();
  }
}

void add_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  if (sections(Menu::Add, 1, last_section, input, requests)) ImGui::Separator();
  for (const ShapeKind& kind : placeable_shapes()) {
    if (ImGui::MenuItem((std::string(kind.label) + "...").c_str())) start_placement(&kind, input, panels, requests);
    tooltip(std::string(kind.description));
  }
  ImGui::Separator();
  if (ImGui::MenuItem("From a mesh...")) start_placement(nullptr, input, panels, requests);
  tooltip("An .obj file as cloth, or as an obstacle.");
  ImGui::Separator();
  for (const ColliderKind& kind : collider_kinds()) {
    if (ImGui::MenuItem((std::string(kind.label) + "...").c_str())) requests.emplace_back(StartPlacement{nullptr, false, &kind});
    tooltip(std::string(kind.description));
  }
}

void edit_menu(const PanelInput& input, Panels&, Requests& requests) { sections(Menu::Edit, 1, last_section, input, requests); }
void run_menu(const PanelInput& input, Panels&, Requests& requests) { sections(Menu::Run, 1, last_section, input, requests); }

// An item for each shipped texture, and one for another picture.
void texture_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  const std::string& now = input.status.document->view.texture;
  if (ImGui::MenuItem("None", nullptr, now.empty())) requests.emplace_back(ChooseTexture{});
  bool ships = now.empty();
  for (const ShippedTexture& texture : shipped_textures()) {
    const bool chosen = now == texture.id;
    ships = ships || chosen;
    if (ImGui::MenuItem(texture.title.data(), nullptr, chosen)) requests.emplace_back(ChooseTexture{std::string(texture.id)});
  }
  const std::string own = ships ? "Picture..." : "Picture: " + printable(now, 40) + "...";
  if (ImGui::MenuItem(own.c_str(), nullptr, !ships)) panels.open_dialog(Dialog::Kind::Texture, ships ? "" : now);
}

void view_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  sections(Menu::View, 1, 3, input, requests);
  ImGui::Separator();
  ImGui::MenuItem("Points", nullptr, &panels.view.points);
  ImGui::MenuItem("Springs", nullptr, &panels.view.springs);
  ImGui::MenuItem("Surface", nullptr, &panels.view.surface);
  ImGui::MenuItem("Strain colors", nullptr, &panels.view.strain_colors);
  ImGui::MenuItem("Springs as coils", nullptr, &panels.view.coils);
  ImGui::MenuItem("Shadows", nullptr, &panels.view.shadows);
  ImGui::Separator();
  ImGui::MenuItem("Velocity arrows", nullptr, &panels.view.velocities);
  ImGui::MenuItem("Force arrows", nullptr, &panels.view.forces);
  ImGui::MenuItem("Point numbers", nullptr, &panels.view.point_numbers);
  ImGui::Separator();
  ImGui::MenuItem("Colliders", nullptr, &panels.view.colliders);
  ImGui::MenuItem("Grid", nullptr, &panels.view.grid);
  ImGui::Separator();
  sections(Menu::View, 4, last_section, input, requests);
  if (input.status.snapshot->system->faces.empty()) return;
  ImGui::Separator();
  dim_text("Texture");
  texture_menu(input, panels, requests);
}

struct MenuRow {
  const char* name;
  void (*build)(const PanelInput& input, Panels& panels, Requests& requests);
};
constexpr MenuRow menus[] = {{"File", file_menu}, {"Scenes", scenes_menu}, {"Edit", edit_menu},
                             {"Add", add_menu},   {"Run", run_menu},       {"View", view_menu}};

// F10 or Alt opens the first menu; Left and Right go to the next one, Enter presses the item that has the focus.
const MenuRow* menu_of_keys(const PanelInput& input, Panels& panels) {
  if (std::exchange(panels.menus.opens_first, false)) return menus;
  if (!panels.menus.is_open) return nullptr;
  if (input.presses(PanelKey::Target::Menu, Key::Enter) > 0 && has_focused_item()) press_focused_item();
  const int turn = input.presses(PanelKey::Target::Menu, Key::Right) - input.presses(PanelKey::Target::Menu, Key::Left);
  if (turn == 0 || panels.menus.on_submenu || ImGui::GetCurrentContext()->OpenPopupStack.Size != 1) return nullptr;
  const auto open = std::ranges::find_if(menus, [](const MenuRow& menu) { return ImGui::IsPopupOpen(menu.name); });
  if (open == std::end(menus)) return nullptr;
  const auto count = std::ssize(menus);
  return &menus[((open - menus + turn) % count + count) % count];
}

// A flat button at x that opens the menu below it. Returns its width.
float build_one(const MenuRow& menu, float x, bool opens, const PanelInput& input, Panels& panels, Requests& requests) {
  const Rect& bar = input.layout.menu;
  const float width = ImGui::CalcTextSize(menu.name).x + units(18.0);
  ImGui::SetCursorScreenPos({x, static_cast<float>(bar.y) + units(5.0)});
  const bool is_open = ImGui::IsPopupOpen(menu.name);
  ImGui::PushStyleColor(ImGuiCol_Button, is_open ? palette::hovered : IM_COL32(0, 0, 0, 0));
  const bool clicked = ImGui::Button(menu.name, {width, units(28.0)});
  ImGui::PopStyleColor();

  // moving along the bar opens the next menu, as in other menu bars
  const bool sliding = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId) && panels.dialog.kind == Dialog::Kind::None &&
                       ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByPopup);
  if (clicked || opens || (sliding && !is_open)) ImGui::OpenPopup(menu.name);

  ImGui::SetNextWindowPos({x, static_cast<float>(bar.y + bar.height)});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {units(10.0), units(7.0)});
  if (ImGui::BeginPopup(menu.name, ImGuiWindowFlags_NoMove)) {
    // ImGui hides the focus of a menu that opens
    int& hidden = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("hidden"), 0);
    if (hidden = opens ? 3 : hidden; hidden > 0) --hidden, ImGui::GetCurrentContext()->NavDisableHighlight = false;
    menu.build(input, panels, requests);
    close_on_escape(input, panels);
    ImGui::EndPopup();
  }
  ImGui::PopStyleVar();
  return width;
}

// Centered above the scene if the menus leave space. Returns their right end.
float run_buttons(const PanelInput& input, float menus_end, Requests& requests) {
  struct Button {
    Action action;
    Icon icon;
    bool active, enabled;
    std::string detail;
  };
  const Status& status = input.status;
  const Button buttons[] = {
      {Action::GoToStart, Icon::Start, false, true, ""},
      {Action::RunOrPause, status.run.running ? Icon::Pause : Icon::Run, status.run.running, true, ""},
      {Action::StepOnce, Icon::Step, false, true, ""},
      {Action::Undo, Icon::Undo, false, !status.history.undo_name.empty(), status.history.undo_name},
      {Action::Redo, Icon::Redo, false, !status.history.redo_name.empty(), status.history.redo_name},
  };
  const ImVec2 size{units(36.0), units(30.0)};
  const Rect& scene = input.layout.scene;
  const float width = 5.0f * (size.x + units(4.0)) + units(14.0);
  float x = std::max(static_cast<float>(scene.x + 0.5 * scene.width) - 0.5f * width, menus_end + units(8.0));
  for (const Button& button : buttons) {
    if (button.action == Action::Undo) x += units(14.0);
    ImGui::SetCursorScreenPos({x, static_cast<float>(input.layout.menu.y) + units(4.0)});
    ImGui::PushID(static_cast<int>(button.action));
    if (icon_button("run", button.icon, size, button.active, button.enabled)) requests.emplace_back(button.action);
    tooltip(button.action, button.detail);
    ImGui::PopID();
    x += size.x + units(4.0);
  }
  return x;
}

void clock(const PanelInput& input, float buttons_end) {
  char text[48];
  std::snprintf(text, sizeof text, "t = %.2f s", input.status.snapshot->state.time);
  const float x = static_cast<float>(input.layout.menu.width) - ImGui::CalcTextSize(text).x - units(14.0);
  if (x < buttons_end) return;
  ImGui::SetCursorScreenPos({x, static_cast<float>(input.layout.menu.y) + units(11.0)});
  text_in(input.status.run.running ? palette::text : palette::dim, text);
}

}  // namespace

// What needs space asks first whether a flat scene may become 3-D.
void start_placement(const ShapeKind* shape, const PanelInput& input, Panels& panels, Requests& requests) {
  const bool needs_space = shape == nullptr || shape->is_3d_only;
  if (!needs_space || input.status.snapshot->system->dimensions == 3) {
    requests.emplace_back(StartPlacement{shape});
    return;
  }
  const std::string name = shape == nullptr ? "A mesh" : std::string(shape->label);
  panels.show_message("Make the scene 3-D?", name + " needs a 3-D scene, and this one is flat. What it contains stays where it is.",
                      {{"Make it 3-D", StartPlacement{shape, true}}, {"Cancel", CloseDialog{}}});
}

void build_menu(const PanelInput& input, Panels& panels, Requests& requests) {
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {units(6.0), 0.0f});
  begin_panel("menu", input.layout.menu, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  ImGui::GetWindowDrawList()->AddLine({0.0f, static_cast<float>(input.layout.menu.height) - 1.0f},
                                      {static_cast<float>(input.layout.menu.width), static_cast<float>(input.layout.menu.height) - 1.0f},
                                      palette::line);

  const MenuRow* opened = menu_of_keys(input, panels);
  panels.menus.is_open = panels.menus.on_submenu = false;
  float x = units(8.0);
  for (const MenuRow& menu : menus) x += build_one(menu, x, opened == &menu, input, panels, requests) + units(2.0);
  clock(input, run_buttons(input, x, requests));
  ImGui::End();
}

}  // namespace hooke
