#include "sim/contact/surface/surface_response.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hooke {
namespace {

bool settle_contact(SurfaceContact& contact, std::span<const double> inverse_mass, double friction, double leverage,
                    std::span<Vec3> velocity) {
  const auto& [i, j, k, l] = contact.points;
  const std::array<double, 4>& w = contact.weight;
  const Vec3 relative = w[0] * velocity[i] + w[1] * velocity[j] + w[2] * velocity[k] + w[3] * velocity[l];
  const double normal_velocity = glm::dot(contact.normal, relative);
  if (!(normal_velocity < contact.target)) return false;
  const double approach = contact.target - normal_velocity;
  double impulse = approach / std::max(contact.response, contact.max_change / leverage);
  if (contact.is_driven)
    impulse = limited_impulse(contact.points, contact.weight, contact.normal, impulse, approach, inverse_mass, velocity);
  Vec3 total = impulse * contact.normal;
  if (friction > 0.0) {
    const Vec3 slip = relative - normal_velocity * contact.normal;
    const double speed = std::sqrt(glm::dot(slip, slip));
    if (speed > 0.0) total -= std::min(friction * impulse / speed, 1.0 / contact.response) * slip;
  }
  contact.impulse += impulse;
  for (int c = 0; c < 4; ++c) velocity[contact.points[c]] += inverse_mass[contact.points[c]] * w[c] * total;
  return true;
}

bool settle_obstacle(ObstacleContact& contact, std::span<const double> inverse_mass, bool has_friction, std::span<Vec3> velocity) {
  Vec3& v = velocity[contact.point];
  const double normal_velocity = glm::dot(contact.normal, v);
  if (!(normal_velocity < contact.target)) return false;
  const double change = contact.target - normal_velocity;
  const Vec3 relative = v - contact.surface, slip = relative - glm::dot(contact.normal, relative) * contact.normal;
  const double speed = std::sqrt(glm::dot(slip, slip));
  v += change * contact.normal;
  if (has_friction && speed > 0.0) v -= std::min(contact.friction * change / speed, 1.0) * slip;
  contact.impulse += change / inverse_mass[contact.point];
  return true;
}

}  // namespace

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
  return settle(inverse_mass, friction, std::numeric_limits<double>::infinity(), velocity);
}

bool SurfaceContacts::separate(std::span<const double> inverse_mass, std::span<Vec3> velocity) {
  return settle(inverse_mass, 0.0, max_leverage, velocity);
}

bool SurfaceContacts::settle(std::span<const double> inverse_mass, double friction, double leverage, std::span<Vec3> velocity) {
  bool any = false;
  const auto settle_surface = [&](SurfaceContact& contact) {
    any = settle_contact(contact, inverse_mass, friction, leverage, velocity) || any;
  };
  const auto settle_point = [&](ObstacleContact& contact) {
    any = settle_obstacle(contact, inverse_mass, friction > 0.0, velocity) || any;
  };
  for (SurfaceContact& contact : surface) settle_surface(contact);
  for (ObstacleContact& contact : obstacles) settle_point(contact);
  if (!any) return false;
  for (ObstacleContact& contact : obstacles) settle_point(contact);
  for (auto contact = surface.rbegin(); contact != surface.rend(); ++contact) settle_surface(*contact);
  for (ObstacleContact& contact : obstacles) settle_point(contact);
  return true;
}

}  // namespace hooke
