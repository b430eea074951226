#include "app/view/arrows.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/round_number.h"
#include "sim/forces/forces.h"
#include "sim/forces/motion.h"

namespace hooke {
namespace {

constexpr Index max_arrow_points = 20'000;  // more arrows would cover the scene, and their forces would delay the window

// The largest is `longest` [m].
std::optional<Arrows> load_arrows(const Snapshot& snapshot, double longest) {
  const System& system = *snapshot.system;
  double largest = 0.0;
  for (Index i = 0; i < system.point_count() && system.point_count() <= max_arrow_points; ++i)
    largest = std::max(largest, glm::length(system.points()[i].load));
  if (largest == 0.0) return std::nullopt;
  Arrows arrows{.kind = Arrows::Kind::Load, .scale = round_below(longest / largest), .lines = {}};
  for (Index i = 0; i < system.point_count(); ++i)
    if (const Vec3& load = system.points()[i].load; load != Vec3(0.0))
      arrows.lines.emplace_back(snapshot.state.position[i], snapshot.state.position[i] + arrows.scale * load);
  return arrows;
}

}  // namespace

double velocity_arrow_seconds(double view_height) { return round_below(0.1 * std::sqrt(std::max(view_height, 1e-12))); }

std::optional<Arrows> ForceArrows::at(const Snapshot& snapshot, double longest) {
  const System& system = *snapshot.system;
  if (system.point_count() == 0 || system.point_count() > max_arrow_points) return std::nullopt;
  if (system_ != snapshot.system) {
    plan_ = make_plan(system);
    system_ = snapshot.system;
  }
  Motion motion;
  pack(plan_, snapshot.state, motion);
  Field f(motion.x.size());
  compute_forces(plan_, motion.time, motion.x, motion.v, f);
  double largest = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) largest = std::max(largest, glm::length(vector_at(plan_, f, i)));
  if (!(largest > 0.0) || !std::isfinite(largest)) return std::nullopt;
  Arrows arrows{.kind = Arrows::Kind::Force, .scale = round_below(longest / largest), .lines = {}};
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3& from = snapshot.state.position[i];
    arrows.lines.emplace_back(from, from + arrows.scale * vector_at(plan_, f, i));
  }
  return arrows;
}

std::vector<Arrows> make_arrows(const Snapshot& snapshot, const ViewOptions& options, double view_height, ForceArrows& forces) {
  std::vector<Arrows> all;
  if (options.velocities && snapshot.system->point_count() <= max_arrow_points) {
    Arrows arrows{.kind = Arrows::Kind::Velocity, .scale = velocity_arrow_seconds(view_height), .lines = {}};
    for (std::size_t i = 0; i < snapshot.state.position.size(); ++i) {
      const Vec3& from = snapshot.state.position[i];
      arrows.lines.emplace_back(from, from + arrows.scale * snapshot.state.velocity[i]);
    }
    all.push_back(std::move(arrows));
  }
  if (auto arrows = load_arrows(snapshot, 0.15 * view_height)) all.push_back(std::move(*arrows));
  if (options.forces)
    if (auto arrows = forces.at(snapshot, 0.15 * view_height)) all.push_back(std::move(*arrows));
  return all;
}

}  // namespace hooke
