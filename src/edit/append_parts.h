// Adds the parts of one scene to another: what a builder of scenes does, and reading a fragment of a scene file.
#pragma once

#include <string>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

// Appends the points, springs, faces, colliders and forces of `part` to the scene, at the state of the part. Generators of the part are
// kept as generators. Everything else of the part is ignored. Throws InputError if the scene becomes larger than a scene may be, or if it
// is 2-D and the part is not.
void append_parts(Scene& scene, const Scene& part);

// Reads members of a scene file (parse_members), and adds them to the scene: parts are appended, other members replace those of the scene.
void add_members(Scene& scene, std::string_view members, const std::string& name);

}  // namespace hooke
