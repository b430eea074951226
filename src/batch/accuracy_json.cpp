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
    const bool is_number = measured->value && std::isfinite(*measured->value);
    if (is_number) {
      json.number(name, *measured->value);
      continue;
    }
    json.key(name);
    json.null();
    const std::string reason(measured->value ? "small differences do not grow exponentially" : measured->reason);
    reasons += (reasons.empty() ? "" : "; ") + std::string(name) + ": " + reason;
  }
  const auto write_time = [&](const char* name, bool is_known, double time) {
    if (is_known) return json.number(name, time);
    json.key(name);
    json.null();
  };
  write_time("frame_time", accuracy.frame.value.has_value(), accuracy.frame_time);
  write_time("accumulated_since", accuracy.accumulated.value.has_value(), accuracy.since);
  if (!accuracy.is_on) reasons.append("; energy_balance: ").append(accuracy.off_reason);
  json.key("reason");
  if (reasons.empty())
    json.null();
  else
    json.text(reasons);
  json.end();
}

void write_half_error(JsonWriter& json, const Accuracy& accuracy) {
  json.begin_object(JsonWriter::Layout::Line);
  if (accuracy.half_error_substeps > 0) {
    json.integer("substeps", accuracy.half_error_substeps);
    if (accuracy.half_error_tolerance > 0.0) json.number("tolerance", accuracy.half_error_tolerance);
    json.number("cost", accuracy.half_error_cost);
  } else {
    json.key("substeps");
    json.null();
    json.key("cost");
    json.null();
    json.text("reason", accuracy.is_on ? accuracy.half_error_reason : accuracy.off_reason);
  }
  json.end();
}

void write_energy_balance(JsonWriter& json, const Accuracy& accuracy) {
  if (!accuracy.is_on) return json.null();
  json.begin_object(JsonWriter::Layout::Line);
  for (const auto& [name, value] : accuracy.energy.terms())
    if (std::isfinite(value)) {
      json.number(name, value);
    } else {
      json.key(name);
      json.null();
    }
  json.end();
}

}  // namespace hooke
