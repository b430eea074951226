// The accuracy of a run as JSON, common to `run --json` and the reports of `capture`.
#pragma once

#include "base/json_writer.h"
#include "sim/model/accuracy.h"

namespace hooke {

// An object with the errors and the growth of small differences. A value that is not known is null, and "reason" says why.
void write_error(JsonWriter& json, const Accuracy& accuracy);
// An object with what half the error costs, null with a reason until a frame has been computed.
void write_half_error(JsonWriter& json, const Accuracy& accuracy);
// An object with the terms [J]; null if they were not measured.
void write_energy_balance(JsonWriter& json, const Accuracy& accuracy);

}  // namespace hooke
