// Generators as a scene file says them.
#pragma once

#include "formats/scene_fields.h"
#include "scene/generators.h"

namespace hooke {

// Throws InputError.
Generator read_generator(const JsonField& field, SceneFields& fields);

// A list of generators that has been read before, as it is kept in PreservedJson.
std::vector<Generator> parse_generators(const std::string& list);

}  // namespace hooke
