// What is shown and placed of a shape or a mesh.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/progress.h"
#include "draw/marks.h"
#include "scene/scene.h"
#include "ui/placement.h"

namespace hooke {

// A mesh as cloth, its middle at the origin and its longest side 1 m; an error text instead where it is refused.
struct MeshPart {
  std::shared_ptr<const Scene> scene;  // null: refused
  std::string error;
};
MeshPart load_mesh_part(const std::filesystem::path& file, const Progress& progress);

// The points, springs and faces that would be placed, in their places. `up` is the scene's; `mesh` may be null where no mesh is
// placed. Nothing where there is nothing to place yet.
Scene part_of(const Placement& placement, const Scene* mesh, const Vec3& up, bool is_flat);

// The part as it is seen through.
void mark_part(const Scene& part, Marks& marks);

}  // namespace hooke
