#include "scene/pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "base/overloaded.h"

namespace hooke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The part of a segment in front of the viewer is where the clip coordinate w exceeds this fraction of its larger end value.
constexpr double min_w = 1e-9;

glm::dvec2 clip_to_screen(const glm::dvec4& clip, const glm::dvec2& size) {
  return {(0.5 + 0.5 * clip.x / clip.w) * size.x, (0.5 - 0.5 * clip.y / clip.w) * size.y};
}

// The projection of a segment, clipped where it passes behind the viewer; none if all of it is behind.
struct ScreenSegment {
  glm::dvec2 from, to;
};
std::optional<ScreenSegment> project_segment(const ViewTransform& view_transform, const Vec3& from, const Vec3& to) {
  glm::dvec4 a = view_transform.clip * glm::dvec4(from, 1.0), b = view_transform.clip * glm::dvec4(to, 1.0);
  const double w = min_w * std::max(std::abs(a.w), std::abs(b.w));
  if (a.w <= w && b.w <= w) return std::nullopt;
  if (a.w <= w) a = glm::mix(a, b, (w - a.w) / (b.w - a.w));
  if (b.w <= w) b = glm::mix(b, a, (w - b.w) / (a.w - b.w));
  return ScreenSegment{clip_to_screen(a, view_transform.size), clip_to_screen(b, view_transform.size)};
}

// The point of the segment nearest to p, as a fraction of its length, and its distance.
struct Nearest {
  double fraction, distance;
};
Nearest nearest_on(const ScreenSegment& segment, const glm::dvec2& p) {
  const glm::dvec2 along = segment.to - segment.from;
  const double squared = glm::dot(along, along);
  const double fraction = squared > 0.0 ? std::clamp(glm::dot(p - segment.from, along) / squared, 0.0, 1.0) : 0.0;
  return {fraction, glm::distance(p, segment.from + fraction * along)};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

bool segments_cross(const ScreenSegment& a, const ScreenSegment& b) {
  const glm::dvec2 along_a = a.to - a.from, along_b = b.to - b.from;
  return cross(along_a, b.from - a.from) * cross(along_a, b.to - a.from) <= 0.0 &&
         cross(along_b, a.from - b.from) * cross(along_b, a.to - b.from) < 0.0;
}

// Distances from the origin of the ray to its entry into each shape from outside; infinity if there is none.

double distance_to(const Plane& plane, const PickRay& ray, Vec3& normal) {
  normal = plane.normal;
  const double approach = -glm::dot(ray.direction, plane.normal);
  const double height = glm::dot(ray.origin - plane.point, plane.normal);
  return approach > 0.0 && height > 0.0 ? height / approach : infinity;
}

// |o + t d - c| = r with |d| = 1, the smaller root.
double distance_to(const Vec3& center, double radius, const PickRay& ray) {
  const Vec3 to_center = center - ray.origin;
  const double along = glm::dot(to_center, ray.direction);
  const Vec3 miss = to_center - along * ray.direction;
  const double half_chord_squared = radius * radius - glm::dot(miss, miss);
  if (half_chord_squared < 0.0) return infinity;
  const double distance = along - std::sqrt(half_chord_squared);
  return distance > 0.0 ? distance : infinity;
}

double distance_to(const Sphere& sphere, const PickRay& ray, Vec3& normal) {
  const double distance = distance_to(sphere.center, sphere.radius, ray);
  if (distance < infinity) normal = (ray.at(distance) - sphere.center) / sphere.radius;
  return distance;
}

// Slabs: the ray is inside the box where it is between all three pairs of sides.
double distance_to(const Box& box, const PickRay& ray, Vec3& normal) {
  double enter = 0.0, leave = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = ray.direction[axis], origin = ray.origin[axis];
    if (direction == 0.0) {
      if (origin < box.min[axis] || origin > box.max[axis]) return infinity;
      continue;
    }
    const double near_side = direction > 0.0 ? box.min[axis] : box.max[axis];
    const double far_side = direction > 0.0 ? box.max[axis] : box.min[axis];
    const double entry = (near_side - origin) / direction;
    if (entry > enter) {
      enter = entry;
      normal = Vec3(0.0);
      normal[axis] = direction > 0.0 ? -1.0 : 1.0;
    }
    leave = std::min(leave, (far_side - origin) / direction);
  }
  return enter > 0.0 && enter < leave ? enter : infinity;
}

