// Any bytes as an .obj file: a sound scene, or Refused; and it can be written as any mesh.
#include "fuzz/sound.h"
#include "lab/mesh_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace hooke;
  LoadedScene loaded;
  try {
    loaded = parse_obj({reinterpret_cast<const char*>(data), size}, "fuzz.obj");
  } catch (const Refused&) {
    return 0;
  }
  require_sound(loaded);
  require_stable(loaded);
  require(loaded.scene.system.point_count() >= 3 && loaded.scene.system.spring_count() >= 3, "there is cloth");
  require(!format_obj(loaded.scene).empty() && !format_ply(loaded.scene).empty(), "it is written");
  return 0;
}
