// Reads a collider of a scene file.
#include <algorithm>
#include <array>
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
  const auto member = find_member(field, "spin");
  if (!member || spin == Vec3(0.0)) return;
  const auto* plane = std::get_if<Plane>(&collider.shape);
  if (std::holds_alternative<Box>(collider.shape)) member->refuse("must not be given for a box, which cannot spin");
  if (plane != nullptr && glm::length(glm::cross(spin, plane->normal)) > 1e-9 * glm::length(spin))
    member->refuse("must be along the normal of the plane");
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

Box read_box(const JsonField& field, const JsonField& min, const JsonField& max, SceneFields& fields) {
  Box box{fields.vector(min), fields.vector(max)};
  // a rectangle of a 2-D scene: so deep that the nearest surface is never along z
  if (min.value().Size() == 2 && max.value().Size() == 2) {
    const double depth = std::min(box.max.x - box.min.x, box.max.y - box.min.y);
    box.min.z = -depth;
    box.max.z = depth;
  }
  for (int c = 0; c < 3; ++c)
    if (!(box.min[c] < box.max[c])) field.refuse("must have a min below max in each direction");
  return box;
}

}  // namespace

void read_collider(const JsonField& field, SceneFields& fields, Scene& scene) {
  constexpr std::string_view types = "must be \"plane\", \"sphere\" or \"box\"";
  const JsonField type = required(field, "type", types);
  Collider collider;
  std::array<std::string_view, 2> keys;
  const auto first = [&] { return required(field, keys[0]); };
  const auto second = [&] { return required(field, keys[1]); };
  if (type.text() == "plane") {
    keys = {"point", "normal"};
    collider.shape = Plane{fields.vector(first()), fields.direction(second())};
  } else if (type.text() == "sphere") {
    keys = {"center", "radius"};
    collider.shape = Sphere{fields.vector(first()), second().number(positive)};
  } else if (type.text() == "box") {
    keys = {"min", "max"};
    collider.shape = read_box(field, first(), second(), fields);
  } else {
    type.refuse(types);
  }
  for (const JsonField member : field.members())
    if (!read_surface(member, fields, collider) && !member.is(keys[0]) && !member.is(keys[1]))
      fields.preserve_unknown(member, scene.preserved_json.unknown_inside[field.path()]);
  check_spin(field, collider);
  scene.system.colliders.push_back(collider);
}

}  // namespace hooke
