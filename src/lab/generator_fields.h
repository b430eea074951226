// Generators as a scene file says them.
#pragma once

#include "lab/generators.h"
#include "lab/scene_fields.h"

namespace hooke {

// Throws Refused.
Generator read_generator(const JsonField& field, SceneFields& fields);

// A list of generators that has been read before, as it is kept in KeptJson.
std::vector<Generator> parse_generators(const std::string& list);

}  // namespace hooke
