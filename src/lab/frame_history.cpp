#include "lab/frame_history.h"

namespace hooke {

void FrameHistory::clear() {
  timeline_.clear();
  traces_.clear();
}

void FrameHistory::clear_if_points_changed(const System& system) {
  std::vector<PointId> points;
  for (const Point& point : system.points()) points.push_back(point.id);
  if (points == points_) return;
  clear();
  points_ = std::move(points);
}

void FrameHistory::record(const System& system, const State& state, const Accuracy& accuracy, bool continues) {
  timeline_.record(state, continues, system.muscles.at(state.time));
  traces_.record(timeline_, system, state, accuracy);
}

std::size_t FrameHistory::step_back_from(double time) const {
  const std::size_t here = timeline_.find(time);
  const bool is_at_one = timeline_.at(here)->time == time;
  return here - (is_at_one && here > 0 ? 1 : 0);
}

}  // namespace hooke
