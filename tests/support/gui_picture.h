// Pictures of the window of a GuiFixture, for visual inspection.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "batch/offscreen.h"
#include "draw/view.h"
#include "support/gui_fixture.h"

namespace hooke {

// Writes a frame as NAME.png to the folder that the environment variable HOOKE_PICTURES names; does nothing without it. `build`: the frame.
template <class Build>
void save_picture(GuiFixture& gui, std::string name, const Build& build) {
  const char* folder = std::getenv("HOOKE_PICTURES");
  if (folder == nullptr) return;
  std::ranges::replace(name, ' ', '_');
  std::ranges::replace(name, '/', '_');
  const Offscreen offscreen;
  View view;
  view.upload_fonts();
  build();
  ViewOptions options = gui.app().view_options();
  const Rect& scene = gui.app().layout().scene;
  options.place = {static_cast<int>(scene.x), static_cast<int>(scene.y), static_cast<int>(scene.width), static_cast<int>(scene.height)};
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  view.draw(*gui.status().snapshot, gui.app().marks(), gui.app().camera(), options, static_cast<int>(size.x), static_cast<int>(size.y),
            ImGui::GetDrawData());
  write_png(view.read(), std::filesystem::path(folder) / (name + ".png"));
}

}  // namespace hooke
