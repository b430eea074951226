#include "fuzz/scene_input.h"

#include <algorithm>
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
    // one line, without control characters that a terminal would interpret
    for (const char* c = refused.what(); *c != '\0'; ++c)
      require(static_cast<unsigned char>(*c) >= 0x20 && *c != 0x7f, "no control character in a message");
    return std::nullopt;
  }
}

constexpr int max_substeps = 4;

// Scenes within all limits may still take too long to simulate. The readers are tested here, with as many inputs as possible: only small
// scenes are stepped.
bool is_small(const Scene& scene) {
  return scene.system.point_count() < 200 && scene.system.spring_count() < 1000 && scene.system.colliders.size() <= 10;
}

// Returns the scene that was read.
std::optional<Scene> read_and_write(std::string_view bytes) {
  std::optional<Scene> scene = load(bytes);
  if (!scene) return std::nullopt;
  const std::string text = format_scene(*scene);
  const std::optional<Scene> again = load(text);
  require(again.has_value(), "a saved scene can be loaded");
  require(format_scene(*again) == text, "a saved scene is read back unchanged");
  return scene;
}

}  // namespace

void read_as_scene(std::string_view bytes) { read_and_write(bytes); }

void try_as_scene(std::string_view bytes) {
  std::optional<Scene> scene = read_and_write(bytes);
  if (!scene || !is_small(*scene)) return;
  scene->settings.substeps = std::min(scene->settings.substeps, max_substeps);
  Lab lab(std::move(*scene));
  lab.step();
  require(is_finite(lab.scene().state), "the state is finite");
}

}  // namespace hooke
