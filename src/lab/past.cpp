#include "lab/past.h"

namespace hooke {

void Past::clear() {
  timeline_.clear();
  traces_.clear();
}

void Past::keep_to(const System& system) {
  std::vector<PointId> points;
  for (const Point& point : system.points()) points.push_back(point.id);
  if (points == points_) return;
  clear();
  points_ = std::move(points);
}

void Past::note(const System& system, const State& state) {
  timeline_.note(state);
  traces_.note(timeline_, system, state);
}

std::size_t Past::step_back_from(double time) const {
  const std::size_t here = timeline_.find(time);
  const bool is_at_one = timeline_.at(here)->time == time;
  return here - (is_at_one && here > 0 ? 1 : 0);
}

}  // namespace hooke
