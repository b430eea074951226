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
  struct Shown {
    bool panels = true;     // false: only the stamp
    bool accuracy = false;  // the panel of the accuracy
  };
  // For a picture of this size [px], with these view options. Afterwards the fonts are ready for upload.
  StaticPanels(int width, int height, const ViewOptions& view, Shown shown);
  ~StaticPanels();
  StaticPanels(const StaticPanels&) = delete;
  StaticPanels& operator=(const StaticPanels&) = delete;

  const Layout& layout() const { return layout_; }
  // The panels for this status and camera, and a line of text in a corner of the scene; the marks in it, null: none. Valid until the next
  // call.
  const ImDrawData* build(const Status& status, const Camera& camera, const std::filesystem::path& file, const std::string& stamp,
                          const Marks* marks = nullptr);

 private:
  Layout layout_;
  bool has_panels_;
  Panels panels_;
  Forecast forecast_;
  Selection selection_;
};

}  // namespace hooke
