// The environment of a network: colliders and the grid, as shapes for the view to draw.
#pragma once

#include "draw/parts/balls.h"
#include "draw/parts/ground.h"
#include "draw/parts/network_renderer.h"
#include "draw/parts/shadows.h"
#include "draw/parts/strokes.h"
#include "draw/parts/surfaces.h"

namespace hooke {

// Drawn in this order: background, opaque objects, transparent floors in front.
struct Environment {
  Ground backdrop, floors, transparent_floors;
  Surfaces solids;
  Balls balls;
  Strokes outlines;

  void clear();
  void add(const DrawContext& context, const Shadows& shadows);

 private:
  void add_grid(const DrawContext& context);
  void add_spatial(const DrawContext& context, const Collider& collider, bool is_hovered, const BallShadow& shade);
  void add_flat(const DrawContext& context, const Collider& collider, bool is_hovered);
};

}  // namespace hooke
