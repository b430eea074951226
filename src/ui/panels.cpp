#include "ui/panels.h"

#include <algorithm>

#include "ui/widgets.h"

namespace hooke {

void build_panels(const Desk& desk, Panels& panels, Requests& requests) {
  use_look(panels.look);
  if (!ImGui::IsAnyItemActive()) panels.edit_in_progress = false;
  panels.floating.clear();
  build_menu(desk, panels, requests);
  build_status_bar(desk);
  if (panels.gallery.is_shown) {
    build_gallery(desk, panels, requests);
  } else {
    if (!panels.panels_hidden) {
      build_toolbar(desk, requests);
      build_side(desk, panels, requests);
    }
    build_plots(desk, panels, requests);
    build_timeline(desk, panels, requests);
    build_overlays(desk, panels, requests);
    build_axes(desk, panels, requests);
    build_placing(desk, panels);
  }
  build_export(desk, panels);
  build_keys(desk, panels);
  build_search(desk, panels, requests);
  build_dialogs(desk, panels, requests);
  panels.text_in_progress = ImGui::GetIO().WantTextInput && ImGui::IsAnyItemActive();
}

bool panels_cover(const Panels& panels, const Layout& layout, double x, double y) {
  if (!layout.scene.contains(x, y)) return true;
  if (panels.dialog.kind != Dialog::Kind::None || ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
    return true;
  return std::ranges::any_of(panels.floating, [&](const Rect& panel) { return panel.contains(x, y); });
}

}  // namespace hooke
