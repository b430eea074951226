#include "draw/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace hooke {
namespace {

// Clip planes, relative to the distance of the target. A 24-bit depth buffer resolves 6e-6 of that distance at the target.
constexpr double perspective_near = 0.01, perspective_far = 1000.0;
constexpr double orthographic_reach = 50.0;  // to both sides of the target

constexpr double min_distance = 1e-6, max_distance = 1e9;  // [m]

double half_height(const Camera& camera) { return camera.distance * std::tan(0.5 * camera.field_of_view); }

// The component of v perpendicular to the unit vector n, normalized; `otherwise` if it vanishes.
Vec3 flatten(const Vec3& v, const Vec3& n, const Vec3& otherwise) {
  const Vec3 flat = v - glm::dot(v, n) * n;
  const double length = glm::length(flat);
  return length > 1e-9 * glm::length(v) && std::isfinite(length) ? flat / length : otherwise;
}

// A unit vector perpendicular to the unit vector n, close to x if possible.
Vec3 any_normal_to(const Vec3& n) { return flatten({1.0, 0.0, 0.0}, n, {0.0, 0.0, -1.0}); }

// From -1 at the left and bottom to 1 at the right and top.
glm::dvec2 to_device(const glm::dvec2& cursor, const glm::dvec2& size) {
  return {2.0 * cursor.x / size.x - 1.0, 1.0 - 2.0 * cursor.y / size.y};
}

double aspect_of(const glm::dvec2& size) { return size.x / size.y; }

Vec3 right_of(const Camera& camera) { return glm::cross(camera.up, camera.back); }

}  // namespace

glm::dmat4 Camera::view_matrix() const {
  const Vec3 right = right_of(*this);
  const Vec3 origin = eye();
  return {{right.x, up.x, back.x, 0.0},
          {right.y, up.y, back.y, 0.0},
          {right.z, up.z, back.z, 0.0},
          {-glm::dot(right, origin), -glm::dot(up, origin), -glm::dot(back, origin), 1.0}};
}

glm::dmat4 Camera::projection_matrix(double aspect) const {
  if (!orthographic) return glm::perspective(field_of_view, aspect, perspective_near * distance, perspective_far * distance);
  const double top = half_height(*this);
  const double reach = orthographic_reach * distance;
  return glm::ortho(-top * aspect, top * aspect, -top, top, distance - reach, distance + reach);
}

Ray Camera::ray_through(const glm::dvec2& cursor, const glm::dvec2& size) const {
  const glm::dvec2 device = to_device(cursor, size);
  const double top = half_height(*this);
  const Vec3 across = device.x * top * aspect_of(size) * right_of(*this) + device.y * top * up;
  if (orthographic) return {target + across + orthographic_reach * distance * back, -back};
  return {eye(), glm::normalize(across - distance * back)};
}

Vec3 Camera::project(const Vec3& world, const glm::dvec2& size) const {
  const Vec3 from_target = world - target;
  const double depth = distance - glm::dot(from_target, back);
  const double top = half_height(*this) * (orthographic ? 1.0 : depth / distance);
  if (!(top > 0.0)) {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    return {nowhere, nowhere, 2.0};
  }
  const double x = glm::dot(from_target, right_of(*this)) / (top * aspect_of(size));
  const double y = glm::dot(from_target, up) / top;
  const glm::dmat4 projection = projection_matrix(aspect_of(size));
  const double z = (projection[3][2] - projection[2][2] * depth) / (orthographic ? 1.0 : depth);
  return {0.5 * (x + 1.0) * size.x, 0.5 * (1.0 - y) * size.y, 0.5 * (z + 1.0)};
}

Vec3 Camera::unproject(const glm::dvec2& cursor, const glm::dvec2& size, const Vec3& through) const {
  const Ray ray = ray_through(cursor, size);
  const double along = glm::dot(through - ray.origin, back) / glm::dot(ray.direction, back);
  return ray.origin + along * ray.direction;
}

double Camera::meters_per_pixel(const Vec3& at, const glm::dvec2& size) const {
  const double depth = distance - glm::dot(at - target, back);
  return 2.0 * half_height(*this) / size.y * (orthographic ? 1.0 : std::max(depth, 0.0) / distance);
}

void Camera::orbit(double yaw, double pitch) {
  // right and level span the horizon; back = cos(elevation) level + sin(elevation) pole
  const Vec3 right = flatten(right_of(*this), pole, any_normal_to(pole));
  const double elevation = std::asin(std::clamp(glm::dot(back, pole), -1.0, 1.0));
  const double steepest = 0.5 * glm::radians(180.0);
  const double tilted = std::clamp(elevation + pitch, -steepest, steepest);

  const Vec3 turned_right = std::cos(yaw) * right + std::sin(yaw) * glm::cross(pole, right);
  const Vec3 level = glm::cross(turned_right, pole);
  back = std::cos(tilted) * level + std::sin(tilted) * pole;
  up = std::cos(tilted) * pole - std::sin(tilted) * level;
}

Vec3 Camera::front() const { return flatten({0.0, 0.0, 1.0}, pole, {0.0, -1.0, 0.0}); }

void Camera::look_from(const Vec3& direction) {
  back = glm::normalize(direction);
  const double rise = glm::dot(back, pole);
  const bool near_pole = std::abs(rise) > 1.0 - 1e-12;
  up = flatten(near_pole ? -rise * front() : pole, back, any_normal_to(back));
}

void Camera::pan(const glm::dvec2& from, const glm::dvec2& to, const glm::dvec2& size) {
  target += unproject(from, size, target) - unproject(to, size, target);
}

// Scales the eye and the target about the point under the cursor, so that points on that ray stay where they are in the picture.
void Camera::zoom(double factor, const glm::dvec2& cursor, const glm::dvec2& size) {
  const double nearer = std::clamp(distance * factor, min_distance, max_distance) / distance;
  const Vec3 fixed = unproject(cursor, size, target);
  target = fixed + nearer * (target - fixed);
  distance *= nearer;
}

CameraPose pose_of(const Camera& camera) {
  return {.eye = camera.eye(), .target = camera.target, .up = camera.pole, .orthographic = camera.orthographic, .follows = camera.follows};
}

}  // namespace hooke
