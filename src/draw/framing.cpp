// Places a camera so that a scene is visible.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <variant>
#include <vector>

#include "draw/camera.h"

namespace hooke {
namespace {

constexpr double margin = 1.12;          // of the picture, around the scene
constexpr double smallest_radius = 0.2;  // [m], of the framed region, also of an empty scene
constexpr double plane_reach = 6.0;      // a plane this many scene radii away is part of the scene
constexpr double posed_aspect = 1.6;     // the poses of scenes are meant for pictures of this or a greater aspect ratio
constexpr double follow_fraction = 0.6;  // of half the height of the picture: maximum distance of the followed center from the middle

// A sphere that must be visible.
struct VisibleSphere {
  Vec3 place;
  double radius = 0.0;
};

struct Extent {
  Vec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  std::vector<VisibleSphere> spheres;

  void include(const Vec3& place, double radius = 0.0) {
    if (!std::isfinite(place.x + place.y + place.z)) return;
    min = glm::min(min, place - radius);
    max = glm::max(max, place + radius);
    spheres.push_back({place, radius});
  }
  Vec3 center() const { return 0.5 * (min + max); }
  double radius() const { return std::max(0.5 * glm::length(max - min), smallest_radius); }
};

void include_points(Extent& extent, const System& system, const State& state) {
  for (Index i = 0; i < system.point_count(); ++i) extent.include(state.position[i], system.points()[i].radius);
}

// The largest distance of a free point from its nearest nail [m], sampled from a few hundred of each; 0 without nails.
double longest_distance_to_nail(const System& system, const State& state) {
  std::vector<Vec3> nailed, free;
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3& place = state.position[i];
    if (std::isfinite(place.x + place.y + place.z)) (system.points()[i].nailed ? nailed : free).push_back(place);
  }
  if (nailed.empty()) return 0.0;
  constexpr std::size_t few = 512;
  double longest = 0.0;
  for (std::size_t i = 0; i < free.size(); i += 1 + free.size() / few) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < nailed.size(); n += 1 + nailed.size() / few)
      shortest = std::min(shortest, glm::distance(free[i], nailed[n]));
    longest = std::max(longest, shortest);
  }
  return longest;
}

// Leaves space below the nails for hanging points to fall, down to the floor.
void include_hanging_extent(Extent& extent, const System& system, const State& state) {
  const double strength = glm::length(system.gravity), displacement = longest_distance_to_nail(system, state);
  if (!(strength > 0.0) || !(displacement > 0.0)) return;
  const Vec3 down = system.gravity / strength;
  double lowest_nail = -std::numeric_limits<double>::infinity();
  for (Index i = 0; i < system.point_count(); ++i)
    if (system.points()[i].nailed) lowest_nail = std::max(lowest_nail, glm::dot(state.position[i], down));
  const Vec3 below = extent.center() + (lowest_nail + displacement - glm::dot(extent.center(), down)) * down;

  const auto is_closed = [&](const Collider& collider) {
    const auto* plane = std::get_if<Plane>(&collider.shape);
    return plane && glm::dot(below - plane->point, plane->normal) < 0.0;
  };
  if (std::none_of(system.colliders.begin(), system.colliders.end(), is_closed)) extent.include(below);
}

// Colliders displaced to the ends of their paths.
std::vector<Collider> include_collider_paths(const System& system, const State& state) {
  std::vector<Collider> all;
  for (const Collider& collider : carried_colliders(system, state)) {
    const ColliderPath& path = collider.path;
    if (path.amplitude == Vec3(0.0) || path.frequency == 0.0) {
      all.push_back(collider_at_time(collider, 0.0));
      continue;
    }
    all.push_back(translated(collider, path.amplitude));
    all.push_back(translated(collider, -path.amplitude));
  }
  return all;
}

// Bounded colliders, and the nearest point of each plane within reach.
void include_colliders(Extent& extent, const System& system, const State& state) {
  const std::vector<Collider> colliders = include_collider_paths(system, state);
  for (const Collider& collider : colliders) {
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) extent.include(sphere->center, sphere->radius);
    if (const auto* box = std::get_if<Box>(&collider.shape))
      for (int corner = 0; corner < 8; ++corner) extent.include(box->corner(corner));
  }
  if (extent.spheres.empty()) extent.include(Vec3(0.0), 5.0 * smallest_radius);

  const Vec3 center = extent.center();
  const double near = plane_reach * extent.radius();
  for (const Collider& collider : colliders) {
    const auto* plane = std::get_if<Plane>(&collider.shape);
    if (!plane) continue;
    const double height = glm::dot(center - plane->point, plane->normal);
    if (std::abs(height) < near) extent.include(center - height * plane->normal);
  }
}

// Constraints of the sights along one axis of the picture, with coordinate s along it and z towards the viewer. The picture extends +-slope
// per meter of depth, so all sights are visible from an eye at (s, z) if max(s_i + r_i + slope z_i) - slope z <= s <= min(s_i - r_i - slope
// z_i) + slope z
struct Axis {
  double slope;  // 0: orthographic
  double max = -std::numeric_limits<double>::infinity(), min = std::numeric_limits<double>::infinity();

