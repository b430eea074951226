#include "lab/traces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bounds.h"

namespace hooke {
namespace {

template <class T>
void drop_front(std::vector<T>& list, std::size_t count) {
  list.erase(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count));
}

// Erasing from the front of a vector moves the rest of it, so this many values are erased at once.
constexpr std::size_t drop_batch = 256;

}  // namespace

void Traces::watch(const std::vector<Quantity>& quantities, const Timeline& timeline, const System& system) {
  const auto is_same = [](const Trace& trace, const Quantity& quantity) { return trace.quantity.name() == quantity.name(); };
  if (std::ranges::equal(table_.traces, quantities, is_same)) return;
  table_ = {};
  published_.reset();
  for (const Quantity& quantity : quantities) table_.traces.push_back({quantity, {}});
  if (quantities.empty()) return;
  for (std::size_t moment = 0; moment < timeline.count(); ++moment) add(system, *timeline.at(moment), nullptr, timeline.continues(moment));
}

void Traces::record(const Timeline& timeline, const System& system, const State& state, const Accuracy& accuracy) {
  if (table_.traces.empty()) return;
  published_.reset();
  while (!table_.times.empty() && table_.times.back() >= state.time) {
    table_.times.pop_back();
    table_.errors.pop_back();
    table_.continues.pop_back();
    for (Trace& trace : table_.traces) trace.values.pop_back();
  }
  if (table_.times.size() >= timeline.count() + drop_batch) {
    drop_front(table_.times, drop_batch);
    drop_front(table_.errors, drop_batch);
    drop_front(table_.continues, drop_batch);
    for (Trace& trace : table_.traces) drop_front(trace.values, drop_batch);
  }
  add(system, state, &accuracy, timeline.continues(timeline.count() - 1));
}

void Traces::add(const System& system, const State& state, const Accuracy* accuracy, bool continues) {
  if (state.position.size() != system.points().size()) return;
  const Measurement measurement = measure(system, state, accuracy);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  table_.times.push_back(state.time);
  table_.errors.push_back(accuracy == nullptr ? unknown : accuracy->accumulated.value.value_or(unknown));
  table_.continues.push_back(continues ? 1 : 0);
  for (Trace& trace : table_.traces) {
    const QuantityRow& row = *trace.quantity.row;
    const Index count = row.of == QuantityRow::Of::Point    ? system.point_count()
                        : row.of == QuantityRow::Of::Spring ? system.spring_count()
                                                            : 1;
    trace.values.push_back(trace.quantity.at < count ? trace.quantity.of(measurement) : std::numeric_limits<double>::quiet_NaN());
  }
}

void Traces::clear() {
  published_.reset();
  table_.times.clear();
  table_.errors.clear();
  table_.continues.clear();
  for (Trace& trace : table_.traces) trace.values.clear();
}

std::shared_ptr<const TraceTable> Traces::table() const {
  if (!published_) published_ = std::make_shared<const TraceTable>(table_);
  return published_;
}

std::string to_csv(const TraceTable& table) {
  std::string text = "time [s]";
  for (const Trace& trace : table.traces) text += "," + trace.quantity.heading();
  text += "\n";
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    text += format_exact(table.times[i]);
    for (const Trace& trace : table.traces) text += "," + (std::isfinite(trace.values[i]) ? format_exact(trace.values[i]) : std::string());
    text += "\n";
  }
  return text;
}

}  // namespace hooke
