// The objects of a scene file, its colliders, contact and forces.
#pragma once

#include "formats/scene_json/scene_fields.h"
#include "scene/scene.h"

namespace hooke {

// A field of the table of parameters. Returns false if it is none.
bool read_parameter(const JsonField& field, Scene& scene);

// Each throws InputError, and preserves unknown keys in the scene.
void read_collider(const JsonField& field, SceneFields& fields, Scene& scene);
void read_force(const JsonField& field, SceneFields& fields, Scene& scene);
void read_contact(const JsonField& field, SceneFields& fields, Scene& scene);
void read_hand(const JsonField& field, SceneFields& fields, Scene& scene);
void read_simulation(const JsonField& field, SceneFields& fields, Scene& scene);
void read_view(const JsonField& field, SceneFields& fields, Scene& scene);
void read_defaults(const JsonField& field, SceneFields& fields, Scene& scene);
void read_controls(const JsonField& field, SceneFields& fields, Scene& scene);

}  // namespace hooke
