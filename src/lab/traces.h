// Quantities over time, for the plots: one value for each state of the timeline.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lab/timeline.h"
#include "scene/quantity.h"

namespace hooke {

struct Trace {
  Quantity quantity;
  std::vector<double> values;  // one for each time; NaN where the scene had no such point or spring
};

// What the plots show.
struct TraceTable {
  std::vector<double> times;            // [s], ascending
  std::vector<std::uint8_t> continues;  // one for each time; 0: the time jumped, and no line leads here
  std::vector<Trace> traces;
  std::vector<double> errors;  // [m], accumulated error at each time; NaN where it is not known
};

class Traces {
 public:
  // Sets the quantities to be measured; those of recorded states are computed with the given System, without what was
  // not kept: the accuracy.
  void watch(const std::vector<Quantity>& quantities, const Timeline& timeline, const System& system);
  // Measures the state that the timeline has just recorded.
  void record(const Timeline& timeline, const System& system, const State& state, const Accuracy& accuracy);
  void clear();

  // The same object until it changes.
  std::shared_ptr<const TraceTable> table() const;

 private:
  void add(const System& system, const State& state, const Accuracy* accuracy, bool continues);

  TraceTable table_;
  mutable std::shared_ptr<const TraceTable> published_;  // null: stale
};

// CSV: a heading with units, then one row for each time.
std::string to_csv(const TraceTable& table);

}  // namespace hooke
