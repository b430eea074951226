// The past of a run: the moments that can be gone back to, and what was measured of them for the plots. It is that of the
// points that it was computed with: it ends where some are added or taken away.
#pragma once

#include <vector>

#include "lab/timeline.h"
#include "lab/traces.h"

namespace hooke {

class FrameHistory {
 public:
  void clear();
  // Forgets all of it unless the points are still the same.
  void clear_if_points_changed(const System& system);
  void record(const System& system, const State& state);
  // What is measured from here on, and of the moments that are known, with the System as it is now.
  void watch(const std::vector<Quantity>& quantities, const System& system) { traces_.watch(quantities, timeline_, system); }

  // The moment before `time`: the one at it or before it where there is none at that time. There must be one.
  std::size_t step_back_from(double time) const;

  const Timeline& timeline() const { return timeline_; }
  std::shared_ptr<const TraceTable> traces() const { return traces_.table(); }

 private:
  Timeline timeline_;
  Traces traces_;
  std::vector<PointId> points_;
};

}  // namespace hooke
