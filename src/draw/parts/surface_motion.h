// Marks that show the motion of the surface of a collider whose shape stays in place: rotation, or a conveyor belt.
#pragma once

#include "draw/parts/balls.h"
#include "draw/parts/ground.h"
#include "draw/parts/network_renderer.h"
#include "draw/parts/strokes.h"

namespace hooke {

// Meridians on a rotating ball.
BallMeridians meridians_of(const DrawContext& context, const ColliderPath& path);

// Moves the grid of a plane with its surface.
void move_grid(GroundStyle& style, const DrawContext& context, const Plane& plane, const ColliderPath& path);

// Lines across the sides of a box, and diameters of a disc.
void add_belt(const DrawContext& context, const Box& box, const Vec3& belt, Rgba line, Strokes& strokes);
void add_diameters(const DrawContext& context, const Sphere& disc, double spin, Rgba line, Strokes& strokes);

}  // namespace hooke
