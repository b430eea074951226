// The thumbnails of the gallery, for scripts/thumbnails and a test.
#pragma once

#include "draw/view.h"
#include "formats/scene_file.h"

namespace hooke {

// On a dark background, and below that on a light one: the scene at the time given in its file, slightly closer than its default view. A
// context must be current.
Image render_thumbnail(View& view, const ShippedScene& shipped);

}  // namespace hooke
