// Draws the thumbnails of the gallery: make_thumbnails FOLDER [SCENE...] (called by scripts/thumbnails).
#include <algorithm>
#include <cstdio>

#include "base/errors.h"
#include "batch/offscreen.h"
#include "thumbnail.h"

int main(int count, char** arguments) {
  if (count < 2) return 2;
  try {
    const hooke::Offscreen offscreen;
    hooke::View view;
    for (const hooke::ShippedScene& scene : hooke::shipped_scenes()) {
      const bool wanted = count == 2 || std::any_of(arguments + 2, arguments + count, [&](const char* id) { return scene.id == id; });
      if (wanted) write_png(render_thumbnail(view, scene), std::filesystem::path(arguments[1]) / (scene.id + ".png"));
    }
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
