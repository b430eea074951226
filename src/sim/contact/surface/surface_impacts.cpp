// The part of SurfaceStep that makes the paths within a substep free of impacts.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/contact/surface/surface_step.h"

namespace hooke {
namespace {

// Passes of continuous collision detection with impacts, and those in which what hits each other starts to move together.
constexpr int impact_passes = 6, max_passes = 1000;

// Distances on paths in a substep, for a surface of so many points: those that any usual motion takes, and at most, in a tenth of a second.
// A motion that diverges, so that each point crosses the whole scene in a substep, takes a thousand for each pair.
long usual_distances(std::size_t points) { return 100 * static_cast<long>(points); }
long max_distances(std::size_t points) { return 5'000'000 + usual_distances(points); }
// In a frame, with the pairs that are examined and the impulses, beyond usual_distances of each substep: seconds.
constexpr long max_excess = 40'000'000;

}  // namespace

// Returns whether anything hit. The paths that remain are free of impacts.
bool SurfaceStep::prevent_crossings(const Plan& plan, double h) {
  bool any = false;
  hits_.clear();
  distances_ = 0;
  long excess = 0;
  for (int pass = 0;; ++pass) {
    if (has_failed_ = !search_.change_path(plan, x_, path_); has_failed_) return any;
    if (pass == max_passes) break;
    bool hits = false;
    for (const FeaturePair kind : {FeaturePair::PointFace, FeaturePair::TwoEdges})
      // what is farther away is free on all of its path
      search_.visit_approaching(plan.surface, kind, 0.9, [&](const SurfacePair& pair, double distance) {
        if (distances_ > max_distances(x_.size())) return;
        FourPoints displacement = four(path_, pair.points);
        for (Vec3& d : displacement) d *= h;
        const double part = free_part(kind, four(x_, pair.points), displacement, distance, distances_);
        if (part < 1.0 && handle_impact(pair, part, h, pass >= impact_passes)) hits = true;
      });
    excess = distances_ + search_.tests() + contacts_.impulses - usual_distances(x_.size());
    has_failed_ = distances_ > max_distances(x_.size()) || excess_ + excess > max_excess;
    if (has_failed_ || !hits) break;
    any = true;
  }
  excess_ += std::max(0L, excess);
  zone_.clear();
  return any;
}

// An inelastic impact at this part of the substep. Returns whether it changed anything.
bool SurfaceStep::handle_impact(const SurfacePair& pair, double part, double h, bool joins) {
  const std::array<Index, 4>& points = pair.points;
  ++impacts_;
  ++contacts_.impulses;
  if (joins) return join(points);
  FourPoints at = four(x_, points);
  for (int c = 0; c < 4; ++c) at[c] += part * h * path_[points[c]];
  const Closest closest = closest_points(pair.kind, at);
  double response = 0.0;
  Vec3 relative(0.0);
  for (int c = 0; c < 4; ++c) {
    response += closest.weight[c] * closest.weight[c] * inverse_mass_[points[c]];
    relative += closest.weight[c] * path_[points[c]];
  }
  // if an impulse cannot help, the passes that join do
  if (response == 0.0 || closest.distance < coincident) return true;
  const Vec3 normal = closest.separation / closest.distance;
  double velocity = glm::dot(normal, relative);
  if (!(velocity < 0.0)) return true;
  if (std::ranges::find(points, held_) != points.end())
    velocity = -response * limited_impulse(points, closest.weight, normal, -velocity / response, -velocity, inverse_mass_, path_);
  hits_.push_back({points, closest.weight, -velocity / response * normal});
  for (int c = 0; c < 4; ++c) {
    path_[points[c]] -= inverse_mass_[points[c]] * closest.weight[c] * velocity / response * normal;
    if (points[c] == held_) held_impulse_ += std::abs(closest.weight[c] * velocity / response);
  }
  return true;
}

// From now on these points, with all that already move together with them, have the same velocity: their mean, or that of a fixed one.
// False if they have already, or if two that are fixed do not.
bool SurfaceStep::join(const std::array<Index, 4>& points) {
  const std::size_t n = x_.size();
  if (zone_.size() != n) {
    zone_.resize(n);
    for (std::size_t k = 0; k < n; ++k) zone_[k] = static_cast<Index>(k);
  }
  const std::array<Index, 4> zones{zone_[points[0]], zone_[points[1]], zone_[points[2]], zone_[points[3]]};
  if (std::ranges::all_of(zones, [&](Index zone) { return zone == zones[0]; })) return false;
  const Index first = std::ranges::min(zones);
  double mass = 0.0;
  Vec3 momentum(0.0), fixed(0.0);
  bool has_fixed = false;
  for (std::size_t k = 0; k < n; ++k) {
    if (std::ranges::find(zones, zone_[k]) == zones.end()) continue;
    zone_[k] = first;
    if (inverse_mass_[k] == 0.0) {
      fixed = path_[k];
      has_fixed = true;
    } else {
      mass += 1.0 / inverse_mass_[k];
      momentum += path_[k] / inverse_mass_[k];
    }
  }
  const Vec3 velocity = has_fixed ? fixed : momentum / mass;
  for (std::size_t k = 0; k < n; ++k)
    if (zone_[k] == first && inverse_mass_[k] != 0.0) {
      if (has_fixed) held_impulse_ += glm::length(path_[k] - velocity) / inverse_mass_[k];
      path_[k] = velocity;
    }
  return true;
}

}  // namespace hooke
