// The states of the latest frames. Only State is kept, with tears as an index (Scene::tears): returning to a state undoes later tears but
// no edits. The timeline is cleared when points are added or removed.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>

#include "sim/model/state.h"

namespace hooke {

class Timeline {
 public:
  // Beyond this many states or bytes the oldest are discarded, but never the newest.
  static constexpr std::size_t max_states = 2000, max_bytes = std::size_t{100} << 20;

  // Appends a state. States at its time or later are discarded: the run continues differently from there. `continues`: it follows from the
  // state before it by a frame of the simulation. `muscle_time`: that of the muscles (MuscleClock).
  void record(const State& state, bool continues = true, double muscle_time = 0.0);
  void clear();

  bool empty() const { return states_.empty(); }
  std::size_t count() const { return states_.size(); }
  std::size_t bytes() const { return bytes_; }
  double first_time() const { return states_.front().state->time; }
  double last_time() const { return states_.back().state->time; }
  std::shared_ptr<const State> at(std::size_t moment) const { return states_[moment].state; }
  // Whether it follows from the state before it: false after a jump in time.
  bool continues(std::size_t moment) const { return states_[moment].continues; }
  double muscle_time(std::size_t moment) const { return states_[moment].muscle_time; }
  // Index of the last state at or before this time; 0 if all are later. The timeline must not be empty.
  std::size_t find(double time) const;

 private:
  struct Moment {
    std::shared_ptr<const State> state;
    bool continues;
    double muscle_time;
  };
  void drop(bool newest);

  std::deque<Moment> states_;  // in ascending order of time
  std::size_t bytes_ = 0;
};

}  // namespace hooke