// For a position in the plane of a 2-D scene.
bool contains(const Collider& collider, const Vec3& place) {
  return std::visit(
      Overloaded{
          [&](const Plane& plane) { return glm::dot(glm::dvec2(place) - glm::dvec2(plane.point), glm::dvec2(plane.normal)) < 0.0; },
          [&](const Sphere& sphere) { return glm::distance(glm::dvec2(place), glm::dvec2(sphere.center)) < sphere.radius; },
          [&](const Box& box) { return place.x > box.min.x && place.x < box.max.x && place.y > box.min.y && place.y < box.max.y; },
      },
      collider.shape);
}

// The visible faces within `reach` [px] of the cursor, which are all that can hide something there.
class FacesNearCursor {
 public:
  FacesNearCursor(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor, double pick_radius)
      : snapshot_(snapshot) {
    const System& system = *snapshot.system;
    if (system.faces.empty()) return;
    std::vector<glm::dvec4> clip;
    clip.reserve(snapshot.state.position.size());
    for (const Vec3& place : snapshot.state.position) clip.push_back(view_transform.clip * glm::dvec4(place, 1.0));
    for (const Face& face : system.faces) {
      const std::array<Index, 3> corners{system.index_of(face.points[0]), system.index_of(face.points[1]), system.index_of(face.points[2])};
      glm::dvec2 min(infinity), max(-infinity);
      bool crosses_camera_plane = false;
      for (const Index i : corners) {
        crosses_camera_plane = crosses_camera_plane || !(clip[i].w > 0.0);
        min = glm::min(min, clip_to_screen(clip[i], view_transform.size));
        max = glm::max(max, clip_to_screen(clip[i], view_transform.size));
      }
      const bool is_near =
          glm::all(glm::greaterThanEqual(cursor, min - pick_radius)) && glm::all(glm::lessThanEqual(cursor, max + pick_radius));
      if (is_near || crosses_camera_plane) faces_.push_back({corners, face.points});
    }
  }

