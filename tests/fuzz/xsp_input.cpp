#include "fuzz/xsp_input.h"

#include "formats/xsp/xsp_file.h"
#include "fuzz/invariants.h"

namespace hooke {

void try_as_xsp(std::string_view bytes) {
  LoadedScene loaded;
  try {
    loaded = parse_xsp(bytes, "fuzz.xsp");
  } catch (const InputError&) {
    return;
  }
  require_valid(loaded);
  require_stable(loaded);

  std::vector<std::string> losses;
  std::string text;
  try {
    text = format_xsp(loaded.scene, "again.xsp", losses);
  } catch (const InputError&) {
    return;  // numbers close to the largest double
  }
  const LoadedScene again = parse_xsp(text, "again.xsp");
  require_valid(again);
  require(again.scene.system.points() == loaded.scene.system.points(), "the same points are read back");
  require(again.scene.system.spring_count() == loaded.scene.system.spring_count(), "the same springs are read back");
}

}  // namespace hooke
