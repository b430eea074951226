#include "fuzz/xsp_input.h"

#include "fuzz/sound.h"
#include "lab/xsp_file.h"

namespace hooke {

void try_as_xsp(std::string_view bytes) {
  LoadedScene loaded;
  try {
    loaded = parse_xsp(bytes, "fuzz.xsp");
  } catch (const Refused&) {
    return;
  }
  require_sound(loaded);
  require_stable(loaded);

  std::vector<std::string> lost;
  std::string text;
  try {
    text = format_xsp(loaded.scene, "again.xsp", lost);
  } catch (const Refused&) {
    return;  // numbers next to the largest
  }
  const LoadedScene again = parse_xsp(text, "again.xsp");
  require_sound(again);
  require(again.scene.system.points() == loaded.scene.system.points(), "the same points come back");
  require(again.scene.system.spring_count() == loaded.scene.system.spring_count(), "the same springs come back");
}

}  // namespace hooke
