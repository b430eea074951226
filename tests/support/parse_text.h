// Scenes from texts.
#pragma once

#include <string>
#include <vector>

#include "formats/scene_file.h"

namespace hooke {

inline Scene parse(const std::string& text) { return parse_scene(text, "test.json").scene; }
inline std::vector<std::string> warnings_of(const std::string& text) { return parse_scene(text, "test.json").warnings; }

}  // namespace hooke
