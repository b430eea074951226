#include "ui/panels.h"

#include <algorithm>

#include "ui/widgets.h"

namespace hooke {

Request::Request(const Request&) = default;
Request::Request(Request&&) noexcept = default;
Request& Request::operator=(const Request&) = default;
Request& Request::operator=(Request&&) noexcept = default;
Request::~Request() = default;

void build_panels(const PanelInput& input, Panels& panels, Requests& requests) {
  use_look(panels.look);
  // the keyboard moves the focus only where keys are not shortcuts
  const bool moves_focus = panels.dialog.kind != Dialog::Kind::None || panels.menus.is_open || panels.export_state.is_shown;
  int& flags = ImGui::GetIO().ConfigFlags;
  flags = moves_focus ? flags | ImGuiConfigFlags_NavEnableKeyboard : flags & ~ImGuiConfigFlags_NavEnableKeyboard;
  if (!ImGui::IsAnyItemActive()) panels.field.edit_in_progress = false, panels.field.tuned_from.reset();
  panels.shown.floating.clear();
  panels.plots.time_under_mouse = std::exchange(panels.plots.next_time_under_mouse, std::nullopt);
  build_menu(input, panels, requests);
  build_status_bar(input);
  if (panels.gallery.is_shown) {
    build_gallery(input, panels, requests);
  } else {
    if (panels.shown.panels) {
      build_toolbar(input, requests);
      build_side(input, panels, requests);
    }
    panels.plots.table.is_shown ? build_part_table(input, panels, requests) : build_plots(input, panels, requests);
    build_timeline(input, panels, requests);
    build_overlays(input, panels, requests);
    build_axes(input, panels, requests);
    build_placement(input, panels, requests);
    build_accuracy(input, panels, requests);
    build_comparison(input, panels, requests);
    build_result_check(input, panels, requests);
    build_ghosts(input, panels, requests);
    build_times(input, panels);
    build_messages(input, panels);
  }
  build_export(input, panels, requests);
  build_keys(input, panels);
  build_search(input, panels, requests);
  build_dialogs(input, panels, requests);
  if (const std::string hint = missing_font(); !hint.empty()) panels.show_toast(hint);
  panels.field.text_in_progress = ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive();
}

int PanelInput::presses(PanelKey::Target target, Key key) const {
  return static_cast<int>(std::ranges::count_if(keys, [&](const PanelKey& each) { return each.target == target && each.key == key; }));
}

void close_on_escape(const PanelInput& input, Panels& panels) {
  panels.menus.is_open = input.presses(PanelKey::Target::Menu, Key::Escape) == 0;
  if (!panels.menus.is_open) ImGui::CloseCurrentPopup();
}

bool panels_cover(const Panels& panels, const Layout& layout, double x, double y) {
  if (!layout.scene.contains(x, y)) return true;
  if (panels.dialog.kind != Dialog::Kind::None || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
    return true;
  return std::ranges::any_of(panels.shown.floating, [&](const Rect& panel) { return panel.contains(x, y); });
}

}  // namespace hooke
