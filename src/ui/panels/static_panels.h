// The panels of the window, without a window or input, around a picture that is written to a file.
#pragma once

#include <filesystem>

#include "study/forecast.h"
#include "ui/panels.h"

struct ImDrawData;

namespace hooke {

// Owns the context of ImGui; one at a time.
class StaticPanels {
 public:
  // For a picture of this size [px], with these view options. Afterwards the fonts are ready for upload.
  StaticPanels(int width, int height, const ViewOptions& view);
  ~StaticPanels();
  StaticPanels(const StaticPanels&) = delete;
  StaticPanels& operator=(const StaticPanels&) = delete;

  const Layout& layout() const { return layout_; }
  // The panels for this status and camera. Valid until the next call.
  const ImDrawData* build(const Status& status, const Camera& camera, const std::filesystem::path& file);

 private:
  Layout layout_;
  Panels panels_;
  Forecast forecast_;
  Selection selection_;
};

}  // namespace hooke
