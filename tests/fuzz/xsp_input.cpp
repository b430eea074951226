#include "fuzz/xsp_input.h"

#include "formats/xsp/xsp_file.h"
#include "fuzz/sound.h"

namespace hooke {

void try_as_xsp(std::string_view bytes) {
  LoadedScene loaded;
  try {
    loaded = parse_xsp(bytes, "fuzz.xsp");
  } catch (const InputError&) {
    return;
  }
  require_sound(loaded);
  require_stable(loaded);

  std::vector<std::string> losses;
  std::string text;
  try {
    text = format_xsp(loaded.scene, "again.xsp", losses);
  } catch (const InputError&) {
    return;  // numbers next to the largest
  }
  const LoadedScene again = parse_xsp(text, "again.xsp");
  require_sound(again);
  require(again.scene.system.points() == loaded.scene.system.points(), "the same points come back");
  require(again.scene.system.spring_count() == loaded.scene.system.spring_count(), "the same springs come back");
}

}  // namespace hooke
