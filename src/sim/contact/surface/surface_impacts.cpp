#include "sim/contact/surface/surface_impacts.h"

#include <algorithm>
#include <numeric>

#include "sim/contact/constants.h"
#include "sim/contact/surface/surface_contacts.h"

namespace hooke {
namespace {

// Passes with joined points: each joins at least two.
constexpr int max_passes = 1000;

// Distances on paths in a substep, for a surface of so many points: those that any usual motion takes, and at most, in a second; and beyond
// the former in a frame, in some seconds. A motion that diverges, so that each point crosses the whole scene in a substep, takes a
// thousand for each pair.
long usual_distances(std::size_t points) { return 100 * static_cast<long>(points); }
constexpr long max_distances = 5'000'000, max_excess = 20'000'000;

}  // namespace

void SurfaceImpacts::prevent(const SurfacePlan& plan, SurfaceDetection& detection, std::span<const double> inverse_mass,
                             std::span<const Vec3> x, double h, Index held, std::span<Vec3> u) {
  zone_.clear();
  const long usual = usual_distances(x.size()), start = distances_;
  for (int pass = 0; pass < max_passes; ++pass) {
    has_failed_ = !detection.change_velocities(plan, u);
    bool hits = false;
    for (const MeetingFeatures& pair : detection.meeting()) {
      if (has_failed_) break;
      FourPoints from, displacement;
      for (int c = 0; c < 4; ++c) from[c] = x[pair.points[c]], displacement[c] = h * u[pair.points[c]];
      const double part = free_part(pair.kind, from, displacement, pair.distance, distances_);
      if (part == 1.0) continue;
      if (pass < contact::impact_passes)
        respond(pair, inverse_mass, x, part * h, held, u), hits = true;
      else
        hits = join(pair.points, inverse_mass, u) || hits;
      has_failed_ = distances_ > max_distances + usual || excess_ + distances_ > max_excess + usual;
    }
    if (has_failed_ || !hits) break;
  }
  excess_ += std::max(0L, distances_ - start + detection.tests() - usual);
  has_failed_ = has_failed_ || excess_ > max_excess;
}

// An inelastic impact after this time [s]. If an impulse cannot help, the passes that join do.
void SurfaceImpacts::respond(const MeetingFeatures& pair, std::span<const double> inverse_mass, std::span<const Vec3> x, double time,
                             Index held, std::span<Vec3> u) {
  FourPoints at;
  for (int c = 0; c < 4; ++c) at[c] = x[pair.points[c]] + time * u[pair.points[c]];
  const Closest closest = closest_points(pair.kind, at);
  SurfaceContact contact{.points = pair.points, .weight = closest.weight};
  if (!(closest.distance > 0.0) || !contact.weigh(inverse_mass)) return;
  contact.law.normal = closest.separation / closest.distance;
  contact.limit(inverse_mass, held, u);
  contact.apply(contact.law.solve(contact.relative(u)), inverse_mass, u);
}

// From now on these points, with all that already move together with them, have the same velocity: their mean, or that of a fixed one.
// False if they have already, or if two that are fixed do not.
bool SurfaceImpacts::join(const std::array<Index, 4>& points, std::span<const double> inverse_mass, std::span<Vec3> u) {
  const std::size_t n = u.size();
  if (zone_.size() != n) {
    zone_.resize(n);
    std::iota(zone_.begin(), zone_.end(), 0);
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
    if (inverse_mass[k] == 0.0) {
      fixed = u[k];
      has_fixed = true;
    } else {
      mass += 1.0 / inverse_mass[k];
      momentum += u[k] / inverse_mass[k];
    }
  }
  const Vec3 velocity = has_fixed ? fixed : momentum / mass;
  for (std::size_t k = 0; k < n; ++k) {
    if (zone_[k] == first && inverse_mass[k] != 0.0) u[k] = velocity;
  }
  return true;
}

}  // namespace hooke
