// What a network moves in: colliders and the grid, as shapes for the view to draw.
#pragma once

#include "draw/balls.h"
#include "draw/ground.h"
#include "draw/net.h"
#include "draw/shadows.h"
#include "draw/strokes.h"
#include "draw/surfaces.h"

namespace hooke {

// Drawn in this order: behind everything; solid things; what can be seen through, in front.
struct Stage {
  Ground backdrop, floors, veils;
  Surfaces solids, faint_solids;
  Balls balls, faint_balls;
  Strokes outlines;

  void clear();
  void add(const Subject& subject, const Shadows& shadows);

 private:
  void add_grid(const Subject& subject);
  void add_spatial(const Subject& subject, const Collider& collider, bool is_hovered, const BallShade& shade);
  void add_flat(const Subject& subject, const Collider& collider, bool is_hovered);
};

}  // namespace hooke
