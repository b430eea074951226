#include "sim/contact/surface/surface_response.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hooke {
namespace {

// At most so many sweeps, less if one changes no relative velocity by more than this part of the largest change.
constexpr int max_sweeps_of_impulses = 8, max_sweeps_of_separation = 2;
// Twice as many where points press each other: they are in longer chains.
constexpr int times_with_points = 2;
constexpr double relative_tolerance = 1e-3;

// Changes the normal impulse by `change`, and opposes the slip [m/s] as far as friction can. Returns the change of both.
Vec3 add_impulse(ContactImpulse& impulse, double change, const Vec3& normal, double friction, const Vec3& slip, double response) {
  impulse.normal += change;
  Vec3 total = change * normal;
  if (friction == 0.0) return total;
  const Vec3 before = impulse.friction;
  impulse.friction -= slip / response;
  const double size = std::sqrt(glm::dot(impulse.friction, impulse.friction)), max = friction * impulse.normal;
  if (size > max) impulse.friction *= max / size;
  return total + (impulse.friction - before);
}

// Both return the change of the relative velocity [m/s].
double settle_contact(SurfaceContact& contact, std::span<const double> inverse_mass, double friction, double leverage,
                      std::span<Vec3> velocity) {
  const auto& [i, j, k, l] = contact.points;
  const std::array<double, 4>& w = contact.weight;
  const Vec3 relative = w[0] * velocity[i] + w[1] * velocity[j] + w[2] * velocity[k] + w[3] * velocity[l];
  const double normal_velocity = glm::dot(contact.normal, relative);
  if (contact.impulse.normal == 0.0 && !(normal_velocity < contact.target)) return 0.0;
  const double approach = contact.target - normal_velocity;
  double change = std::max(-contact.impulse.normal, approach / std::max(contact.response, contact.max_change / leverage));
  if (contact.is_driven && change > 0.0)
    change = limited_impulse(contact.points, contact.weight, contact.normal, change, approach, inverse_mass, velocity);
  const Vec3 slip = relative - normal_velocity * contact.normal;
  const Vec3 total = add_impulse(contact.impulse, change, contact.normal, friction, slip, contact.response);
  for (int c = 0; c < 4; ++c) velocity[contact.points[c]] += inverse_mass[contact.points[c]] * w[c] * total;
  return contact.response * std::sqrt(glm::dot(total, total));
}

double settle_obstacle(ObstacleContact& contact, std::span<const double> inverse_mass, bool has_friction, std::span<Vec3> velocity) {
  Vec3& v = velocity[contact.point];
  const double response = inverse_mass[contact.point], normal_velocity = glm::dot(contact.normal, v);
  if (normal_velocity == contact.target || (contact.impulse.normal == 0.0 && normal_velocity > contact.target)) return 0.0;
  const double change = std::max(-contact.impulse.normal, (contact.target - normal_velocity) / response);
  const Vec3 relative = v - contact.surface, slip = relative - glm::dot(contact.normal, relative) * contact.normal;
  const Vec3 total = add_impulse(contact.impulse, change, contact.normal, has_friction ? contact.friction : 0.0, slip, response);
  v += response * total;
  return response * std::sqrt(glm::dot(total, total));
}

}  // namespace

void SurfaceContact::move_to(const Closest& closest, std::span<const double> inverse_mass) {
  weight = closest.weight;
  normal = closest.separation / closest.distance;
  response = max_change = 0.0;
  for (int c = 0; c < 4; ++c) {
    response += weight[c] * weight[c] * inverse_mass[points[c]];
    max_change = std::max(max_change, std::abs(weight[c]) * inverse_mass[points[c]]);
  }
}

