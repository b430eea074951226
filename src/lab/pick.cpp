#include "lab/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "sim/overloaded.h"

namespace hooke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The part of a segment in front of the viewer is where the clip coordinate w is above this share of its larger end.
constexpr double least_w = 1e-9;

glm::dvec2 to_picture(const glm::dvec4& clip, const glm::dvec2& size) {
  return {(0.5 + 0.5 * clip.x / clip.w) * size.x, (0.5 - 0.5 * clip.y / clip.w) * size.y};
}

// The picture of a segment, cut where it passes behind the viewer; none when all of it is behind.
struct SeenSegment {
  glm::dvec2 from, to;
};
std::optional<SeenSegment> seen_segment(const Lens& lens, const Vec3& from, const Vec3& to) {
  glm::dvec4 a = lens.clip * glm::dvec4(from, 1.0), b = lens.clip * glm::dvec4(to, 1.0);
  const double w = least_w * std::max(std::abs(a.w), std::abs(b.w));
  if (a.w <= w && b.w <= w) return std::nullopt;
  if (a.w <= w) a = glm::mix(a, b, (w - a.w) / (b.w - a.w));
  if (b.w <= w) b = glm::mix(b, a, (w - b.w) / (a.w - b.w));
  return SeenSegment{to_picture(a, lens.size), to_picture(b, lens.size)};
}

// Place on the segment nearest to p, as a share of its length, and the distance to it.
struct Nearest {
  double share, distance;
};
Nearest nearest_on(const SeenSegment& segment, const glm::dvec2& p) {
  const glm::dvec2 along = segment.to - segment.from;
  const double squared = glm::dot(along, along);
  const double share = squared > 0.0 ? std::clamp(glm::dot(p - segment.from, along) / squared, 0.0, 1.0) : 0.0;
  return {share, glm::distance(p, segment.from + share * along)};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

bool cross_each_other(const SeenSegment& a, const SeenSegment& b) {
  const glm::dvec2 along_a = a.to - a.from, along_b = b.to - b.from;
  return cross(along_a, b.from - a.from) * cross(along_a, b.to - a.from) <= 0.0 &&
         cross(along_b, a.from - b.from) * cross(along_b, a.to - b.from) < 0.0;
}

// Distances from the line's origin to where it enters each shape from outside; infinity when it does not.

double distance_to(const Plane& plane, const SightLine& line, Vec3& normal) {
  normal = plane.normal;
  const double approach = -glm::dot(line.direction, plane.normal);
  const double height = glm::dot(line.origin - plane.point, plane.normal);
  return approach > 0.0 && height > 0.0 ? height / approach : infinity;
}

// |o + t d - c| = r with |d| = 1, the smaller root.
double distance_to(const Vec3& center, double radius, const SightLine& line) {
  const Vec3 to_center = center - line.origin;
  const double along = glm::dot(to_center, line.direction);
  const Vec3 miss = to_center - along * line.direction;
  const double half_chord_squared = radius * radius - glm::dot(miss, miss);
  if (half_chord_squared < 0.0) return infinity;
  const double distance = along - std::sqrt(half_chord_squared);
  return distance > 0.0 ? distance : infinity;
}

double distance_to(const Sphere& sphere, const SightLine& line, Vec3& normal) {
  const double distance = distance_to(sphere.center, sphere.radius, line);
  if (distance < infinity) normal = (line.at(distance) - sphere.center) / sphere.radius;
  return distance;
}

// Slabs: the line is inside the box where it is between all three pairs of sides.
double distance_to(const Box& box, const SightLine& line, Vec3& normal) {
  double enter = 0.0, leave = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = line.direction[axis], origin = line.origin[axis];
    if (direction == 0.0) {
      if (origin < box.least[axis] || origin > box.most[axis]) return infinity;
      continue;
    }
    const double near_side = direction > 0.0 ? box.least[axis] : box.most[axis];
    const double far_side = direction > 0.0 ? box.most[axis] : box.least[axis];
    const double in = (near_side - origin) / direction;
    if (in > enter) {
      enter = in;
      normal = Vec3(0.0);
      normal[axis] = direction > 0.0 ? -1.0 : 1.0;
    }
    leave = std::min(leave, (far_side - origin) / direction);
  }
  return enter > 0.0 && enter < leave ? enter : infinity;
}

// Of a place in the plane of a 2-D scene.
bool lies_in(const Collider& collider, const Vec3& place) {
  return std::visit(
      Overloaded{
          [&](const Plane& plane) { return glm::dot(glm::dvec2(place) - glm::dvec2(plane.point), glm::dvec2(plane.normal)) < 0.0; },
          [&](const Sphere& sphere) { return glm::distance(glm::dvec2(place), glm::dvec2(sphere.center)) < sphere.radius; },
          [&](const Box& box) { return place.x > box.least.x && place.x < box.most.x && place.y > box.least.y && place.y < box.most.y; },
      },
      collider.shape);
}

