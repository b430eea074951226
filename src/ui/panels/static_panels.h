// The window's panels around a picture that nobody touches: the same as in the window, without one.
#pragma once

#include <filesystem>

#include "study/forecast.h"
#include "ui/panels.h"

struct ImDrawData;

namespace hooke {

// Owns ImGui's context; one at a time.
class StaticPanels {
 public:
  // For a picture of so many pixels, with these switches of the view and at its scale. The fonts are ready to be uploaded.
  StaticPanels(int width, int height, const ViewOptions& view);
  ~StaticPanels();
  StaticPanels(const StaticPanels&) = delete;
  StaticPanels& operator=(const StaticPanels&) = delete;

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
