#include "lab/crossing_finder.h"

#include <utility>

namespace hooke {

void CrossingFinder::follow(const Status& status) {
  const Snapshot& now = *status.snapshot;
  const bool is_edited = now.system != system_, is_moved = now.state.time != time_;
  const bool is_switched = now.system->contact != contact_;
  const std::size_t count = now.system->points().size() + now.system->springs().size() + now.system->faces.size();
  const bool has_more = count > std::exchange(parts_, count);
  // nailed and held points can force what contact keeps apart
  const bool is_forced = is_moved && status.run.crossings > 0;
  if (!is_switched && !is_forced && !(found_ && is_moved) && !has_more && !(is_edited && !status.run.running)) return;
  system_ = now.system;
  contact_ = now.system->contact;
  time_ = now.state.time;
  auto parts = std::make_shared<const CrossedParts>(find_crossed_parts(*now.system, now.state));
  found_ = parts->empty() ? nullptr : std::move(parts);
}

}  // namespace hooke
