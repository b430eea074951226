#include "lab/accuracy/accuracy_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace hooke {
namespace {

std::string two_digits(double value) {
  std::array<char, 32> text{};
  if (value >= 10.0 && value < 1e6)
    std::snprintf(text.data(), text.size(), "%.0f", value);
  else
    std::snprintf(text.data(), text.size(), "%.2g", value);
  return text.data();
}

// Fewer seconds than this are no prediction.
constexpr double min_predictable = 0.1;  // [s]

}  // namespace

std::string length_text(double length) {
  struct Unit {
    double size;
    const char* name;
  };
  for (const Unit& unit : {Unit{1.0, " m"}, Unit{1e-3, " mm"}, Unit{1e-6, " \u03bcm"}, Unit{1e-9, " nm"}, Unit{1e-12, " pm"}})
    if (length >= unit.size) return two_digits(length / unit.size) + unit.name;
  return "0";
}

std::string error_text(const Measured& error, double size) {
  if (!error.value) return std::string(error.reason);
  const double percent = 100.0 * *error.value / size;
  return length_text(*error.value) + " (" + (percent < 1e-6 ? "< 1e-06" : two_digits(percent)) + " % of the size)";
}

std::string predictability_text(const Accuracy& accuracy) {
  if (!accuracy.predictable.value) return std::string(accuracy.predictable.reason);
  if (!std::isfinite(*accuracy.predictable.value)) return "predictable: small differences do not grow exponentially";
  if (*accuracy.predictable.value < min_predictable) return "chaotic: only averages are meaningful";
  return "predictable for about " + two_digits(*accuracy.predictable.value) + " s more";
}

std::string cost_text(const Accuracy& accuracy) {
  if (!accuracy.is_on || accuracy.half_error_substeps == 0) return {};
  std::array<char, 16> factor{};
  std::snprintf(factor.data(), factor.size(), "%.1f", accuracy.half_error_cost);
  const std::string time = std::string(factor.data()) + "x the time";
  if (accuracy.half_error_tolerance > 0.0) {
    std::array<char, 16> tolerance{};
    std::snprintf(tolerance.data(), tolerance.size(), "%.1g", accuracy.half_error_tolerance);
    return "half the error: tolerance " + std::string(tolerance.data()) + " m, " + time;
  }
  return "half the error: " + std::to_string(accuracy.half_error_substeps) + " substeps, " + time;
}

std::string accuracy_line(const Accuracy& accuracy) {
  if (!accuracy.is_on) return "error not measured: switched off";
  if (!accuracy.frame.value) return "error: " + std::string(accuracy.frame.reason);
  std::string line = "error " + length_text(*accuracy.frame.value) + "/frame";
  if (accuracy.accumulated.value) line += ", " + length_text(*accuracy.accumulated.value) + " in total";
  if (!accuracy.predictable.value) return line;
  if (!std::isfinite(*accuracy.predictable.value)) return line + ", predictable";
  return line + (*accuracy.predictable.value < min_predictable ? ", chaotic"
                                                               : ", predictable for " + two_digits(*accuracy.predictable.value) + " s");
}

}  // namespace hooke
