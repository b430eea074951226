// The part of a scene that a shape or a mesh becomes when it is placed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "base/progress.h"
#include "draw/marks.h"
#include "scene/scene.h"
#include "ui/placement.h"

namespace hooke {

// A mesh as cloth, centered at the origin, with its longest side 1 m; or an error text.
struct MeshPart {
  std::shared_ptr<const Scene> scene;  // null on error
  std::string error;
};
MeshPart load_mesh_part(const std::filesystem::path& file, const Progress& progress);

// The points, springs and faces to be placed, at their positions. `up` is the up direction of the scene; `mesh` may be null if no mesh is
// being placed. Empty if there is nothing to place yet.
Scene part_of(const Placement& placement, const Scene* mesh, const Vec3& up, bool is_flat);

// The contact with which users expect the part to be added to a scene in which nothing touches; none for parts that do not touch.
std::optional<PairContact> contact_of(const Placement& placement, const Scene& part, bool is_flat);

// Marks the part as a preview.
void mark_part(const Scene& part, Marks& marks);

}  // namespace hooke
