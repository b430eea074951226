// The shapes of a scene file: its list of generators.
#pragma once

#include "formats/scene_json/scene_fields.h"
#include "scene/shape.h"

namespace hooke {

// Throws InputError.
Shape read_shape(const JsonField& field, SceneFields& fields);

// Parses a list of generators that was read before, as stored in PreservedJson.
std::vector<Shape> parse_shapes(const std::string& list);

}  // namespace hooke
