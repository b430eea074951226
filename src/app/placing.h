// What is shown and placed of a shape or a mesh.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "draw/marks.h"
#include "lab/goes_on.h"
#include "lab/scene.h"
#include "ui/placing.h"

namespace hooke {

// A mesh as cloth, its middle at the origin and its longest side 1 m; an error text instead where it is refused.
struct MeshPart {
  std::shared_ptr<const Scene> scene;  // null: refused
  std::string error;
};
MeshPart load_mesh_part(const std::filesystem::path& file, const GoesOn& goes_on);

// The points, springs and faces that would be placed, in their places. `up` is the scene's; `mesh` may be null where no mesh is
// placed. Nothing where there is nothing to place yet.
Scene part_of(const Placing& placing, const Scene* mesh, const Vec3& up, bool is_flat);

// The part as it is seen through.
void mark_part(const Scene& part, Marks& marks);

}  // namespace hooke
