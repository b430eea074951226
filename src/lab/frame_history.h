// The past of a run: states that can be returned to, and the values that the plots show. It is cleared when points are added or removed.
#pragma once

#include <vector>

#include "lab/timeline.h"
#include "lab/traces.h"

namespace hooke {

class FrameHistory {
 public:
  void clear();
  // Clears it unless the points are the same as before.
  void clear_if_points_changed(const System& system);
  // `continues`: the state follows from the one before it by a frame.
  void record(const System& system, const State& state, const Accuracy& accuracy, bool continues);
  // Sets the quantities to be measured; those of recorded states are computed with the current System.
  void watch(const std::vector<Quantity>& quantities, const System& system) { traces_.watch(quantities, timeline_, system); }

  // Index of the last recorded state before `time`; 0 if there is none. The timeline must not be empty.
  std::size_t step_back_from(double time) const;

  const Timeline& timeline() const { return timeline_; }
  std::shared_ptr<const TraceTable> traces() const { return traces_.table(); }

 private:
  Timeline timeline_;
  Traces traces_;
  std::vector<PointId> points_;
};

}  // namespace hooke
