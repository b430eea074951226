#include "study/spectrum.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>

namespace hooke {
namespace {

constexpr std::size_t min_values = 8;
// Zeros after the values give points between the frequencies, so that a peak is found to a fraction of their distance.
constexpr std::size_t padding = 4;
constexpr double noticed = 0.01;  // of the largest amplitude in the same plot

// Whether an FFT of so many values is fast.
bool is_smooth(std::size_t n) {
  for (const std::size_t p : {2, 3, 5})
    while (n % p == 0) n /= p;
  return n == 1;
}

std::vector<double> amplitudes(std::span<const double> values) {
  const std::size_t n = values.size();
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(n);
  std::vector<double> padded(padding * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n - 1);
    padded[i] = (values[i] - mean) * 0.5 * (1.0 - std::cos(phase));
  }
  std::vector<std::complex<double>> transformed;
  Eigen::FFT<double>().fwd(transformed, padded);
  std::vector<double> result(padded.size() / 2);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = 4.0 / static_cast<double>(n) * std::abs(transformed[k]);
  return result;
}

}  // namespace

TraceTable spectrum_of(const TraceTable& table, double first, double last) {
  auto begin = static_cast<std::size_t>(std::ranges::lower_bound(table.times, first) - table.times.begin());
  const auto end = static_cast<std::size_t>(std::ranges::upper_bound(table.times, last) - table.times.begin());
  // values at equal distances: after the last jump of the time
  for (std::size_t i = begin + 1; i < end; ++i)
    if (table.continues[i] == 0) begin = i;
  TraceTable spectrum;
  if (end < begin + min_values) return spectrum;
  while (!is_smooth(end - begin)) ++begin;
  const double step = (table.times[end - 1] - table.times[begin]) / static_cast<double>(end - 1 - begin);
  std::size_t shown = min_values;
  for (const Trace& trace : table.traces) {
    const auto values = std::span(trace.values).subspan(begin, end - begin);
    const bool is_known = std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
    if (is_known) spectrum.traces.push_back({trace.quantity, amplitudes(values)});
  }
  for (const Trace& trace : spectrum.traces) {
    double largest = 0.0;
    for (const Trace& other : spectrum.traces)
      if (other.quantity.row->unit == trace.quantity.row->unit) largest = std::max(largest, *std::ranges::max_element(other.values));
    for (std::size_t k = trace.values.size(); k-- > shown;)
      if (trace.values[k] > noticed * largest) shown = k + 1;
  }
  if (spectrum.traces.empty()) return spectrum;
  shown = std::min(shown + shown / 4, spectrum.traces.front().values.size());
  for (Trace& trace : spectrum.traces) trace.values.resize(shown);
  const double width = 1.0 / (step * static_cast<double>(padding * (end - begin)));
  for (std::size_t k = 0; k < shown; ++k) spectrum.times.push_back(width * static_cast<double>(k));
  spectrum.continues.assign(shown, 1);
  spectrum.errors.assign(shown, std::nan(""));
  return spectrum;
}

std::optional<double> peak_of(const TraceTable& spectrum, const std::vector<const Trace*>& traces) {
  constexpr std::size_t first = 2 * padding;  // two periods
  constexpr double side_lobes = 0.1;          // of a drift, whose largest one has 0.075 of its amplitude under a Hann window
  double highest = 0.0;
  for (const Trace* trace : traces) highest = std::max(highest, side_lobes * *std::ranges::max_element(trace->values));
  std::optional<double> frequency;
  for (const Trace* trace : traces) {
    const std::vector<double>& values = trace->values;
    for (std::size_t k = first; k + 1 < values.size(); ++k) {
      if (!(values[k] > std::max(highest, values[k - 1]) && values[k] >= values[k + 1])) continue;
      highest = values[k];
      frequency = spectrum.times[k];
    }
  }
  return frequency;
}

}  // namespace hooke
