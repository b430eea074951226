// The pictures of the gallery, as scripts/thumbnails makes them and a test takes them again.
#pragma once

#include "draw/view.h"
#include "formats/scene_file.h"

namespace hooke {

// The scene so long after its start as its row says, a little nearer than it is opened. A context must be current.
Image render_thumbnail(View& view, const ShippedScene& shipped);

}  // namespace hooke
