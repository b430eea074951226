#include "scene/collider_kinds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

constexpr double far = 1e6, min_size = 1e-6;  // [m], as for points

const Sphere* ball(const Collider& collider) { return std::get_if<Sphere>(&collider.shape); }
const Plane* plane(const Collider& collider) { return std::get_if<Plane>(&collider.shape); }
const Box* box(const Collider& collider) { return std::get_if<Box>(&collider.shape); }
bool is_any(const Collider&) { return true; }
bool is_ball(const Collider& collider) { return ball(collider) != nullptr; }
bool is_plane(const Collider& collider) { return plane(collider) != nullptr; }
bool is_box(const Collider& collider) { return box(collider) != nullptr; }

// The surface of a plane can only spin about its normal.
void set_normal(Collider& collider, const Vec3& normal) {
  Plane& shape = std::get<Plane>(collider.shape);
  const double length = glm::length(normal);
  if (!(length > 0.0)) return;
  const double spin = glm::dot(collider.path.spin, shape.normal);
  shape.normal = normal / length;
  // the division leaves an error of rounding
  shape.normal /= glm::length(shape.normal);
  collider.path.spin = spin * shape.normal;
}

template <int axis>
struct Along {
  static double position(const Collider& collider) { return anchor_of(collider)[axis]; }
  static void set_position(Collider& collider, double value) {
    Vec3 displacement(0.0);
    displacement[axis] = value - position(collider);
    collider = translated(collider, displacement);
  }
  static double extent(const Collider& collider) { return box(collider)->max[axis] - box(collider)->min[axis]; }
  static void set_extent(Collider& collider, double value) {
    Box& shape = std::get<Box>(collider.shape);
    const double middle = 0.5 * (shape.min[axis] + shape.max[axis]);
    shape.min[axis] = middle - 0.5 * value;
    shape.max[axis] = middle + 0.5 * value;
  }
  static double normal(const Collider& collider) { return plane(collider)->normal[axis]; }
  static void write_normal(Collider& collider, double value) {
    Vec3 changed = plane(collider)->normal;
    changed[axis] = value;
    set_normal(collider, changed);
  }
  template <Vec3 ColliderPath::*member>
  static double path(const Collider& collider) {
    return (collider.path.*member)[axis];
  }
  template <Vec3 ColliderPath::*member>
  static void set_path(Collider& collider, double value) {
    (collider.path.*member)[axis] = value;
  }
};
using X = Along<0>;
using Y = Along<1>;
using Z = Along<2>;

constexpr std::string_view of_path = "It swings about its position with this amplitude.";
constexpr std::string_view of_belt = "Velocity of its surface, as of a conveyor belt.";
constexpr std::string_view of_spin = "Its surface turns with this angular velocity.";
constexpr std::string_view of_normal = "Direction of its free side; its length becomes 1.";
constexpr std::string_view of_position = "Of the middle of a ball or a box, or of a point of a plane.";

constexpr auto amplitude = &ColliderPath::amplitude, belt = &ColliderPath::belt, spin = &ColliderPath::spin;

const std::array numbers{
    ColliderNumber{"Position x", "m", of_position, -far, far, false, is_any, X::position, X::set_position},
    ColliderNumber{"Position y", "m", of_position, -far, far, false, is_any, Y::position, Y::set_position},
    ColliderNumber{"Position z", "m", of_position, -far, far, true, is_any, Z::position, Z::set_position},
    ColliderNumber{"Radius", "m", "Of the ball.", min_size, far, false, is_ball, [](const Collider& c) { return ball(c)->radius; },
                   [](Collider& c, double value) { std::get<Sphere>(c.shape).radius = value; }},
    ColliderNumber{"Width", "m", "Along x.", min_size, far, false, is_box, X::extent, X::set_extent},
    ColliderNumber{"Height", "m", "Along y.", min_size, far, false, is_box, Y::extent, Y::set_extent},
    ColliderNumber{"Depth", "m", "Along z.", min_size, far, true, is_box, Z::extent, Z::set_extent},
    ColliderNumber{"Normal x", "", of_normal, -1.0, 1.0, false, is_plane, X::normal, X::write_normal},
    ColliderNumber{"Normal y", "", of_normal, -1.0, 1.0, false, is_plane, Y::normal, Y::write_normal},
    ColliderNumber{"Normal z", "", of_normal, -1.0, 1.0, true, is_plane, Z::normal, Z::write_normal},
    ColliderNumber{"Restitution", "", "Normal speed after an impact, divided by that before it.", 0.0, 1.0, false, is_any,
                   [](const Collider& c) { return c.restitution; }, [](Collider& c, double value) { c.restitution = value; }},
    ColliderNumber{"Friction", "", "Coulomb's coefficient.", 0.0, 1e6, false, is_any, [](const Collider& c) { return c.friction; },
                   [](Collider& c, double value) { c.friction = value; }},
    ColliderNumber{"Swing x", "m", of_path, -far, far, false, is_any, X::path<amplitude>, X::set_path<amplitude>},
    ColliderNumber{"Swing y", "m", of_path, -far, far, false, is_any, Y::path<amplitude>, Y::set_path<amplitude>},
    ColliderNumber{"Swing z", "m", of_path, -far, far, true, is_any, Z::path<amplitude>, Z::set_path<amplitude>},
    ColliderNumber{"Frequency", "Hz", "Of the swing.", 0.0, 1e6, false, is_any, [](const Collider& c) { return c.path.frequency; },
                   [](Collider& c, double value) { c.path.frequency = value; }},
    ColliderNumber{"Phase", "rad", "Of the swing, at t = 0.", -far, far, false, is_any, [](const Collider& c) { return c.path.phase; },
                   [](Collider& c, double value) { c.path.phase = value; }},
    ColliderNumber{"Spin", "rad/s", of_spin, -far, far, true, is_plane,
                   [](const Collider& c) { return glm::dot(c.path.spin, plane(c)->normal); },
                   [](Collider& c, double value) { c.path.spin = value * plane(c)->normal; }},
    ColliderNumber{"Spin x", "rad/s", of_spin, -far, far, true, is_ball, X::path<spin>, X::set_path<spin>},
    ColliderNumber{"Spin y", "rad/s", of_spin, -far, far, true, is_ball, Y::path<spin>, Y::set_path<spin>},
    ColliderNumber{"Spin z", "rad/s", of_spin, -far, far, false, is_ball, Z::path<spin>, Z::set_path<spin>},
    ColliderNumber{"Belt x", "m/s", of_belt, -far, far, false, is_any, X::path<belt>, X::set_path<belt>},
    ColliderNumber{"Belt y", "m/s", of_belt, -far, far, false, is_any, Y::path<belt>, Y::set_path<belt>},
    ColliderNumber{"Belt z", "m/s", of_belt, -far, far, true, is_any, Z::path<belt>, Z::set_path<belt>},
};