// The faces that are seen within `reach` [px] of the cursor: all that can hide something there.
class FacesNear {
 public:
  FacesNear(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor, double reach) : snapshot_(snapshot) {
    const System& system = *snapshot.system;
    if (system.faces.empty()) return;
    std::vector<glm::dvec4> clip;
    clip.reserve(snapshot.state.position.size());
    for (const Vec3& place : snapshot.state.position) clip.push_back(lens.clip * glm::dvec4(place, 1.0));
    for (const Face& face : system.faces) {
      const std::array<Index, 3> corners{system.index_of(face.points[0]), system.index_of(face.points[1]), system.index_of(face.points[2])};
      glm::dvec2 least(infinity), most(-infinity);
      bool passes_viewer = false;
      for (const Index i : corners) {
        passes_viewer = passes_viewer || !(clip[i].w > 0.0);
        least = glm::min(least, to_picture(clip[i], lens.size));
        most = glm::max(most, to_picture(clip[i], lens.size));
      }
      const bool is_near = glm::all(glm::greaterThanEqual(cursor, least - reach)) && glm::all(glm::lessThanEqual(cursor, most + reach));
      if (is_near || passes_viewer) faces_.push_back({corners, face.points});
    }
  }

  struct Hit {
    double distance = infinity;  // [m], along the line
    Patch patch;
  };
  // Where the line first meets one from either side     (T. Moeller, B. Trumbore, Fast, minimum storage ray-triangle
  // intersection, J. Graphics Tools 2 (1997)): o + t d = (1 - u - v) a + u b + v c
  Hit first_hit(const SightLine& line) const {
    constexpr double seam = 1e-9;  // of a face, by which it reaches over its edges: there are no gaps between faces
    Hit first;
    for (const auto& [corners, ids] : faces_) {
      const Vec3 &a = position(corners[0]), &b = position(corners[1]), &c = position(corners[2]);
      const Vec3 p = glm::cross(line.direction, c - a);
      const double determinant = glm::dot(b - a, p);
      if (determinant == 0.0) continue;
      const Vec3 from_a = line.origin - a, q = glm::cross(from_a, b - a);
      const double u = glm::dot(from_a, p) / determinant, v = glm::dot(line.direction, q) / determinant;
      if (!(u >= -seam && v >= -seam && u + v <= 1.0 + seam)) continue;
      const double distance = glm::dot(c - a, q) / determinant;
      if (!(distance > 0.0 && distance < first.distance)) continue;
      const double second = std::clamp(u, 0.0, 1.0), third = std::clamp(v, 0.0, 1.0 - second);
      first = {distance, {ids, {1.0 - second - third, second, third}}};
    }
    return first;
  }

 private:
  const Vec3& position(Index i) const { return snapshot_.state.position[i]; }

  struct NearFace {
    std::array<Index, 3> corners;
    std::array<PointId, 3> ids;
  };
  const Snapshot& snapshot_;
  std::vector<NearFace> faces_;
};

// The faces that hide, for a picture that shows them.
std::optional<FacesNear> hiding_faces(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor, double reach) {
  if (!lens.shows_surface || snapshot.system->dimensions == 2) return std::nullopt;
  return FacesNear(snapshot, lens, cursor, reach);
}

// Whether a collider or a face stands before this place, which may itself lie `radius` deep in one. In a 2-D scene nothing
// does.
bool is_hidden(const Snapshot& snapshot, const Lens& lens, const std::optional<FacesNear>& faces, const Vec3& place, double radius) {
  if (snapshot.system->dimensions == 2 || (snapshot.system->colliders.empty() && !faces)) return false;
  const std::optional<glm::dvec2> seen = seen_at(lens, place);
  if (!seen) return true;
  const SightLine line = sight_line(lens, *seen);
  const std::optional<ColliderHit> hit = hit_collider(*snapshot.system, line, snapshot.state.time);
  const double distance = glm::dot(place - line.origin, line.direction), before = distance * (1.0 - 1e-6) - radius;
  return (hit && hit->distance < before) || (faces && faces->first_hit(line).distance < before);
}

}  // namespace

SightLine sight_line(const Lens& lens, const glm::dvec2& cursor) {
  const glm::dmat4 world = glm::inverse(lens.clip);
  const double x = 2.0 * cursor.x / lens.size.x - 1.0, y = 1.0 - 2.0 * cursor.y / lens.size.y;
  const glm::dvec4 front = world * glm::dvec4(x, y, -1.0, 1.0), behind = world * glm::dvec4(x, y, 0.0, 1.0);
  const Vec3 origin = Vec3(front) / front.w;
  return {origin, glm::normalize(Vec3(behind) / behind.w - origin)};
}

std::optional<glm::dvec2> seen_at(const Lens& lens, const Vec3& place) {
  const glm::dvec4 clip = lens.clip * glm::dvec4(place, 1.0);
  if (clip.w <= 0.0) return std::nullopt;
  return to_picture(clip, lens.size);
}

