// Positions of the panels and the scene in the window. The scene gets the space that the panels leave.
#pragma once

#include <algorithm>

namespace hooke {

// In window coordinates, origin at the top left.
struct Rect {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  bool contains(double px, double py) const { return px >= x && py >= y && px < x + width && py < y + height; }
  bool operator==(const Rect&) const = default;
};

struct Layout {
  Rect menu, tools, side, plots, timeline, status, scene;
  Rect legend;  // of strains, in place of that in the side panel
  Rect page;    // everything between the menu bar and the status bar
};

// What is shown besides the menu bar and the status bar.
struct Shown {
  bool panels = true, plots = false;
  bool strain_legend = false;  // without the panels
};

// The scale, limited so that the panels have room in a small window.
inline double fitting_scale(double scale, double width, double height) {
  constexpr double min_width = 640.0, min_height = 360.0, min_scale = 0.75;  // [design units]
  return std::min(scale, std::max(min_scale, std::min(width / min_width, height / min_height)));
}

// `scale`: window units per design unit (1 on a screen without scaling).
inline Layout lay_out(double width, double height, double scale, Shown shown = {}) {
  const double menu = 38.0 * scale, tools = shown.panels ? 74.0 * scale : 0.0, status = 28.0 * scale;
  const double side = shown.panels ? std::min(336.0 * scale, 0.45 * width) : 0.0;
  const double middle = std::max(1.0, height - menu - status);
  // only if there is space
  const double timeline = shown.panels && middle > 200.0 * scale ? 30.0 * scale : 0.0;
  const double plots = shown.panels && shown.plots && middle > 280.0 * scale ? std::clamp(0.3 * middle, 120.0 * scale, 260.0 * scale) : 0.0;
  const double legend = !shown.panels && shown.strain_legend && middle > 200.0 * scale && width > 240.0 * scale ? 30.0 * scale : 0.0;
  const double scene_width = std::max(1.0, width - tools - side), scene_height = middle - timeline - plots - legend;
  return {
      .menu = {0.0, 0.0, width, menu},
      .tools = {0.0, menu, tools, middle},
      .side = {width - side, menu, side, middle},
      .plots = {tools, menu + scene_height, scene_width, plots},
      .timeline = {tools, menu + scene_height + plots, scene_width, timeline},
      .status = {0.0, menu + middle, width, status},
      .scene = {tools, menu, scene_width, scene_height},
      .legend = {tools, menu + scene_height, scene_width, legend},
      .page = {0.0, menu, width, middle},
  };
}

// Where a panel about the scene may be: at the left or right edge of the scene, as high as its content, or in place of the side panel where
// the scene would have no room beside it.
struct Dock {
  Rect place;
  bool is_over_scene;
};
// `width`: of the panel; `min_scene`: of the scene, below which the panel takes the place of the side panel [design units].
inline Dock dock_panel(const Layout& layout, double scale, double width, double min_scene, bool at_right = false) {
  constexpr double edge = 14.0, min_height = 320.0;  // [design units]
  const Rect& scene = layout.scene;
  if (layout.side.width > 0.0 && scene.width < min_scene * scale) return {layout.side, false};
  const double wide = std::min(width * scale, std::max(1.0, scene.width - 2.0 * edge * scale));
  const double x = at_right ? scene.x + scene.width - wide - edge * scale : scene.x + edge * scale;
  // over plots and the timeline only where the scene is low
  const double height = scene.height > min_height * scale ? scene.height : layout.page.height;
  return {{x, scene.y + edge * scale, wide, std::max(1.0, height - 2.0 * edge * scale)}, true};
}
inline Dock placement_dock(const Layout& layout, double scale) { return dock_panel(layout, scale, 310.0, 620.0); }

}  // namespace hooke
