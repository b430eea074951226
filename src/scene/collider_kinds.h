// Colliders as the window adds and edits them: their kinds, their numbers, and the handles with which they are sized. What their panels
// show follows from these tables.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

struct ColliderKind {
  std::string_view label, description;
  // About a position, of this size [m]; `up`: the normal of a plane.
  Collider (*make)(const Vec3& at, double size, const Vec3& up);
};
std::span<const ColliderKind> collider_kinds();
const ColliderKind& kind_of(const Collider& collider);

// A number of a collider.
struct ColliderNumber {
  std::string_view label, unit, description;
  double min, max;
  bool is_3d_only;
  bool (*applies)(const Collider& collider);
  double (*read)(const Collider& collider);
  void (*write)(Collider& collider, double value);
};
std::span<const ColliderNumber> collider_numbers();

// Lines that show it as a preview; `size`: of the part of a plane that is drawn [m].
std::vector<std::pair<Vec3, Vec3>> outline_of(const Collider& collider, double size);

// Positions at which it is taken to be sized: on the surface of a ball or a box, and at the tip of the normal of a plane. The collider
// after one of them was dragged to a place.
std::vector<Vec3> handles_of(const Collider& collider, int dimensions, double size);
Collider with_handle_at(Collider collider, std::size_t handle, const Vec3& place);

}  // namespace hooke
