// Finds the parts of the scene on screen that pass through each other or overlap, to highlight them.
#pragma once

#include <memory>

#include "lab/status.h"
#include "scene/crossed_parts.h"

namespace hooke {

class CrossingFinder {
 public:
  // Once per frame. Contact keeps apart what is apart: a run is searched only from a start in which something crosses, or from when parts
  // were added, such as by undo, or nailed or held points forced some through others, until nothing does.
  void follow(const Status& status);
  // Null: nothing crosses.
  const std::shared_ptr<const CrossedParts>& found() const { return found_; }

 private:
  std::shared_ptr<const System> system_;  // of the last search
  PairContact contact_;
  std::size_t parts_ = 0;  // points, springs and faces of the scene
  double time_ = 0.0;
  std::shared_ptr<const CrossedParts> found_;
};

}  // namespace hooke