// J w = -L with the moments of inertia J about the center.
void remove_angular_momentum(const Vec3& angular, const std::array<Index, 4>& points, std::span<const Vec3> x,
                             std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  std::array<Vec3, 4> r;
  std::array<double, 4> m{};
  Vec3 center(0.0);
  double mass = 0.0;
  for (int c = 0; c < 4; ++c) {
    if (inverse_mass[points[c]] == 0.0) return;
    m[c] = 1.0 / inverse_mass[points[c]];
    mass += m[c];
    center += m[c] * x[points[c]];
  }
  center /= mass;
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0, xz = 0.0, yz = 0.0;
  for (int c = 0; c < 4; ++c) {
    r[c] = x[points[c]] - center;
    const Vec3 s = m[c] * r[c];
    xx += s.x * r[c].x, yy += s.y * r[c].y, zz += s.z * r[c].z;
    xy += s.x * r[c].y, xz += s.x * r[c].z, yz += s.y * r[c].z;
  }
  const double a = yy + zz, b = xx + zz, c = xx + yy, size = xx + yy + zz;
  // the adjugate of J
  const double aa = b * c - yz * yz, bb = a * c - xz * xz, cc = a * b - xy * xy;
  const double ab = xy * c + yz * xz, ac = xy * yz + xz * b, bc = a * yz + xy * xz;
  const double determinant = a * aa - xy * ab - xz * ac;
  constexpr double straight = 1e-5;
  if (!(determinant > straight * size * size * size)) return;
  const Vec3 w = -Vec3(aa * angular.x + ab * angular.y + ac * angular.z, ab * angular.x + bb * angular.y + bc * angular.z,
                       ac * angular.x + bc * angular.y + cc * angular.z) /
                 determinant;
  for (int i = 0; i < 4; ++i) velocity[points[i]] += glm::cross(w, r[i]);
}

double limited_impulse(std::span<const Index> points, std::span<const double> weight, const Vec3& normal, double impulse, double approach,
                       std::span<const double> inverse_mass, std::span<const Vec3> velocity) {
  double drive = 0.0;
  for (std::size_t c = 0; c < points.size(); ++c)
    if (inverse_mass[points[c]] == 0.0) drive += weight[c] * glm::dot(normal, velocity[points[c]]);
  const double max_speed = max_leverage * std::max(std::abs(drive), approach);
  for (std::size_t c = 0; c < points.size(); ++c) {
    const double change = std::abs(weight[c]) * inverse_mass[points[c]];
    if (change == 0.0) continue;
    const double speed = std::copysign(1.0, weight[c]) * glm::dot(normal, velocity[points[c]]);
    impulse = std::min(impulse, std::max(0.0, max_speed - speed) / change);
  }
  return impulse;
}

bool SurfaceContacts::settle(std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity) {
  return settle(inverse_mass, friction, std::numeric_limits<double>::infinity(), max_sweeps_of_impulses, velocity);
}

bool SurfaceContacts::separate(std::span<const double> inverse_mass, double friction, std::span<Vec3> velocity) {
  for (SurfaceContact& contact : surface) contact.impulse = {};
  for (ObstacleContact& contact : obstacles) contact.impulse = {};
  return settle(inverse_mass, friction, max_leverage, max_sweeps_of_separation, velocity);
}

bool SurfaceContacts::settle(std::span<const double> inverse_mass, double friction, double leverage, int max_sweeps,
                             std::span<Vec3> velocity) {
  const bool rubs_on_obstacles = friction > 0.0 && std::isinf(leverage);
  if (has_points) max_sweeps *= times_with_points;
  double max_change = 0.0;
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t k = 0; k < surface.size(); ++k) {
      SurfaceContact& contact = surface[sweep % 2 == 0 ? k : surface.size() - 1 - k];
      change = std::max(change, settle_contact(contact, inverse_mass, friction, leverage, velocity));
    }
    for (ObstacleContact& contact : obstacles)
      change = std::max(change, settle_obstacle(contact, inverse_mass, rubs_on_obstacles, velocity));
    impulses += static_cast<long>(surface.size());
    max_change = std::max(max_change, change);
    if (!(change > relative_tolerance * max_change)) break;
  }
  return max_change > 0.0;
}

}  // namespace hooke
