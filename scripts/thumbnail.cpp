#include "thumbnail.h"

#include <cmath>

#include "formats/gallery.h"
#include "lab/lab.h"

namespace hooke {

Image render_thumbnail(View& view, const ShippedScene& shipped) {
  Lab lab(load_scene(shipped.file).scene, KeepStart::No);
  const Scene& scene = lab.scene();
  Camera camera = make_camera(scene.view, scene.system, scene.state, static_cast<double>(thumbnail_width) / thumbnail_height);
  // small pictures need a smaller margin
  if (scene.system.dimensions == 3) camera.distance *= 0.86;

  const long frames = std::lround(shipped.thumbnail_seconds * scene.settings.frame_rate);
  for (long frame = 0; frame < frames; ++frame) lab.step();
  lab.publish();
  follow_scene(camera, scene.state);
  ViewOptions look = options_for(scene.view, scene.cloth_texture);
  view.draw(*lab.status()->snapshot, {}, camera, look, thumbnail_width, thumbnail_height, nullptr);
  Image both = view.read();
  if (!scene.view.background) look.background = light_background;
  view.draw(*lab.status()->snapshot, {}, camera, look, thumbnail_width, thumbnail_height, nullptr);
  const Image light = view.read();
  both.pixels.insert(both.pixels.end(), light.pixels.begin(), light.pixels.end());
  both.height += light.height;
  return both;
}

}  // namespace hooke