  void include(double s, double z, double radius) {
    max = std::max(max, s + radius + slope * z);
    min = std::min(min, s - radius - slope * z);
  }
  double middle() const { return 0.5 * (max + min); }
  double reach() const { return 0.5 * (max - min); }
};

// Moves the camera, without turning it, so that the sights just fit.
void fit(Camera& camera, const Extent& extent, double aspect) {
  const Vec3 right = glm::cross(camera.up, camera.back), middle = extent.center();
  const double slope = std::tan(0.5 * camera.field_of_view) / margin;
  const double depth_slope = camera.orthographic ? 0.0 : slope;
  Axis across{depth_slope * aspect}, upward{depth_slope};
  double farthest = 0.0, nearest = 0.0;  // towards the viewer, from the middle
  for (const VisibleSphere& visible_sphere : extent.spheres) {
    const Vec3 place = visible_sphere.place - middle;
    const double z = glm::dot(place, camera.back);
    across.include(glm::dot(place, right), z, visible_sphere.radius);
    upward.include(glm::dot(place, camera.up), z, visible_sphere.radius);
    nearest = std::max(nearest, z + visible_sphere.radius);
    farthest = std::min(farthest, z - visible_sphere.radius);
  }

  // The axis that needs more distance decides; the target is in the middle of the depth range.
  const double eye = std::max(across.reach() / (slope * aspect), upward.reach() / slope);
  const double target = camera.orthographic ? 0.0 : 0.5 * (nearest + farthest);
  camera.target = middle + across.middle() * right + upward.middle() * camera.up + target * camera.back;
  camera.distance = std::max(eye - target, smallest_radius / slope);
}

Vec3 upward(const ViewSettings& view, const System& system) {
  const Vec3 wanted = view.camera && view.camera->up ? *view.camera->up : -system.gravity;
  const double length = glm::length(wanted);
  return length > 0.0 && std::isfinite(length) ? wanted / length : Vec3(0.0, 1.0, 0.0);
}

// Looks along -back, with the pole as upright as possible.
void look(Camera& camera, const Vec3& back) {
  camera.back = back;
  Vec3 right = glm::cross(camera.pole, back);
  if (glm::length(right) < 1e-9) right = std::abs(back.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  right = glm::normalize(right - glm::dot(right, back) * back);
  camera.up = glm::cross(back, right);
}

// Slightly from above and from the side, with x mostly to the right.
Vec3 default_back(const Vec3& pole) {
  const double azimuth = glm::radians(25.0), elevation = glm::radians(20.0);
  Vec3 right = Vec3(1.0, 0.0, 0.0) - pole.x * pole;
  right = glm::length(right) > 1e-6 ? glm::normalize(right) : Vec3(0.0, 0.0, -1.0);
  const Vec3 front = glm::cross(right, pole);
  return std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * right) + std::sin(elevation) * pole;
}

}  // namespace

double grid_spacing(const Camera& camera) { return std::pow(10.0, std::floor(std::log10(0.6 * camera.distance)) - 1.0); }

Camera make_camera(const ViewSettings& view, const System& system, const State& state, double aspect) {
  Camera camera;
  camera.pole = upward(view, system);

  if (view.camera) {
    const Vec3 back = view.camera->eye - view.camera->target;
    const double distance = glm::length(back);
    camera.target = view.camera->target;
    camera.orthographic = view.camera->orthographic;
    camera.follows = view.camera->follows;
    if (distance > 0.0) camera.distance = distance;
    look(camera, distance > 0.0 ? back / distance : Vec3(0.0, 0.0, 1.0));
    return camera;
  }

  camera.orthographic = system.dimensions == 2;
  look(camera, system.dimensions == 2 ? Vec3(0.0, 0.0, 1.0) : default_back(camera.pole));
  Extent extent;
  include_points(extent, system, state);
  include_hanging_extent(extent, system, state);
  include_colliders(extent, system, state);
  fit(camera, extent, aspect);
  return camera;
}

Camera make_scene_camera(const ViewSettings& view, const System& system, const State& state, double aspect) {
  Camera camera = make_camera(view, system, state, aspect);
  if (view.camera) camera.distance *= std::max(1.0, posed_aspect / aspect);
  return camera;
}

void follow_scene(Camera& camera, const State& state) {
  if (!camera.follows) return;
  Vec3 sum(0.0);
  int counted = 0;
  for (const Vec3& place : state.position) {
    if (!std::isfinite(place.x + place.y + place.z)) continue;
    sum += place;
    ++counted;
  }
  if (counted == 0) return;

  // The distance beyond that fraction of the picture. Motion in depth is followed completely.
  const Vec3 displacement = sum / static_cast<double>(counted) - camera.target;
  const double max = follow_fraction * std::tan(0.5 * camera.field_of_view) * camera.distance;
  for (const Vec3& axis : {glm::cross(camera.up, camera.back), camera.up}) {
    const double along = glm::dot(displacement, axis);
    camera.target += (along - std::clamp(along, -max, max)) * axis;
  }
  camera.target += glm::dot(displacement, camera.back) * camera.back;
}

void frame_scene(Camera& camera, const System& system, const State& state, double aspect) {
  Extent extent;
  include_points(extent, system, state);
  include_colliders(extent, system, state);
  fit(camera, extent, aspect);
}

}  // namespace hooke
