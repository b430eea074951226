// A panel about the scene that is over it or in place of the side panel. Its content scrolls where it has no room, and its buttons stay
// below it.
#pragma once

#include "ui/panels.h"

namespace hooke {

inline constexpr double accuracy_panel_width = 360.0;  // [design units]

// The width of a panel at the left edge of the scene [design units]: less than desired beside the panel of the accuracy, as long as that
// leaves enough for it.
double left_panel_width(const PanelInput& input, const Panels& panels, double desired);

class DockedPanel {
 public:
  // Begins the panel; what is built before begin_content stays above the content.
  DockedPanel(const char* name, const Dock& dock, Panels& panels);
  ~DockedPanel();
  DockedPanel(const DockedPanel&) = delete;
  DockedPanel& operator=(const DockedPanel&) = delete;

  void begin_content();
  // The buttons follow, in one line.
  void end_content();

 private:
  Dock dock_;
};

}  // namespace hooke
