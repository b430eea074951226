// Adds the parts of one scene to another: what a builder of scenes does, and reading a fragment of a scene file.
#pragma once

#include "scene/scene.h"

namespace hooke {

// Appends the points, springs, faces, colliders and forces of `part` to the scene, at the state of the part. Generators of the part are
// kept as generators. Everything else of the part is ignored. Throws InputError if the scene becomes larger than a scene may be, or if it
// is 2-D and the part is not.
void append_parts(Scene& scene, const Scene& part);

}  // namespace hooke
