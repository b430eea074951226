// The window's panels around a picture that nobody touches: the same as in the window, without one.
#pragma once

#include <filesystem>

#include "lab/forecast.h"
#include "ui/panels.h"

struct ImDrawData;

namespace hooke {

// Owns ImGui's context; one at a time.
class StillPanels {
 public:
  // For a picture of so many pixels, with these switches of the view and at its scale. The fonts are ready to be uploaded.
  StillPanels(int width, int height, const ViewOptions& view);
  ~StillPanels();
  StillPanels(const StillPanels&) = delete;
  StillPanels& operator=(const StillPanels&) = delete;

  const Layout& layout() const { return layout_; }
  // As they look at this status, the scene being seen by this camera. Valid until the next call.
  const ImDrawData* build(const Status& status, const Camera& camera, const std::filesystem::path& file);

 private:
  Layout layout_;
  Panels panels_;
  Forecast forecast_;
  Selection selection_;
};

}  // namespace hooke