  struct Hit {
    double distance = infinity;  // [m], along the ray
    Patch patch;
  };
  // Where the line first meets one from either side     (T. Moeller, B. Trumbore, Fast, minimum storage ray-triangle
  // intersection, J. Graphics Tools 2 (1997)): o + t d = (1 - u - v) a + u b + v c
  Hit nearest_hit(const PickRay& ray) const {
    constexpr double edge_tolerance = 1e-9;  // relative extension of a face beyond its edges, so that there are no gaps between faces
    Hit first;
    for (const auto& [corners, ids] : faces_) {
      const Vec3 &a = position(corners[0]), &b = position(corners[1]), &c = position(corners[2]);
      const Vec3 p = glm::cross(ray.direction, c - a);
      const double determinant = glm::dot(b - a, p);
      if (determinant == 0.0) continue;
      const Vec3 from_a = ray.origin - a, q = glm::cross(from_a, b - a);
      const double u = glm::dot(from_a, p) / determinant, v = glm::dot(ray.direction, q) / determinant;
      if (!(u >= -edge_tolerance && v >= -edge_tolerance && u + v <= 1.0 + edge_tolerance)) continue;
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

// The faces that hide other items, if faces are shown.
std::optional<FacesNearCursor> occluding_faces(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                               double pick_radius) {
  if (!view_transform.shows_surface || snapshot.system->dimensions == 2) return std::nullopt;
  return FacesNearCursor(snapshot, view_transform, cursor, pick_radius);
}

// Whether a collider or a face is in front of this position, which may itself be up to `radius` inside one. False in a 2-D scene.
bool is_occluded(const Snapshot& snapshot, const ViewTransform& view_transform, const std::optional<FacesNearCursor>& faces,
                 const Vec3& place, double radius) {
  if (snapshot.system->dimensions == 2 || (snapshot.system->colliders.empty() && !faces)) return false;
  const std::optional<glm::dvec2> on_screen = project_to_screen(view_transform, place);
  if (!on_screen) return true;
  const PickRay ray = pick_ray(view_transform, *on_screen);
  const std::optional<ColliderHit> hit = hit_collider(*snapshot.system, snapshot.state, ray);
  const double distance = glm::dot(place - ray.origin, ray.direction), before = distance * (1.0 - 1e-6) - radius;
  return (hit && hit->distance < before) || (faces && faces->nearest_hit(ray).distance < before);
}

}  // namespace

PickRay pick_ray(const ViewTransform& view_transform, const glm::dvec2& cursor) {
  const glm::dmat4 world = glm::inverse(view_transform.clip);
  const double x = 2.0 * cursor.x / view_transform.size.x - 1.0, y = 1.0 - 2.0 * cursor.y / view_transform.size.y;
  const glm::dvec4 front = world * glm::dvec4(x, y, -1.0, 1.0), behind = world * glm::dvec4(x, y, 0.0, 1.0);
  const Vec3 origin = Vec3(front) / front.w;
  return {origin, glm::normalize(Vec3(behind) / behind.w - origin)};
}

std::optional<glm::dvec2> project_to_screen(const ViewTransform& view_transform, const Vec3& place) {
  const glm::dvec4 clip = view_transform.clip * glm::dvec4(place, 1.0);
  if (clip.w <= 0.0) return std::nullopt;
  return clip_to_screen(clip, view_transform.size);
}

std::optional<ColliderHit> hit_collider(const System& system, const State& state, const PickRay& ray) {
  std::optional<ColliderHit> nearest;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    if (!system.colliders[c].solid) continue;
    const Collider collider = current_collider(system, state, c);
    Vec3 normal(0.0);
    const double distance = std::visit([&](const auto& shape) { return distance_to(shape, ray, normal); }, collider.shape);
    if (distance < (nearest ? nearest->distance : infinity))
      nearest = ColliderHit{distance, ray.at(distance), normal, !std::holds_alternative<Plane>(collider.shape), static_cast<Index>(c)};
  }
  return nearest;
}

std::optional<ColliderHit> pick_collider(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor) {
  const System& system = *snapshot.system;
  const PickRay ray = pick_ray(view_transform, cursor);
  if (system.dimensions == 3) {
    const std::optional<ColliderHit> hit = hit_collider(system, snapshot.state, ray);
    const bool is_behind = hit && view_transform.shows_surface &&
                           FacesNearCursor(snapshot, view_transform, cursor, 0.0).nearest_hit(ray).distance < hit->distance;
    return is_behind ? std::nullopt : hit;
  }
  if (ray.direction.z == 0.0) return std::nullopt;
  const double distance = -ray.origin.z / ray.direction.z;
  const Vec3 place = ray.at(distance);
  for (std::size_t c = system.colliders.size(); c-- > 0;) {
    const Collider collider = current_collider(system, snapshot.state, c);
    if (collider.solid && contains(collider, place))
      return ColliderHit{distance, place, Vec3(0.0, 0.0, 1.0), !std::holds_alternative<Plane>(collider.shape), static_cast<Index>(c)};
  }
  return std::nullopt;
}

std::optional<PointId> pick_point(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                  double pick_radius) {
  const std::vector<Point>& points = snapshot.system->points();
  const PickRay ray = pick_ray(view_transform, cursor);
  const std::optional<FacesNearCursor> faces = occluding_faces(snapshot, view_transform, cursor, pick_radius);
  std::optional<PointId> under_cursor, nearest_id;
  double front = infinity, nearest = pick_radius;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& place = snapshot.state.position[i];

    // under the cursor: the ball whose surface is nearest to the viewer
    const double distance = distance_to(place, points[i].radius, ray);
    if (distance < front && !is_occluded(snapshot, view_transform, faces, place, points[i].radius)) {
      front = distance;
      under_cursor = points[i].id;
    }
    if (under_cursor) continue;

    // otherwise the nearest in the picture
    const std::optional<glm::dvec2> on_screen = project_to_screen(view_transform, place);
    const double gap = on_screen ? glm::distance(*on_screen, cursor) : infinity;
    if (gap <= nearest && !is_occluded(snapshot, view_transform, faces, place, points[i].radius)) {
      nearest = gap;
      nearest_id = points[i].id;
    }
  }
  return under_cursor ? under_cursor : nearest_id;
}

