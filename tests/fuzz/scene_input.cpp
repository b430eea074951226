#include "fuzz/scene_input.h"

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "formats/scene_file.h"
#include "lab/lab.h"

namespace hooke {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

std::optional<Scene> load(std::string_view bytes) {
  try {
    return parse_scene(bytes, "fuzzed.json").scene;
  } catch (const InputError& refused) {
    // one line, with nothing in it that a terminal would obey
    for (const char* c = refused.what(); *c != '\0'; ++c)
      require(static_cast<unsigned char>(*c) >= 0x20 && *c != 0x7f, "a control character in a message");
    return std::nullopt;
  }
}

// Scenes within every limit may still be too long to wait for.
bool is_small(const Scene& scene) {
  return scene.system.point_count() < 2000 && scene.system.spring_count() < 10000 && scene.settings.substeps <= 50 &&
         scene.system.colliders.size() <= 10;
}

}  // namespace

void try_as_scene(std::string_view bytes) {
  std::optional<Scene> scene = load(bytes);
  if (!scene) return;

  const std::string text = format_scene(*scene);
  const std::optional<Scene> again = load(text);
  require(again.has_value(), "what was saved is refused");
  require(format_scene(*again) == text, "what was saved comes back as something else");

  if (!is_small(*scene)) return;
  Lab lab(std::move(*scene));
  lab.step();
  require(is_finite(lab.scene().state), "a state that is no numbers");
}

}  // namespace hooke
