// The last frames as they were, to be gone back to. Only what moves is kept, and as a number what had torn (Scene::tears): going
// back mends that, and changes no edit; the past ends where points were added or taken away.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>

#include "sim/state.h"

namespace hooke {

class Timeline {
 public:
  // Beyond this many moments, or bytes of them, the oldest are forgotten; the newest never.
  static constexpr std::size_t max_states = 2000, max_bytes = std::size_t{100} << 20;

  // The newest moment. Moments at its time or later are gone: from there it went on otherwise.
  void record(const State& state);
  void clear();

  bool empty() const { return states_.empty(); }
  std::size_t count() const { return states_.size(); }
  std::size_t bytes() const { return bytes_; }
  double first_time() const { return states_.front()->time; }
  double last_time() const { return states_.back()->time; }
  std::shared_ptr<const State> at(std::size_t moment) const { return states_[moment]; }
  // The moment at this time or the last before it; the first when all are later. There must be one.
  std::size_t find(double time) const;

 private:
  void drop(bool newest);

  std::deque<std::shared_ptr<const State>> states_;  // in the order of time
  std::size_t bytes_ = 0;
};

}  // namespace hooke
