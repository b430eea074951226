#include "scene/flatness.h"

#include "sim/model/force_term.h"

namespace hooke {
namespace {

bool is_flat(const Collider& collider) {
  const ColliderPath& path = collider.path;
  if (path.amplitude.z != 0.0 || path.belt.z != 0.0 || path.spin.x != 0.0 || path.spin.y != 0.0) return false;
  if (const auto* plane = std::get_if<Plane>(&collider.shape)) return plane->normal.z == 0.0 && plane->point.z == 0.0;
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) return sphere->center.z == 0.0;
  return true;
}

// Whether the parameters of the force give a direction or a position out of the plane.
bool has_component_along_z(const Force& force) {
  for (std::size_t i = 0; i < force.term->numbers.size(); ++i)
    if (force.term->numbers[i].name.ends_with("z") && force.values[i] != 0.0) return true;
  return false;
}

}  // namespace

std::string why_not_in_plane(const System& system, const State& state) {
  for (Index i = 0; i < system.point_count(); ++i) {
    if (state.position[i].z != 0.0) return "point " + std::to_string(i) + " is not at z = 0";
    if (state.velocity[i].z != 0.0) return "point " + std::to_string(i) + " moves along z";
  }
  return system.gravity.z != 0.0 ? "gravity acts along z" : "";
}

std::string why_not_flat(const System& system, const State& state) {
  if (std::string reason = why_not_in_plane(system, state); !reason.empty()) return reason;
  for (std::size_t c = 0; c < system.colliders.size(); ++c)
    if (!is_flat(system.colliders[c])) return "collider " + std::to_string(c) + " does not stand upright on the plane";
  for (const Force& force : system.forces)
    if (has_component_along_z(force)) return std::string(force.term->label) + " acts along z";
  if (system.scripted_hand) return "a scripted hand moves in space";
  return {};
}

}  // namespace hooke