std::optional<SurfaceHit> pick_surface(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor) {
  const PickRay ray = pick_ray(view_transform, cursor);
  const FacesNearCursor::Hit hit = FacesNearCursor(snapshot, view_transform, cursor, 0.0).nearest_hit(ray);
  if (!(hit.distance < infinity)) return std::nullopt;
  const std::optional<ColliderHit> collider =
      snapshot.system->dimensions == 2 ? std::nullopt : hit_collider(*snapshot.system, snapshot.state, ray);
  if (collider && collider->distance < hit.distance) return std::nullopt;
  return SurfaceHit{hit.patch, ray.at(hit.distance)};
}

std::optional<SpringId> pick_spring(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& cursor,
                                    double pick_radius) {
  const std::optional<FacesNearCursor> faces = occluding_faces(snapshot, view_transform, cursor, pick_radius);
  std::optional<SpringId> picked;
  double nearest = pick_radius;
  for (const Spring& spring : snapshot.system->springs()) {
    const Vec3 &from = snapshot.position(spring.first), &to = snapshot.position(spring.second);
    const std::optional<ScreenSegment> on_screen = project_segment(view_transform, from, to);
    if (!on_screen) continue;
    const Nearest place = nearest_on(*on_screen, cursor);
    if (place.distance <= nearest && !is_occluded(snapshot, view_transform, faces, glm::mix(from, to, place.fraction), 0.0)) {
      nearest = place.distance;
      picked = spring.id;
    }
  }
  return picked;
}

std::vector<PointId> points_within(const Snapshot& snapshot, const ViewTransform& view_transform, const std::vector<glm::dvec2>& outline) {
  // a line to the right crosses the outline an odd number of times
  const auto is_within = [&](const glm::dvec2& at) {
    bool within = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
      if ((a.y > at.y) != (b.y > at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) within = !within;
    }
    return within;
  };
  std::vector<PointId> inside;
  for (Index i = 0; i < snapshot.system->point_count(); ++i) {
    const std::optional<glm::dvec2> on_screen = project_to_screen(view_transform, snapshot.state.position[i]);
    if (on_screen && is_within(*on_screen)) inside.push_back(snapshot.system->points()[i].id);
  }
  std::ranges::sort(inside);
  return inside;
}

std::vector<SpringId> springs_across(const Snapshot& snapshot, const ViewTransform& view_transform, const glm::dvec2& from,
                                     const glm::dvec2& to) {
  std::vector<SpringId> crossed;
  for (const Spring& spring : snapshot.system->springs()) {
    const std::optional<ScreenSegment> on_screen =
        project_segment(view_transform, snapshot.position(spring.first), snapshot.position(spring.second));
    if (on_screen && segments_cross(*on_screen, {from, to})) crossed.push_back(spring.id);
  }
  return crossed;
}

}  // namespace hooke
