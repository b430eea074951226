// What a point rests on during part of a step, and how its supports restrict its acceleration.
#pragma once

#include <array>
#include <glm/geometric.hpp>
#include <span>

#include "sim/contact/obstacle.h"

namespace hooke {

// The component of w perpendicular to the unit vector `normal`.
Vec3 tangential(const Vec3& normal, const Vec3& w);

// A collider that the point touches without moving into it or away from it.
struct Support {
  const Obstacle* obstacle = nullptr;
  Vec3 normal{0.0};
  double curvature = 0.0;
  Vec3 velocity{0.0};                // [m/s], of the shape
  Vec3 surface{0.0};                 // [m/s], of the surface: of the shape, and along it
  Vec3 surface_acceleration{0.0};    // [m/s^2], of the surface relative to the shape, due to its spin
  double normal_acceleration = 0.0;  // [m/s^2], normal force over mass
  double friction() const { return obstacle->collider->friction; }
  // [m/s^2], of a point with this velocity relative to the shape: towards the side where the surface is curved.
  double centripetal(const Vec3& relative_velocity) const { return curvature * glm::dot(relative_velocity, relative_velocity); }
};

struct Supports {
  static constexpr int max = 4;
  std::array<Support, max> items;
  int count = 0;

  std::span<Support> all() { return {items.data(), static_cast<std::size_t>(count)}; }
  std::span<const Support> all() const { return {items.data(), static_cast<std::size_t>(count)}; }
  bool contains(const Obstacle* obstacle) const {
    return std::ranges::any_of(all(), [&](const Support& s) { return s.obstacle == obstacle; });
  }
  bool any_loaded() const {
    return std::ranges::any_of(all(), [](const Support& s) { return s.normal_acceleration > 0.0; });
  }
};

// The acceleration of a point of velocity v after the supports have modified `a`. Sets the normal_acceleration N_i >= 0 of each support
// to the minimum for which the point moves into none of them,
//   n_i . (a - a_i + sum N_j n_j) + (v - v_i)^2 / R_i >= 0,
// where a_i and v_i are those of the support.
Vec3 constrain(std::span<Support> supports, const Vec3& a, const Vec3& v);

// The support that the point rests on or slides along: one of the loaded supports, preferably a curved one, with the mean motion
// of all loaded surfaces, weighted by friction. Without an obstacle if none is loaded.
Support combine_supports(const Supports& supports);

}  // namespace hooke