std::optional<ColliderHit> hit_collider(const System& system, const SightLine& line, double time) {
  std::optional<ColliderHit> nearest;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    if (!system.colliders[c].solid) continue;
    const Collider collider = moved_at(system.colliders[c], time);
    Vec3 normal(0.0);
    const double distance = std::visit([&](const auto& shape) { return distance_to(shape, line, normal); }, collider.shape);
    if (distance < (nearest ? nearest->distance : infinity))
      nearest = ColliderHit{distance, line.at(distance), normal, !std::holds_alternative<Plane>(collider.shape), static_cast<Index>(c)};
  }
  return nearest;
}

std::optional<ColliderHit> pick_collider(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor) {
  const System& system = *snapshot.system;
  const SightLine line = sight_line(lens, cursor);
  if (system.dimensions == 3) {
    const std::optional<ColliderHit> hit = hit_collider(system, line, snapshot.state.time);
    const bool is_behind = hit && lens.shows_surface && FacesNear(snapshot, lens, cursor, 0.0).first_hit(line).distance < hit->distance;
    return is_behind ? std::nullopt : hit;
  }
  if (line.direction.z == 0.0) return std::nullopt;
  const double distance = -line.origin.z / line.direction.z;
  const Vec3 place = line.at(distance);
  for (std::size_t c = system.colliders.size(); c-- > 0;) {
    const Collider collider = moved_at(system.colliders[c], snapshot.state.time);
    if (collider.solid && lies_in(collider, place))
      return ColliderHit{distance, place, Vec3(0.0, 0.0, 1.0), !std::holds_alternative<Plane>(collider.shape), static_cast<Index>(c)};
  }
  return std::nullopt;
}

std::optional<PointId> pick_point(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor, double reach) {
  const std::vector<Point>& points = snapshot.system->points();
  const SightLine line = sight_line(lens, cursor);
  const std::optional<FacesNear> faces = hiding_faces(snapshot, lens, cursor, reach);
  std::optional<PointId> under, beside;
  double front = infinity, nearest = reach;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& place = snapshot.state.position[i];

    // under the cursor: the ball whose front is nearest to the viewer
    const double distance = distance_to(place, points[i].radius, line);
    if (distance < front && !is_hidden(snapshot, lens, faces, place, points[i].radius)) {
      front = distance;
      under = points[i].id;
    }
    if (under) continue;

    // beside it: the nearest in the picture
    const std::optional<glm::dvec2> seen = seen_at(lens, place);
    const double gap = seen ? glm::distance(*seen, cursor) : infinity;
    if (gap <= nearest && !is_hidden(snapshot, lens, faces, place, points[i].radius)) {
      nearest = gap;
      beside = points[i].id;
    }
  }
  return under ? under : beside;
}

std::optional<SurfaceHit> pick_surface(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor) {
  const SightLine line = sight_line(lens, cursor);
  const FacesNear::Hit hit = FacesNear(snapshot, lens, cursor, 0.0).first_hit(line);
  if (!(hit.distance < infinity)) return std::nullopt;
  const std::optional<ColliderHit> collider =
      snapshot.system->dimensions == 2 ? std::nullopt : hit_collider(*snapshot.system, line, snapshot.state.time);
  if (collider && collider->distance < hit.distance) return std::nullopt;
  return SurfaceHit{hit.patch, line.at(hit.distance)};
}

std::optional<SpringId> pick_spring(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& cursor, double reach) {
  const std::optional<FacesNear> faces = hiding_faces(snapshot, lens, cursor, reach);
  std::optional<SpringId> picked;
  double nearest = reach;
  for (const Spring& spring : snapshot.system->springs()) {
    const Vec3 &from = snapshot.position(spring.first), &to = snapshot.position(spring.second);
    const std::optional<SeenSegment> seen = seen_segment(lens, from, to);
    if (!seen) continue;
    const Nearest place = nearest_on(*seen, cursor);
    if (place.distance <= nearest && !is_hidden(snapshot, lens, faces, glm::mix(from, to, place.share), 0.0)) {
      nearest = place.distance;
      picked = spring.id;
    }
  }
  return picked;
}

std::vector<PointId> points_in_box(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& corner, const glm::dvec2& opposite) {
  const glm::dvec2 least = glm::min(corner, opposite), most = glm::max(corner, opposite);
  std::vector<PointId> inside;
  for (Index i = 0; i < snapshot.system->point_count(); ++i) {
    const std::optional<glm::dvec2> seen = seen_at(lens, snapshot.state.position[i]);
    if (seen && seen->x >= least.x && seen->x <= most.x && seen->y >= least.y && seen->y <= most.y)
      inside.push_back(snapshot.system->points()[i].id);
  }
  std::ranges::sort(inside);
  return inside;
}

std::vector<SpringId> springs_across(const Snapshot& snapshot, const Lens& lens, const glm::dvec2& from, const glm::dvec2& to) {
  std::vector<SpringId> crossed;
  for (const Spring& spring : snapshot.system->springs()) {
    const std::optional<SeenSegment> seen = seen_segment(lens, snapshot.position(spring.first), snapshot.position(spring.second));
    if (seen && cross_each_other(*seen, {from, to})) crossed.push_back(spring.id);
  }
  return crossed;
}

}  // namespace hooke
