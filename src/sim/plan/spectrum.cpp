#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/model/portable_math.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

// Per point: the sum over its row of the norms of the 3x3 blocks of M^-1/2 K M^-1/2, K of the springs and the pull [1/s^2], and likewise of
// the dashpots [1/s].
struct SpectrumRows {
  std::vector<double> stiffness, dashpot;
  double min_dashpot_ratio = std::numeric_limits<double>::infinity();  // [s], of damping / stiffness
};

SpectrumRows rows_of_springs(const System& system) {
  const std::vector<double> zeros(system.points().size(), 0.0);
  SpectrumRows rows{zeros, zeros};
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Point &first = system.points()[i], &second = system.points()[j];
    const double coupling = first.nailed || second.nailed ? 0.0 : 1.0 / std::sqrt(first.mass * second.mass);
    const double stiffness = system.stiffness_bound_of(spring), damping = system.damping_of(spring);
    for (const auto& [at, point] : {std::pair{i, &first}, std::pair{j, &second}}) {
      if (point->nailed) continue;
      const double weight = 1.0 / point->mass + coupling;
      rows.stiffness[at] += stiffness * weight;
      rows.dashpot[at] += damping * weight;
    }
    if (!(first.nailed && second.nailed) && stiffness > 0.0) rows.min_dashpot_ratio = std::min(rows.min_dashpot_ratio, damping / stiffness);
  }
  return rows;
}

// Adds K_ij = k w_i w_j I of the free points, w the weights.
void add_pull_rows(const System& system, const PlannedPull& pull, std::vector<double>& row) {
  for (const auto& [i, weight] : pull.points())
    for (const auto& [j, other] : pull.points()) {
      const Point &at = system.points()[i], &other_point = system.points()[j];
      if (at.nailed || other_point.nailed) continue;
      row[i] += pull.stiffness * weight * other / (i == j ? at.mass : std::sqrt(at.mass * other_point.mass));
    }
}

// The maximum distance of the surface of a collider from the origin [m], and the speed of its surface [m/s].
struct ColliderReach {
  double distance = 0.0, speed = 0.0;
};
ColliderReach reach_of(const Collider& collider) {
  ColliderReach reach{.distance = glm::length(anchor_of(collider)) + glm::length(collider.path.amplitude)};
  double radius = 1.0;
  if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) radius = sphere->radius;
  if (const auto* box = std::get_if<Box>(&collider.shape)) radius = 0.5 * glm::length(box->max - box->min);
  reach.distance += radius;
  constexpr double two_pi = 6.283185307179586;
  reach.speed = two_pi * collider.path.frequency * glm::length(collider.path.amplitude) + glm::length(collider.path.belt) +
                radius * glm::length(collider.path.spin);
  return reach;
}

}  // namespace

double plausible_reach(const System& system, const Spectrum& spectrum, double extent, double speed, double time) {
  double acceleration = glm::length(system.gravity);
  for (const Spring& spring : system.springs()) extent = std::max(extent, system.rest_length_of(spring, time));
  for (const Collider& collider : system.colliders) {
    if (!collider.solid) continue;
    const ColliderReach reach = reach_of(collider);
    extent = std::max(extent, reach.distance);
    speed += reach.speed;
  }
  acceleration += spectrum.force_acceleration;
  speed += glm::length(system.wind) + system.hand_speed + spectrum.force_speed + spectrum.omega * extent;
  if (!std::isfinite(acceleration)) {
    // A repulsion that increases with the distance leads away exponentially if its derivative is bounded. Otherwise it leads anywhere
    // within a short time, and no method follows it there.
    if (spectrum.is_bounded) return reach_margin * (extent + time * speed) * portable::exp(spectrum.omega * time);
    return std::max(1e9, 1e12 * (extent + time * speed));
  }
  return reach_margin * (extent + time * (speed + time * acceleration));
}

Spectrum bound_spectrum(const System& system, const Plan& prepared, double point_speed) {
  SpectrumRows rows = rows_of_springs(system);
  if (prepared.hand.pull) add_pull_rows(system, *prepared.hand.pull, rows.stiffness);

  Spectrum spectrum;
  for (std::size_t i = 0; i < rows.stiffness.size(); ++i) {
    spectrum.omega = std::max(spectrum.omega, rows.stiffness[i]);
    spectrum.dashpot_rate = std::max(spectrum.dashpot_rate, rows.dashpot[i]);
  }
  // eigenvalues of a sum of symmetric matrices are at most the sum of theirs
  double force_stiffness = 0.0, estimated_stiffness = 0.0, omitted_stiffness = 0.0;
  for (const Force& force : prepared.forces) {
    const ForceBound bound = force.term->bound(system, prepared, force.values, point_speed);
    spectrum.force_acceleration += bound.acceleration;
    spectrum.force_speed += bound.speed;
    spectrum.is_bounded = spectrum.is_bounded && std::isfinite(bound.stiffness) && std::isfinite(bound.rate);
    if (std::isfinite(bound.stiffness)) force_stiffness += bound.stiffness;
    if (std::isfinite(bound.rate)) spectrum.force_rate += bound.rate;
    estimated_stiffness += bound.estimated_stiffness;
    spectrum.estimated_rate += bound.estimated_rate;
    omitted_stiffness += bound.omitted_stiffness;
  }
  spectrum.estimated_omega = std::sqrt(estimated_stiffness);
  spectrum.omitted_omega = std::sqrt(omitted_stiffness);
  spectrum.force_omega = std::sqrt(force_stiffness);
  spectrum.omega = std::sqrt(spectrum.omega + force_stiffness);
  spectrum.drag_rate = system.drag_rate();
  spectrum.contact = has_contact(system);
  spectrum.points_touch = system.contact.points;
  spectrum.min_dashpot_ratio = std::isfinite(rows.min_dashpot_ratio) ? rows.min_dashpot_ratio : 0.0;
  return spectrum;
}

}  // namespace hooke
