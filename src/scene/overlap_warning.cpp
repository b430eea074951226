#include "scene/overlap_warning.h"

#include <glm/geometric.hpp>

#include "base/number_text.h"
#include "sim/contact/pair_solver.h"

namespace hooke {

std::optional<std::string> overlap_warning(const System& system, const State& state) {
  if (!system.contact.points || system.point_count() == 0) return std::nullopt;
  const Plan plan = make_plan(system);
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

}  // namespace hooke
