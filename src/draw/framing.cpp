// Where to put a camera so that a scene is seen.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <variant>

#include "draw/camera.h"

namespace hooke {
namespace {

constexpr double margin = 1.12;          // of the picture, around the scene
constexpr double smallest_radius = 0.2;  // [m], of what is framed: an empty scene is an empty stage of this size
constexpr double plane_reach = 6.0;      // a plane this many scene radii away is part of the scene

struct Extent {
  Vec3 least{std::numeric_limits<double>::infinity()}, most{-std::numeric_limits<double>::infinity()};

  void include(const Vec3& place, double around) {
    if (!std::isfinite(place.x + place.y + place.z)) return;
    least = glm::min(least, place - around);
    most = glm::max(most, place + around);
  }
  bool is_empty() const { return least.x > most.x; }
  Vec3 center() const { return 0.5 * (least + most); }
  double radius() const { return std::max(0.5 * glm::length(most - least), smallest_radius); }
};

// Points and bounded colliders; then the nearest place of each plane that is not far off.
Extent extent_of(const System& system, const State& state) {
  Extent extent;
  for (Index i = 0; i < system.point_count(); ++i) extent.include(state.position[i], system.points()[i].radius);
  for (const Collider& collider : system.colliders) {
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) extent.include(sphere->center, sphere->radius);
    if (const auto* box = std::get_if<Box>(&collider.shape)) {
      extent.include(box->least, 0.0);
      extent.include(box->most, 0.0);
    }
  }
  if (extent.is_empty()) extent.include(Vec3(0.0), 5.0 * smallest_radius);

  const Vec3 center = extent.center();
  const double near = plane_reach * extent.radius();
  for (const Collider& collider : system.colliders) {
    const auto* plane = std::get_if<Plane>(&collider.shape);
    if (!plane) continue;
    const double height = glm::dot(center - plane->point, plane->normal);
    if (std::abs(height) < near) extent.include(center - height * plane->normal, 0.0);
  }
  return extent;
}

// Nailed and free points together under gravity will hang: room below for as much as the scene is wide.
void make_room_to_hang(Extent& extent, const System& system) {
  const double strength = glm::length(system.gravity);
  const auto is_nailed = [](const Point& point) { return point.nailed; };
  const auto nails = std::count_if(system.points().begin(), system.points().end(), is_nailed);
  if (!(strength > 0.0) || nails == 0 || nails == system.point_count()) return;
  const Vec3 down = system.gravity / strength;
  const Vec3 size = extent.most - extent.least;
  const double height = std::abs(glm::dot(size, down));
  const double width = std::max({size.x, size.y, size.z});
  const Vec3 below = extent.center() + (width - 0.5 * height) * down;
  if (width > height) extent.include(below, 0.0);
}

// Moves the camera along its axis until the box just fits.
void fit(Camera& camera, const Extent& extent, double aspect) {
  camera.target = extent.center();
  const Vec3 right = glm::cross(camera.up, camera.back);
  const double slope = std::tan(0.5 * camera.field_of_view) / margin;
  const Vec3 half = glm::max(0.5 * (extent.most - extent.least), Vec3(1e-3 * smallest_radius));
  double distance = smallest_radius / slope;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 place = half * Vec3(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0);
    const double nearer = camera.orthographic ? 0.0 : glm::dot(place, camera.back);
    const double needed = std::max(std::abs(glm::dot(place, right)) / aspect, std::abs(glm::dot(place, camera.up)));
    distance = std::max(distance, needed / slope + nearer);
  }
  camera.distance = distance;
}

Vec3 upward(const ViewSettings& view, const System& system) {
  const Vec3 wanted = view.camera && view.camera->up ? *view.camera->up : -system.gravity;
  const double length = glm::length(wanted);
  return length > 0.0 && std::isfinite(length) ? wanted / length : Vec3(0.0, 1.0, 0.0);
}

// Looks along -back with the pole as upright as it can be.
void look(Camera& camera, const Vec3& back) {
  camera.back = back;
  Vec3 right = glm::cross(camera.pole, back);
  if (glm::length(right) < 1e-9) right = std::abs(back.x) < 0.9 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 0.0, 1.0);
  right = glm::normalize(right - glm::dot(right, back) * back);
  camera.up = glm::cross(back, right);
}

// A little from above and from the side: x mostly to the right.
Vec3 usual_back(const Vec3& pole) {
  const double azimuth = glm::radians(25.0), elevation = glm::radians(20.0);
  Vec3 right = Vec3(1.0, 0.0, 0.0) - pole.x * pole;
  right = glm::length(right) > 1e-6 ? glm::normalize(right) : Vec3(0.0, 0.0, -1.0);
  const Vec3 front = glm::cross(right, pole);
  return std::cos(elevation) * (std::cos(azimuth) * front + std::sin(azimuth) * right) + std::sin(elevation) * pole;
}

}  // namespace

Camera make_camera(const ViewSettings& view, const System& system, const State& state, double aspect) {
  Camera camera;
  camera.pole = upward(view, system);

  if (view.camera) {
    const Vec3 back = view.camera->eye - view.camera->target;
    const double distance = glm::length(back);
    camera.target = view.camera->target;
    camera.orthographic = view.camera->orthographic;
    if (distance > 0.0) camera.distance = distance;
    look(camera, distance > 0.0 ? back / distance : Vec3(0.0, 0.0, 1.0));
    return camera;
  }

  camera.orthographic = system.dimensions == 2;
  look(camera, system.dimensions == 2 ? Vec3(0.0, 0.0, 1.0) : usual_back(camera.pole));
  Extent extent = extent_of(system, state);
  make_room_to_hang(extent, system);
  fit(camera, extent, aspect);
  return camera;
}

void frame_scene(Camera& camera, const System& system, const State& state, double aspect) { fit(camera, extent_of(system, state), aspect); }

}  // namespace hooke
