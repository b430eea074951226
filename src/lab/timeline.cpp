#include "lab/timeline.h"

#include <algorithm>

namespace hooke {
namespace {

std::size_t bytes_of(const State& state) { return sizeof(State) + (state.position.size() + state.velocity.size()) * sizeof(Vec3); }

}  // namespace

void Timeline::record(const State& state, bool continues, double muscle_time) {
  while (!empty() && last_time() >= state.time) drop(true);
  states_.push_back({std::make_shared<const State>(state), continues, muscle_time});
  bytes_ += bytes_of(state);
  while (count() > 1 && (count() > max_states || bytes_ > max_bytes)) drop(false);
}

void Timeline::drop(bool newest) {
  bytes_ -= bytes_of(*(newest ? states_.back() : states_.front()).state);
  newest ? states_.pop_back() : states_.pop_front();
}

void Timeline::clear() {
  states_.clear();
  bytes_ = 0;
}

std::size_t Timeline::find(double time) const {
  const auto later = std::ranges::upper_bound(states_, time, {}, [](const Moment& moment) { return moment.state->time; });
  return later == states_.begin() ? 0 : static_cast<std::size_t>(later - states_.begin()) - 1;
}

}  // namespace hooke
