#include "formats/lammps/lammps_model.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/bounds.h"
#include "base/errors.h"
#include "base/text_lines.h"
#include "sim/methods/integrator.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// Why a collider cannot be a reflecting wall; empty: it can.
std::string why_not_a_wall(const Scene& scene, const Collider& collider) {
  const Plane* plane = std::get_if<Plane>(&collider.shape);
  if (plane == nullptr) return std::holds_alternative<Sphere>(collider.shape) ? "a sphere" : "a box";
  const Vec3 n = glm::abs(plane->normal);
  if (std::max({n.x, n.y, n.z}) != 1.0) return "a plane that is not perpendicular to an axis";
  if (collider.restitution != 1.0) return "a plane with restitution " + format_exact(collider.restitution) + " instead of 1";
  if (collider.friction != 0.0) return "a plane with friction " + format_exact(collider.friction) + " instead of 0";
  if (collider.path.moves()) return "a moving plane";
  const double radius = scene.system.points().empty() ? 0.0 : scene.system.points().front().radius;
  const bool same = std::ranges::all_of(scene.system.points(), [&](const Point& point) { return point.radius == radius; });
  if (!same) return "a plane and points of different radii";
  // Hooke moves such a point out at once, a reflecting wall lets it move on
  for (Index i = 0; i < scene.system.point_count(); ++i)
    if (!scene.system.points()[i].nailed && glm::dot(plane->normal, scene.state.position[i] - plane->point) < radius)
      return "a plane that point " + std::to_string(i) + " starts within";
  return "";
}

}  // namespace

std::vector<std::string> unsupported_by_lammps(const Scene& scene) {
  const System& system = scene.system;
  std::vector<std::string> list;
  const auto has_dashpot = [&](const Spring& spring) { return system.damping_of(spring) > 0.0; };
  if (std::ranges::any_of(system.springs(), has_dashpot)) list.emplace_back("dashpots");
  if (system.springs().have_laws()) list.emplace_back("springs with a law, muscles or winches");
  if (system.any_spring_breaks()) list.emplace_back("springs that break");
  if (system.strain_limit > 0.0 && system.spring_count() > 0) list.emplace_back("the strain limit");
  if (system.grab || scene.state.hand.collider) list.emplace_back("the hand");
  if (system.scripted_hand) list.emplace_back("the scripted hand");
  if (std::ranges::any_of(system.points(), [](const Point& point) { return point.load != Vec3(0.0); }))
    list.emplace_back("loads of points");
  if (std::ranges::any_of(system.points(), &Point::fixed_axes)) list.emplace_back("points on rollers");
  if (system.contact.points) list.emplace_back("contact between points");
  if (system.contact.faces || system.contact.springs) list.emplace_back("contact of faces and springs");
  for (const Force& force : system.forces)
    if (force.on) list.push_back("the force " + std::string(force.term->id));
  for (std::size_t i = 0; i < system.colliders.size(); ++i) {
    if (!system.colliders[i].solid) continue;
    const std::string reason = why_not_a_wall(scene, system.colliders[i]);
    if (!reason.empty()) list.push_back(reason + " (colliders[" + std::to_string(i) + "])");
  }
  return list;
}

void refuse_unsupported(const Scene& scene, const std::string& file) {
  if (const std::string list = joined(unsupported_by_lammps(scene)); !list.empty())
    throw InputError(file + ": LAMMPS cannot represent " + list);
}

LammpsDrag::LammpsDrag(const Scene& scene) {
  const double c = scene.system.drag_rate(), h = scene.settings.substep();
  half = weight = 0.5 * h;
  if (c == 0.0) return;
  decay = portable::exp(-c * half);
  weight = -portable::expm1(-c * half) / c;
  rate = -portable::expm1(-c * h) / h;
  scale = rate / c;
}

// the first kick of LAMMPS is w + h/2 (s a - d w); it must be E v + phi a
Vec3 LammpsDrag::start_velocity(const Vec3& v, const Vec3& a) const {
  return is_on() ? (decay * v + (weight - half * scale) * a) / (1.0 - half * rate) : v;
}

Vec3 LammpsDrag::end_velocity(const Vec3& v, const Vec3& applied) const {
  if (!is_on()) return v;
  const Vec3 before = v - half * applied, a = (applied + rate * before) / scale;
  return decay * before + weight * a;
}

Vec3 field_acceleration(const System& system) {
  Vec3 a = system.gravity + system.drag_rate() * system.wind;
  if (system.dimensions == 2) a.z = 0.0;
  return a;
}

}  // namespace hooke
