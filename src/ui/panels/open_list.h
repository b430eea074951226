// Keys of an open list or menu.
#pragma once

#include <imgui.h>

#include "ui/panels.h"

namespace hooke {

// Within an open popup: it takes Esc, which closes it.
inline void close_on_escape(const PanelInput& input, Panels& panels) {
  panels.menus.is_open = input.presses(PanelKey::Target::Menu, Key::Escape) == 0;
  if (!panels.menus.is_open) ImGui::CloseCurrentPopup();
}

}  // namespace hooke
