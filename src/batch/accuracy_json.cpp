#include "batch/accuracy_json.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace hooke {

void write_error(JsonWriter& json, const Accuracy& accuracy) {
  const std::array fields{
      std::pair{"frame", &accuracy.frame},
      std::pair{"frame_max", &accuracy.frame_max},
      std::pair{"accumulated", &accuracy.accumulated},
      std::pair{"amplification", &accuracy.amplification},
      std::pair{"growth_rate", &accuracy.growth_rate},
      std::pair{"predictable_seconds", &accuracy.predictable},
  };
  json.begin_object(JsonWriter::Layout::Line);
  std::string reasons;
  for (const auto& [name, measured] : fields) {
    json.number(name, measured->value);
    if (measured->value && std::isfinite(*measured->value)) continue;
    const std::string reason(measured->value ? "small differences do not grow exponentially" : measured->reason);
    reasons += (reasons.empty() ? "" : "; ") + std::string(name) + ": " + reason;
  }
  json.number("frame_time", accuracy.frame.value ? std::optional(accuracy.frame_time) : std::nullopt);
  json.number("accumulated_since", accuracy.accumulated.value ? std::optional(accuracy.since) : std::nullopt);
  if (!accuracy.is_on) reasons.append("; energy_balance: ").append(accuracy.off_reason);
  reasons.empty() ? json.null("reason") : json.text("reason", reasons);
  json.end();
}

void write_half_error(JsonWriter& json, const Accuracy& accuracy) {
  json.begin_object(JsonWriter::Layout::Line);
  if (accuracy.half_error.substeps > 0) {
    json.integer("substeps", accuracy.half_error.substeps);
    if (accuracy.half_error.tolerance > 0.0) json.number("tolerance", accuracy.half_error.tolerance);
    json.number("cost", accuracy.half_error.cost);
  } else {
    json.null("substeps");
    json.null("cost");
    json.text("reason", accuracy.is_on ? accuracy.half_error.reason : accuracy.off_reason);
  }
  json.end();
}

void write_energy_balance(JsonWriter& json, const Accuracy& accuracy) {
  if (!accuracy.is_on) return json.null();
  json.begin_object(JsonWriter::Layout::Line);
  for (const auto& [name, value] : accuracy.energy.terms()) json.number(name, std::optional(value));
  json.end();
}

}  // namespace hooke
