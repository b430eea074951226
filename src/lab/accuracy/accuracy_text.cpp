#include "lab/accuracy/accuracy_text.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "base/round_number.h"
#include "lab/accuracy/judgement.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

// Fewer seconds than this are no prediction.
constexpr double min_predictable = 0.1;  // [s]
// The second runs may be late: an accumulated error that is this much older than the error of a frame is shown with its time [s].
constexpr double max_delay = 0.5;
// A value that is older is shown with its age [s].
constexpr double max_hidden_age = 0.2;

std::string largest_error_text(const Accuracy& accuracy) {
  return "error of up to " + length_text(accuracy.max_accumulated.error) + " at " + quantity_text(accuracy.max_accumulated.time, "s") +
         ", " + part_of_motion_text(accuracy.max_accumulated.error / accuracy.motion);
}

// What can be said where the positions cannot be predicted.
std::string meaning_of_averages(const Accuracy& accuracy) {
  if (!has_wrong_energy(accuracy)) return "only averages are meaningful";
  return "not even averages are meaningful, because the method has " + std::string(accuracy.energy.method() < 0.0 ? "lost " : "gained ") +
         number_text(100.0 * std::abs(accuracy.energy.method()) / accuracy.energy.scale, 2) + " % of the energy supplied";
}

// Why no setting helps, after `joint`; empty where a tolerance may.
std::string obstacle(const Accuracy& accuracy, const std::string& joint = ": ") {
  if (accuracy.growth_rate.value.value_or(0.0) > 0.0) return joint + "small differences grow, so that " + meaning_of_averages(accuracy);
  if (accuracy.half_error.reason == half_step_does_not_help)
    return joint + std::string(half_step_does_not_help) + ", so that " + meaning_of_averages(accuracy);
  if (!accuracy.is_smooth) return joint + "no setting with a smaller error is known, because of contact, a strain limit or the hand";
  return {};
}

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
  if (*accuracy.predictable.value < min_predictable) return "chaotic: " + meaning_of_averages(accuracy);
  return "predictable for about " + number_text(*accuracy.predictable.value, 2) + " s more";
}

std::string accuracy_line(const Accuracy& accuracy) { return accuracy_lines(accuracy).front(); }

std::vector<std::string> accuracy_lines(const Accuracy& accuracy) {
  if (!accuracy.is_on) return {"error not measured: switched off", "error: off"};
  const Judgement judgement = judge(accuracy);
  std::vector<std::string> lines;
  if (judgement.level != Judgement::Level::Good) lines = {judgement.text, judgement.brief};
  // the more detailed go before the shorter
  const auto add = [&](const std::string& part) { lines.insert(lines.begin(), lines.front() + part); };
  if (!accuracy.frame.value && !lines.empty()) return lines;
  if (!accuracy.frame.value && accuracy.estimated)
    return {"error about " + length_text(*accuracy.estimated) + "/frame, as estimated by auto", "error: estimated"};
  if (!accuracy.frame.value) return {"error: " + std::string(accuracy.frame.reason), "error: not known"};
  const std::string error = "error " + length_text(*accuracy.frame.value) + "/frame";
  if (lines.empty())
    lines = {error};
  else
    add("; " + error);
  if (const double age = accuracy.time - accuracy.frame_time; age > max_hidden_age * (1.0 + 1e-9))
    add(" (" + quantity_text(age, "s", 2) + " ago)");
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

std::optional<double> tolerance_to_try(const Accuracy& accuracy, const Settings& settings) {
  if (!accumulated_warning(accuracy) || accuracy.loss == Loss::Unpredictable || !obstacle(accuracy).empty()) return std::nullopt;
  constexpr double aimed_at = 0.01, min = 1e-10, max = 0.1;
  const double seconds = accuracy.accumulated_time - accuracy.since;
  double tolerance = aimed_at * std::min(accuracy.motion, accuracy.size) / std::max(seconds, 1e-3);
  if (is_automatic(settings)) tolerance = std::min(tolerance, 0.1 * automatic_tolerance(settings));
  return round_below(std::clamp(tolerance, min, max) * (1.0 + 1e-9));
}

std::optional<std::string> accumulated_warning(const Accuracy& accuracy) {
  switch (accuracy.loss) {
    case Loss::None:
      break;
    case Loss::Unpredictable:
      return "the positions are " + std::string(accuracy.accumulated.reason) + ": " + meaning_of_averages(accuracy);
    case Loss::Dissipated:
    case Loss::HalfStepDiverged:
    case Loss::Unresolved:
      return "accumulated error not known: " + std::string(accuracy.accumulated.reason) + obstacle(accuracy, "; ");
    case Loss::NoSecondRun:
      return "accumulated error not known from " + quantity_text(accuracy.accumulated_time, "s") +
             " on: " + std::string(accuracy.accumulated.reason) +
             (is_large_error(accuracy, accuracy.max_accumulated.error) ? "; " + largest_error_text(accuracy) : std::string()) +
             obstacle(accuracy, "; ");
  }
  if (!accuracy.accumulated.value) return std::nullopt;
  const double error = *accuracy.accumulated.value;
  if (is_large_error(accuracy, error))
    return "accumulated error of about " + length_text(error) + ", " + part_of_motion_text(error / accuracy.motion) + obstacle(accuracy);
  if (!is_large_error(accuracy, accuracy.max_accumulated.error)) return std::nullopt;
  return "accumulated " + largest_error_text(accuracy) + " (" + length_text(error) + " at " +
         quantity_text(accuracy.accumulated_time, "s") + ")" + obstacle(accuracy);
}

}  // namespace hooke
