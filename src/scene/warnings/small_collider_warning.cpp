#include "scene/warnings/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <vector>

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

// Between two points, one of which may move.
struct PassableGap {
  double half = 0.0;    // [m], half of the free distance between them
  double length = 0.0;  // [m]
};

// Of the faces of a scene in space, else of the springs without the bend springs, in the middle of which there is a point. A ball passes
// where the longest edge of a face is, a bar where the second one is.
std::vector<PassableGap> gaps_of(const System& system, const State& state, bool of_faces, bool is_ball) {
  std::vector<PassableGap> gaps;
  const auto add = [&](Index i, Index j, double length) {
    const Point &first = system.points()[i], &second = system.points()[j];
    if (!first.nailed || !second.nailed) gaps.push_back({0.5 * length - std::min(first.radius, second.radius), length});
  };
  for (const Spring& spring : system.springs())
    if (!of_faces && spring.family != SpringFamily::Bend)
      add(system.index_of(spring.first), system.index_of(spring.second), spring.rest_length);
  for (const Face& face : of_faces ? system.faces : FaceList{}) {
    std::array<std::pair<double, int>, 3> edges;
    for (int c = 0; c < 3; ++c)
      edges[c] = {glm::distance(state.position[system.index_of(face.points[c])], state.position[system.index_of(face.points[(c + 1) % 3])]),
                  c};
    std::ranges::sort(edges);
    const auto [length, c] = edges[is_ball ? 2 : 1];
    add(system.index_of(face.points[c]), system.index_of(face.points[(c + 1) % 3]), length);
  }
  return gaps;
}

}  // namespace

std::optional<std::string> small_collider_text(const System& system, const State& state, const Collider& collider) {
  const double half = half_width(collider, system.dimensions);
  if (!collider.solid || std::isinf(half)) return std::nullopt;
  const bool is_ball = std::holds_alternative<Sphere>(collider.shape), of_faces = system.dimensions == 3 && !system.faces.empty();
  std::vector<PassableGap> gaps = gaps_of(system, state, of_faces, is_ball);
  if (gaps.empty()) return std::nullopt;
  // a few long springs or faces, such as those within a body, are no gap that matters: three quarters must be wide enough, but for rounding
  const auto typical = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 4);
  std::ranges::nth_element(gaps, typical, {}, &PassableGap::half);
  if (half > (1.0 + 1e-9) * typical->half) return std::nullopt;
  return (is_ball ? "a ball of radius " + quantity_text(half, "m", 2) : "a box that is " + quantity_text(2.0 * half, "m", 2) + " wide") +
         " fits between the points of a " + (of_faces ? "face" : "spring") + " of " + quantity_text(typical->length, "m", 2) +
         ", which passes through it: " +
         (is_ball ? std::string("use a nailed point of that radius, with contact of ") + (of_faces ? "faces" : "springs")
                  : "only points touch colliders");
}

std::optional<std::string> small_collider_warning(const System& system, const State& state) {
  for (std::size_t c = 0; c < system.colliders.size(); ++c)
    if (const auto text = small_collider_text(system, state, system.colliders[c])) return "colliders[" + std::to_string(c) + "]: " + *text;
  return std::nullopt;
}

}  // namespace hooke
