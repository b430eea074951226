#include "lab/accuracy/accuracy_text.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "base/number_text.h"

namespace hooke {
namespace {

// Fewer seconds than this are no prediction.
constexpr double min_predictable = 0.1;  // [s]
// The second runs may be late: an accumulated error that is this much older than the error of a frame is shown with its time [s].
constexpr double max_delay = 0.5;

}  // namespace

std::string length_text(double length) {
  struct Unit {
    double size;
    const char* name;
  };
  for (const Unit& unit : {Unit{1.0, " m"}, Unit{1e-3, " mm"}, Unit{1e-6, " \u03bcm"}, Unit{1e-9, " nm"}, Unit{1e-12, " pm"}})
    if (length >= unit.size) return number_text(length / unit.size, 2) + unit.name;
  return length > 0.0 ? "< 1 pm" : "0 m";
}

std::string error_text(const Measured& error, double size) {
  if (!error.value) return std::string(error.reason);
  const double percent = 100.0 * *error.value / size;
  return length_text(*error.value) + " (" + (percent < 1e-6 ? "< 0.000001" : number_text(percent, 2)) + " % of the size)";
}

std::string predictability_text(const Accuracy& accuracy) {
  if (!accuracy.predictable.value) return std::string(accuracy.predictable.reason);
  if (!std::isfinite(*accuracy.predictable.value)) return "predictable: small differences do not grow exponentially";
  if (*accuracy.predictable.value < min_predictable) return "chaotic: only averages are meaningful";
  return "predictable for about " + number_text(*accuracy.predictable.value, 2) + " s more";
}

std::string cost_text(const Accuracy& accuracy) {
  if (!accuracy.is_on || accuracy.half_error_substeps == 0) return {};
  std::array<char, 16> factor{};
  std::snprintf(factor.data(), factor.size(), "%.1f", accuracy.half_error_cost);
  const std::string time = std::string(factor.data()) + "x the time";
  if (accuracy.half_error_tolerance > 0.0) {
    return "half the error: tolerance " + quantity_text(accuracy.half_error_tolerance, "m", 1) + ", " + time;
  }
  return "half the error: " + std::to_string(accuracy.half_error_substeps) + " substeps, " + time;
}

std::string accuracy_line(const Accuracy& accuracy) { return accuracy_lines(accuracy).front(); }

std::vector<std::string> accuracy_lines(const Accuracy& accuracy) {
  if (!accuracy.is_on) return {"error not measured: switched off", "error: off"};
  if (!accuracy.frame.value) return {"error: " + std::string(accuracy.frame.reason), "error: not known"};
  std::vector<std::string> lines{"error " + length_text(*accuracy.frame.value) + "/frame"};
  // the more detailed go before the shorter
  const auto add = [&](const std::string& part) { lines.insert(lines.begin(), lines.front() + part); };
  if (accuracy.accumulated.value) {
    const bool is_late = accuracy.frame_time - accuracy.accumulated_time > max_delay;
    add(", " + length_text(*accuracy.accumulated.value) + " in total" +
        (is_late ? " at " + quantity_text(accuracy.accumulated_time, "s") : ""));
  }
  if (!accuracy.predictable.value) return lines;
  const double seconds = *accuracy.predictable.value;
  add(!std::isfinite(seconds)     ? ", predictable"
      : seconds < min_predictable ? ", chaotic"
                                  : ", predictable for " + number_text(seconds, 2) + " s");
  return lines;
}

}  // namespace hooke