const std::array collider_table{
    ColliderKind{"Plane", "An infinite obstacle: a floor, a wall or a slope. Its normal points to the free side.",
                 [](const Vec3& at, double, const Vec3& up) {
                   return Collider{.shape = Plane{at, up}, .restitution = 0.5, .friction = 0.3};
                 }},
    ColliderKind{"Ball", "A solid ball that does not give way.",
                 [](const Vec3& at, double size, const Vec3&) {
                   return Collider{.shape = Sphere{at, 0.5 * size}, .restitution = 0.5, .friction = 0.3};
                 }},
    ColliderKind{"Box", "A solid box, parallel to the axes, that does not give way.",
                 [](const Vec3& at, double size, const Vec3&) {
                   return Collider{.shape = Box{at - Vec3(0.5 * size), at + Vec3(0.5 * size)}, .restitution = 0.5, .friction = 0.3};
                 }},
};

// Two directions perpendicular to this one and to each other.
std::pair<Vec3, Vec3> across(const Vec3& n) {
  const Vec3 other = std::abs(n.z) < 0.9 ? Vec3(0.0, 0.0, 1.0) : Vec3(1.0, 0.0, 0.0);
  const Vec3 u = glm::normalize(glm::cross(n, other));
  return {u, glm::cross(n, u)};
}

}  // namespace

std::span<const ColliderKind> collider_kinds() { return collider_table; }
const ColliderKind& kind_of(const Collider& collider) { return collider_table[collider.shape.index()]; }
std::span<const ColliderNumber> collider_numbers() { return numbers; }

std::vector<std::pair<Vec3, Vec3>> outline_of(const Collider& collider, double size) {
  std::vector<std::pair<Vec3, Vec3>> lines;
  if (const Plane* shape = plane(collider)) {
    const auto [u, v] = across(shape->normal);
    constexpr int cells = 8;
    for (int i = -cells; i <= cells; ++i) {
      const double at = size * i / cells;
      lines.emplace_back(shape->point + at * u - size * v, shape->point + at * u + size * v);
      lines.emplace_back(shape->point + at * v - size * u, shape->point + at * v + size * u);
    }
    lines.emplace_back(shape->point, shape->point + 0.5 * size * shape->normal);
  } else if (const Sphere* shape_of_ball = ball(collider)) {
    constexpr int segments = 48;
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < segments; ++i) {
        const auto place = [&](int segment) {
          const double angle = 2.0 * 3.14159265358979323846 * segment / segments;
          Vec3 offset(0.0);
          offset[(axis + 1) % 3] = std::cos(angle);
          offset[(axis + 2) % 3] = std::sin(angle);
          return shape_of_ball->center + shape_of_ball->radius * offset;
        };
        lines.emplace_back(place(i), place(i + 1));
      }
  } else {
    const Box& shape_of_box = *box(collider);
    for (int bits = 0; bits < 8; ++bits)
      for (const int side : {1, 2, 4})
        if ((bits & side) == 0) lines.emplace_back(shape_of_box.corner(bits), shape_of_box.corner(bits | side));
  }
  return lines;
}

std::vector<Vec3> handles_of(const Collider& collider, int dimensions, double size) {
  if (const Plane* shape = plane(collider)) return {shape->point + 0.5 * size * shape->normal};
  std::vector<Vec3> handles;
  const Vec3 middle = anchor_of(collider);
  for (int axis = 0; axis < dimensions; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 place = middle;
      place[axis] += side * (is_ball(collider) ? ball(collider)->radius : 0.5 * (box(collider)->max[axis] - box(collider)->min[axis]));
      handles.push_back(place);
    }
  return handles;
}

Collider with_handle_at(Collider collider, std::size_t handle, const Vec3& place) {
  if (is_plane(collider)) {
    set_normal(collider, place - plane(collider)->point);
  } else if (is_ball(collider)) {
    Sphere& shape = std::get<Sphere>(collider.shape);
    shape.radius = std::max(min_size, glm::distance(shape.center, place));
  } else {
    Box& shape = std::get<Box>(collider.shape);
    const int axis = static_cast<int>(handle / 2);
    if (handle % 2 == 0)
      shape.min[axis] = std::min(place[axis], shape.max[axis] - min_size);
    else
      shape.max[axis] = std::max(place[axis], shape.min[axis] + min_size);
  }
  return collider;
}

}  // namespace hooke
