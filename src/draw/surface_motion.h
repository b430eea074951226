// What shows that the surface of a collider moves while its shape stays: it turns, or runs like a belt.
#pragma once

#include "draw/balls.h"
#include "draw/ground.h"
#include "draw/net.h"
#include "draw/strokes.h"

namespace hooke {

// Meridians on a ball that turns.
BallMeridians meridians_of(const Subject& subject, const ColliderPath& path);

// The grid of a plane goes along.
void move_grid(GroundLook& look, const Subject& subject, const Plane& plane, const ColliderPath& path);

// Lines across the sides of a box, and diameters of a disc.
void add_belt(const Subject& subject, const Box& box, const Vec3& belt, Ink line, Strokes& strokes);
void add_diameters(const Subject& subject, const Sphere& disc, double spin, Ink line, Strokes& strokes);

}  // namespace hooke
