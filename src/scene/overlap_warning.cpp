#include "scene/overlap_warning.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/number_text.h"
#include "scene/crossed_parts.h"
#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_plan.h"

namespace hooke {

std::optional<std::string> overlap_warning(const System& system, const State& state) {
  if (!system.contact.points || system.point_count() == 0) return std::nullopt;
  const Plan plan = make_plan(system, Numbering::AsListed);
  Motion motion;
  pack(plan, state, motion);
  std::vector<double> extent;
  for (const Point& point : system.points()) extent.push_back(point.radius + 0.5 * system.contact.thickness);
  std::vector<PointPair> pairs;
  const bool is_complete = PairSearch().find(plan, motion.x, extent, pairs, PairSolver::max_pairs);

  constexpr double ignored = 1e-3;
  std::size_t count = 0;
  double depth = 0.0;
  PointPair deepest;
  for (const PointPair& pair : pairs) {
    const double touching = extent[pair.i] + extent[pair.j],
                 overlap = touching - glm::distance(state.position[pair.i], state.position[pair.j]);
    if (!(overlap > ignored * touching)) continue;
    ++count;
    if (overlap <= depth) continue;
    depth = overlap;
    deepest = pair;
  }
  if (count == 0) return std::nullopt;
  return "contact.points: " + std::string(is_complete ? "" : "at least ") + std::to_string(count) +
         (count == 1 ? " pair of points overlaps" : " pairs of points overlap") + ", points " + std::to_string(deepest.i) + " and " +
         std::to_string(deepest.j) + " most, by " + quantity_text(depth, "m", 2) +
         ": they cannot get closer; accelerations separate deep overlaps slowly";
}

std::optional<std::string> crossing_warning(const System& system, const State& state) {
  if (!system.contact.faces) return std::nullopt;
  if (system.dimensions == 2) return "contact.faces: faces touch in scenes of 3 dimensions only: this one has 2";
  const CrossedParts crossed = find_crossed_parts(system, state);
  if (crossed.edges.empty()) return std::nullopt;
  const auto name_of = [&](PointId id) { return std::to_string(system.index_of(id)); };
  const auto& [p, q] = crossed.edges[0];
  const auto& [a, b, c] = crossed.faces[0];
  return std::string("contact.faces: ") + (crossed.is_complete ? "" : "at least ") + std::to_string(crossed.edges.size()) +
         (crossed.edges.size() == 1 ? " edge passes" : " edges pass") + " through faces, the one of points " + name_of(p) + " and " +
         name_of(q) + " through that of points " + name_of(a) + ", " + name_of(b) + " and " + name_of(c) +
         ": they do not touch until they are apart";
}

std::optional<std::string> loose_point_warning(const System& system) {
  const SurfacePlan plan = plan_surface(system);
  if (!plan.on) return std::nullopt;
  // what hangs on springs, or is nailed, is where it is to be
  std::vector<char> is_loose;
  for (const Point& point : system.points()) is_loose.push_back(point.nailed ? 0 : 1);
  for (const Index i : plan.points) is_loose[i] = 0;
  for (const Spring& spring : system.springs())
    for (const PointId end : {spring.first, spring.second}) is_loose[system.index_of(end)] = 0;
  const auto count = std::ranges::count(is_loose, 1);
  if (count == 0) return std::nullopt;
  const auto first = std::ranges::find(is_loose, 1) - is_loose.begin();
  if (count == 1) return "contact: point " + std::to_string(first) + " is on no spring or face: it passes through springs and faces";
  return "contact: " + std::to_string(count) + " points are on no spring or face, such as point " + std::to_string(first) +
         ": they pass through springs and faces";
}

std::optional<std::string> thickness_warning(const System& system) {
  const SurfacePlan plan = plan_surface(system);
  const double given = system.contact.thickness;
  if (!plan.on || given == 0.0) return std::nullopt;
  const auto [min, max] = std::ranges::minmax(plan.thickness);
  if (min == given && max == given) return std::nullopt;
  const bool is_long = min < given;
  return "contact.thickness: " + quantity_text(given, "m", 3) + (is_long ? " is more than half of" : " is less than a twentieth of") +
         " the smallest height of some faces, or length of springs: they touch at " + quantity_text(is_long ? min : max, "m", 3);
}

}  // namespace hooke
