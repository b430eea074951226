// Edits of several points at once: moved together, aligned, distributed, welded and split.
#pragma once

#include <glm/mat3x3.hpp>
#include <vector>

#include "edit/copy_selection.h"

namespace hooke {

// x becomes about + turn (x - about) * scale + shift.
struct Affine {
  Vec3 about{0.0};
  glm::dmat3 turn{1.0};  // a rotation or a reflection: velocities turn with it
  double scale = 1.0;    // rest lengths between the points scale with it
  Vec3 shift{0.0};
};
// About a unit axis [rad], counter-clockwise; and the reflection that reverses an axis of the coordinates.
glm::dmat3 rotation(const Vec3& axis, double angle);
glm::dmat3 reflection(int axis);

// The center of the box around the points.
Vec3 center_of(const Snapshot& now, const std::vector<PointId>& points);
std::vector<Command> moved(const Snapshot& start, const std::vector<PointId>& points, const Affine& affine);
// The coordinate of all points along an axis becomes their mean; or they keep their order and get equal distances along it.
Command aligned(const Snapshot& now, const std::vector<PointId>& points, int axis);
Command distributed(const Snapshot& now, const std::vector<PointId>& points, int axis);

// The first point takes the springs and faces of the others, their mass, and the place of their center of mass. Springs between them
// vanish.
std::vector<Command> weld(const Snapshot& snapshot, const SheetWeights* sheet, const std::vector<PointId>& points, const IdSource& ids);
// Each spring of a point but the first one gets an end of its own; they share the mass. Not at faces. Empty where nothing is split.
std::vector<Command> split(const Snapshot& now, const SheetWeights* sheet, const std::vector<PointId>& points, const IdSource& ids);

}  // namespace hooke
