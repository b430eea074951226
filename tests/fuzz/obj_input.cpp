#include "fuzz/obj_input.h"

#include "formats/mesh/mesh_file.h"
#include "fuzz/invariants.h"

namespace hooke {

void try_as_obj(std::string_view bytes) {
  LoadedScene loaded;
  try {
    loaded = parse_obj(bytes, "fuzz.obj");
  } catch (const InputError&) {
    return;
  }
  require_valid(loaded);
  require_stable(loaded);
  require(loaded.scene.system.point_count() > 0, "the mesh has points");
  require(!format_obj(loaded.scene).empty() && !format_ply(loaded.scene).empty(), "the mesh can be written");
}

}  // namespace hooke
