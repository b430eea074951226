// The fields of a spring's law in scene files.
#pragma once

#include "base/json_field.h"
#include "base/json_writer.h"
#include "sim/model/spring_list.h"

namespace hooke {

// Reads "law", "k3", "muscle", "rest_length_rate" or "rest_length_limits" into the law of the spring. False: it is another field.
bool read_law_field(const JsonField& member, Spring& spring);

// The members that differ from the default.
void write_law(const SpringLaw& law, JsonWriter& out);

}  // namespace hooke
