// A panel about the scene that is over it or in place of the side panel. Its content scrolls where it has no room, and its buttons stay
// below it.
#pragma once

#include "ui/panels.h"

namespace hooke {

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
