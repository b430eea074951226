#include "lab/timeline.h"

#include <algorithm>

namespace hooke {
namespace {

std::size_t size_of(const State& state) { return sizeof(State) + (state.position.size() + state.velocity.size()) * sizeof(Vec3); }

}  // namespace

void Timeline::note(const State& state) {
  while (!empty() && last_time() >= state.time) drop(true);
  moments_.push_back(std::make_shared<const State>(state));
  bytes_ += size_of(state);
  while (count() > 1 && (count() > most_moments || bytes_ > most_bytes)) drop(false);
}

void Timeline::drop(bool newest) {
  bytes_ -= size_of(newest ? *moments_.back() : *moments_.front());
  newest ? moments_.pop_back() : moments_.pop_front();
}

void Timeline::clear() {
  moments_.clear();
  bytes_ = 0;
}

std::size_t Timeline::find(double time) const {
  const auto later = std::ranges::upper_bound(moments_, time, {}, [](const auto& state) { return state->time; });
  return later == moments_.begin() ? 0 : static_cast<std::size_t>(later - moments_.begin()) - 1;
}

}  // namespace hooke
