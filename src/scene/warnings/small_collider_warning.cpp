#include "scene/warnings/small_collider_warning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/number_text.h"

namespace hooke {
namespace {

// Half of the width that a gap between points must have to let it pass [m]; infinity: planes.
double half_width(const Collider& collider, int dimensions) {
  if (const auto* ball = std::get_if<Sphere>(&collider.shape)) return ball->radius;
  const auto* box = std::get_if<Box>(&collider.shape);
  if (box == nullptr) return std::numeric_limits<double>::infinity();
  // a bar passes, a slab does not
  std::array<double, 3> sides{box->max.x - box->min.x, box->max.y - box->min.y, box->max.z - box->min.z};
  if (dimensions == 3) std::ranges::sort(sides);
  return 0.5 * (dimensions == 3 ? sides[1] : std::max(sides[0], sides[1]));
}

// The longest edge of a face or spring with an end that moves, less the radii of its points: half of it, and what it is.
struct WidestGap {
  double half = 0.0, length = 0.0;  // [m]
  bool is_face = false;

  void add(const System& system, Index i, Index j, double edge, bool of_face) {
    const Point &first = system.points()[i], &second = system.points()[j];
    const double free = 0.5 * edge - std::min(first.radius, second.radius);
    if ((!first.nailed || !second.nailed) && free > half) *this = {free, edge, of_face};
  }
};

WidestGap widest_gap(const System& system, const State& state) {
  WidestGap gap;
  for (const Face& face : system.faces)
    for (int c = 0; c < 3; ++c) {
      const Index i = system.index_of(face.points[c]), j = system.index_of(face.points[(c + 1) % 3]);
      gap.add(system, i, j, glm::distance(state.position[i], state.position[j]), true);
    }
  for (const Spring& spring : system.springs())
    // in the middle of a bend spring there is a point
    if (spring.family != SpringFamily::Bend)
      gap.add(system, system.index_of(spring.first), system.index_of(spring.second), spring.rest_length, false);
  return gap;
}

}  // namespace

std::optional<std::string> small_collider_text(const System& system, const State& state, const Collider& collider) {
  const double half = half_width(collider, system.dimensions);
  if (!collider.solid || std::isinf(half)) return std::nullopt;
  const WidestGap gap = widest_gap(system, state);
  if (half >= gap.half) return std::nullopt;
  const bool is_ball = std::holds_alternative<Sphere>(collider.shape);
  return (is_ball ? "a ball of radius " + quantity_text(half, "m", 2) : "a box that is " + quantity_text(2.0 * half, "m", 2) + " wide") +
         " fits between the points of a " + (gap.is_face ? "face" : "spring") + " of " + quantity_text(gap.length, "m", 2) +
         ", which passes through it: only points touch colliders";
}

std::optional<std::string> small_collider_warning(const System& system, const State& state) {
  for (std::size_t c = 0; c < system.colliders.size(); ++c)
    if (const auto text = small_collider_text(system, state, system.colliders[c])) return "colliders[" + std::to_string(c) + "]: " + *text;
  return std::nullopt;
}

}  // namespace hooke
