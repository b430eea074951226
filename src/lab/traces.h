// Quantities over time, for the plots: as many moments as the timeline holds.
#pragma once

#include <memory>
#include <vector>

#include "lab/timeline.h"
#include "scene/quantity.h"

namespace hooke {

struct Trace {
  Quantity quantity;
  std::vector<double> values;  // one a moment; not a number where the scene had no such point or spring
};

// What the plots show.
struct TraceTable {
  std::vector<double> times;  // [s], ascending
  std::vector<Trace> traces;
};

class Traces {
 public:
  // What is measured from here on, and of the moments that are known, with the System as it is now.
  void watch(const std::vector<Quantity>& quantities, const Timeline& timeline, const System& system);
  // The newest moment, which the timeline has just noted.
  void record(const Timeline& timeline, const System& system, const State& state);
  void clear();

  // The same object until it changes.
  std::shared_ptr<const TraceTable> table() const;

 private:
  void add(const System& system, const State& state);

  TraceTable table_;
  mutable std::shared_ptr<const TraceTable> published_;  // null: stale
};

// CSV: a heading with units, then a row a moment.
std::string to_csv(const TraceTable& table);

}  // namespace hooke
