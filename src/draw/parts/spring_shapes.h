// Springs that are not drawn as straight lines: coils, slack cables and muscles.
#pragma once

#include "draw/parts/network_renderer.h"

namespace hooke {

// Adds the spring between these positions as a curve; false: it is a straight line, of `width` [px].
bool add_spring_curve(const DrawContext& context, const Spring& spring, const Vec3& from, const Vec3& to, Rgba color, float& width,
                      double depth_offset, Strokes& strokes);

}  // namespace hooke
