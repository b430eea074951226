// The families of springs by their names in files.
#pragma once

#include <string_view>

#include "base/json_field.h"
#include "sim/model/system.h"

namespace hooke {

// Empty for None.
std::string_view name_of(SpringFamily family);

// Throws InputError.
SpringFamily read_family(const JsonField& field);

}  // namespace hooke
