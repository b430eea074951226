// Any bytes as an .xsp file: a sound scene, or Refused; and what is written of it is read back as the same.
#include "fuzz/sound.h"
#include "lab/xsp_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace hooke;
  LoadedScene loaded;
  try {
    loaded = parse_xsp({reinterpret_cast<const char*>(data), size}, "fuzz.xsp");
  } catch (const Refused&) {
    return 0;
  }
  require_sound(loaded);
  require_stable(loaded);

  std::vector<std::string> lost;
  std::string text;
  try {
    text = format_xsp(loaded.scene, "again.xsp", lost);
  } catch (const Refused&) {
    return 0;  // numbers next to the largest
  }
  const LoadedScene again = parse_xsp(text, "again.xsp");
  require_sound(again);
  require(again.scene.system.points() == loaded.scene.system.points(), "the same points come back");
  require(again.scene.system.spring_count() == loaded.scene.system.spring_count(), "the same springs come back");
  return 0;
}
