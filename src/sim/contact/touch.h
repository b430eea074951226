// Points that may touch within a substep, and what they may touch.
#pragma once

#include <glm/geometric.hpp>
#include <limits>

#include "sim/contact/gap.h"
#include "sim/contact/impulse.h"
#include "sim/contact/obstacle.h"

namespace hooke {

inline constexpr std::size_t no_path = std::numeric_limits<std::size_t>::max();
inline constexpr double never = std::numeric_limits<double>::infinity();  // [s]

// The path of a point, or of an obstacle, through a substep: a parabola from `time` on.
struct PointPath {
  Index point = no_index;
  double inverse_mass = 0.0;      // [1/kg]; 0: it follows its path whatever it touches
  double time = 0.0;              // [s], since the start of the substep
  Vec3 x{0.0}, v{0.0}, a{0.0};    // [m], [m/s], [m/s^2]
  Vec3 velocity_correction{0.0};  // [m/s], of the method's path, contained in v (contact.cpp)
  Vec3 free_correction{0.0};      // [m/s], of that path without contact
  Vec3 free_acceleration{0.0};    // [m/s^2], without contact
  double velocity_change = 0.0;   // [m/s], of the whole substep without contact
  // [m/s^2], by which a sticky plane holds it after an impact without a rebound (forces/terms/sticking.h); 0: it does not
  double adhesion = 0.0;
  Vec3 held{0.0};  // [m/s^2], that it balances
  // [m], [m/s], at the start of the substep; v with the part of the correction that contacts at rest leave, without work
  Vec3 start_x{0.0}, start_v{0.0};
  bool is_changed = false;  // by contact
  bool is_listed = false;   // among the paths of TouchSimulation::changed

  Vec3 position(double t) const { return x + (t - time) * (v + 0.5 * (t - time) * a); }
  Vec3 velocity(double t) const { return v + (t - time) * a; }
  void advance(double t) {
    x = position(t);
    v = velocity(t);
    time = t;
  }
  // [J], of contact so far, in addition to that of the forces: m (v^2 - v0^2) / 2 - m a (x - x0).
  double contact_work() const {
    const double kinetic = 0.5 * (glm::dot(v, v) - glm::dot(start_v, start_v));
    return (kinetic - glm::dot(free_acceleration, x - start_x)) / inverse_mass;
  }
};

// A point and another point or an obstacle, which it touches where their distance is `distance`.
struct Touch {
  std::size_t first = no_path, second = no_path;  // paths, the second perhaps that of an obstacle
  const Obstacle* obstacle = nullptr;
  Index point = no_index, other = no_index;  // the first point, and the second or, from -2 down, the obstacle: the same in every substep
  double distance = 0.0;                     // [m]: for a pair, the sum of both radii and the thickness; for an obstacle, the radius
  double restitution = 0.0;                  // [1]
  double friction = 0.0;                     // [1]
  double time = never;                       // [s], of the next impact
  bool is_near = false, is_at_rest = false;  // at the start of the substep; and since then
  bool waits = false;                        // for the next substep, unless it approaches fast
  bool rebounds = false;                     // from the impact in progress

  // for the impulses of contacts at rest and of impacts
  Vec3 normal{0.0};           // from the second to the first
  double gap = 0.0;           // [m]
  double curvature = 0.0;     // [1/m], of the path of the first about the second
  double min_velocity = 0.0;  // [m/s], that the first must reach along the normal, relative to the second
  Vec3 surface{0.0};          // [m/s], of the surface of an obstacle relative to its shape
  ContactImpulse impulse;

  // [m], by which the shape is inflated: pairs are a point and a ball of the distance
  double inflation() const { return obstacle != nullptr ? distance : 0.0; }
};

}  // namespace hooke
