// Reads a collider of a scene file.
#include <algorithm>
#include <glm/geometric.hpp>

#include "formats/scene_json/scene_sections.h"

namespace hooke {
namespace {

// Reads a field of the motion of a collider. Returns false if it is none.
bool read_path(const JsonField& field, SceneFields& fields, ColliderPath& path) {
  if (field.is("oscillate"))
    path.amplitude = fields.vector(field);
  else if (field.is("frequency"))
    path.frequency = field.number(not_negative);
  else if (field.is("phase"))
    path.phase = field.number();
  else if (field.is("spin"))
    path.spin = fields.vector(field);
  else if (field.is("belt"))
    path.belt = fields.vector(field);
  else
    return false;
  return true;
}

// A rotating box or a tilting plane would have a different shape at every time.
void check_spin(const JsonField& field, const Collider& collider) {
  const Vec3& spin = collider.path.spin;
  if (spin == Vec3(0.0)) return;
  const auto* plane = std::get_if<Plane>(&collider.shape);
  for (const JsonField member : field.members()) {
    if (!member.is("spin")) continue;
    if (std::holds_alternative<Box>(collider.shape)) member.refuse("must not be given for a box, which cannot spin");
    if (plane != nullptr && glm::length(glm::cross(spin, plane->normal)) > 1e-9 * glm::length(spin))
      member.refuse("must be along the normal of the plane");
  }
}

// Reads a field that all colliders have. Returns false if it is none.
bool read_surface(const JsonField& field, SceneFields& fields, Collider& collider) {
  if (field.is("type") || read_path(field, fields, collider.path)) return true;
  if (field.is("restitution"))
    collider.restitution = field.number({.min = 0.0, .max = 1.0});
  else if (field.is("friction"))
    collider.friction = field.number(not_negative);
  else if (field.is("solid"))
    collider.solid = field.boolean();
  else if (field.is("one_way"))
    collider.one_way = field.boolean();
  else
    return false;
  return true;
}

// Reads a shape defined by two required fields.
template <class First, class Second>
void read_shape(const JsonField& field, SceneFields& fields, Scene& scene, Collider& collider, std::string_view first_key, First read_first,
                std::string_view second_key, Second read_second) {
  bool has_first = false, has_second = false;
  for (const JsonField member : field.members()) {
    if (read_surface(member, fields, collider)) continue;
    if (member.is(first_key)) {
      read_first(member);
      has_first = true;
    } else if (member.is(second_key)) {
      read_second(member);
      has_second = true;
    } else
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  }
  if (!has_first) field.refuse_missing(first_key, "must be given");
  if (!has_second) field.refuse_missing(second_key, "must be given");
}

void read_plane(const JsonField& field, SceneFields& fields, Scene& scene, Collider& collider) {
  Plane plane;
  read_shape(
      field, fields, scene, collider, "point", [&](const JsonField& point) { plane.point = fields.vector(point); }, "normal",
      [&](const JsonField& normal) { plane.normal = fields.direction(normal); });
  collider.shape = plane;
}

void read_sphere(const JsonField& field, SceneFields& fields, Scene& scene, Collider& collider) {
  Sphere sphere;
  read_shape(
      field, fields, scene, collider, "center", [&](const JsonField& center) { sphere.center = fields.vector(center); }, "radius",
      [&](const JsonField& radius) { sphere.radius = radius.number(positive); });
  collider.shape = sphere;
}

void read_box(const JsonField& field, SceneFields& fields, Scene& scene, Collider& collider) {
  Box box;
  bool flat = true;
  const auto read_corner = [&](Vec3& corner) {
    return [&](const JsonField& member) {
      corner = fields.vector(member);
      flat = flat && member.value().Size() == 2;
    };
  };
  read_shape(field, fields, scene, collider, "min", read_corner(box.min), "max", read_corner(box.max));

  // a rectangle of a 2-D scene: so deep that the nearest surface is never along z
  if (flat) {
    const double depth = std::min(box.max.x - box.min.x, box.max.y - box.min.y);
    box.min.z = -depth;
    box.max.z = depth;
  }
  for (int c = 0; c < 3; ++c)
    if (!(box.min[c] < box.max[c])) field.refuse("must have a min below max in each direction");
  collider.shape = box;
}

}  // namespace

void read_collider(const JsonField& field, SceneFields& fields, Scene& scene) {
  Collider collider;
  bool known = false;
  for (const JsonField member : field.members()) {
    if (!member.is("type")) continue;
    known = true;
    if (member.text() == "plane")
      read_plane(field, fields, scene, collider);
    else if (member.text() == "sphere")
      read_sphere(field, fields, scene, collider);
    else if (member.text() == "box")
      read_box(field, fields, scene, collider);
    else
      member.refuse("must be \"plane\", \"sphere\" or \"box\"");
  }
  if (!known) field.refuse_missing("type", "must be \"plane\", \"sphere\" or \"box\"");
  check_spin(field, collider);
  scene.system.colliders.push_back(collider);
}

}  // namespace hooke
