// Parts that are inside each other in a scene in which they touch: edges through faces, springs across each other, overlapping points, and
// spheres (surface_plan.h) in faces or springs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

struct CrossedParts {
  // one entry of both for every edge and face that cross
  std::vector<std::array<PointId, 2>> edges;
  std::vector<std::array<PointId, 3>> faces;
  // one entry of both for every two springs that cross, in flat scenes
  std::vector<std::array<PointId, 2>> springs, across;
  // by more than a thousandth of the distance at which they touch
  std::vector<std::array<PointId, 2>> points;
  std::array<PointId, 2> deepest{};  // the pair of points that overlaps most
  double depth = 0.0;                // [m], its overlap
  // whose surface is in a face or spring, by more than a thousandth of their radius, and the depth [m] of the one that is deepest
  std::vector<PointId> spheres;
  PointId deepest_sphere{};
  double sphere_depth = 0.0;
  // false: so many parts are close to each other that the search ended
  bool is_complete = true, has_all_points = true, has_all_spheres = true;

  bool empty() const { return edges.empty() && springs.empty() && points.empty() && spheres.empty(); }
};

// Those of the present positions, of what touches. O(n log n).
CrossedParts find_crossed_parts(const System& system, const State& state);

// "2 edges pass through faces", and what becomes of them: a sentence for each kind that there is. `detail` follows the count.
struct CrossedText {
  const char* setting;  // "contact.faces"
  std::string count, detail, consequence;
};
std::vector<CrossedText> describe(const CrossedParts& parts, const System& system);

// Edges that pass through faces, and in flat scenes springs that cross each other, whether they touch or not. O(n log n), with a copy of
// the System.
std::size_t count_crossings(const System& system, const State& state);

}  // namespace hooke
