#include "scene/crossed_parts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_tree.h"

namespace hooke {

CrossedParts find_crossed_parts(const System& system, const State& state) {
  CrossedParts parts;
  if (!system.contact.faces || system.dimensions == 2) return parts;
  const SurfacePlan plan = plan_surface(system);
  if (!plan.on) return parts;
  std::vector<Vec3> place;
  for (const Index i : plan.points) place.push_back(state.position[i]);
  SurfaceTree tree;
  tree.build(plan, place);
  const auto [crossings, is_complete] = tree.find_crossings(place);
  parts.is_complete = is_complete;
  const auto id_of = [&](Index point) { return system.points()[plan.points[point]].id; };
  for (const auto& [edge, face] : crossings) {
    const auto& [p, q] = plan.edges[edge];
    const auto& [a, b, c] = plan.pieces[face].points;
    parts.edges.push_back({id_of(p), id_of(q)});
    parts.faces.push_back({id_of(a), id_of(b), id_of(c)});
  }
  return parts;
}

namespace {

// The first point of the part of each point; nails join nothing.
std::vector<Index> parts_of(const System& system) {
  std::vector<Index> root(static_cast<std::size_t>(system.point_count()));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const Spring& spring : system.springs()) {
    const Index i = find(system.index_of(spring.first)), j = find(system.index_of(spring.second));
    root[std::max(i, j)] = std::min(i, j);
  }
  for (Index i = 0; i < system.point_count(); ++i) root[i] = find(i);
  return root;
}

// Twice the area of the triangle, positive if it turns to the left.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

struct Segment {
  Vec3 first, second;
  Index part;
  double begin() const { return std::min(first.x, second.x); }
  double end() const { return std::max(first.x, second.x); }
};

bool cross(const Segment& a, const Segment& b) {
  return turn(a.first, a.second, b.first) * turn(a.first, a.second, b.second) < 0.0 &&
         turn(b.first, b.second, a.first) * turn(b.first, b.second, a.second) < 0.0;
}

long count_crossing_springs(const System& system, const State& state) {
  const std::vector<Index> part = parts_of(system);
  std::vector<Segment> segments;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    segments.push_back({state.position[i], state.position[j], part[i]});
  }
  std::ranges::sort(segments, {}, &Segment::begin);
  long count = 0;
  for (std::size_t a = 0; a < segments.size(); ++a)
    for (std::size_t b = a + 1; b < segments.size() && segments[b].begin() <= segments[a].end(); ++b)
      if (segments[a].part != segments[b].part && cross(segments[a], segments[b])) ++count;
  return count;
}

}  // namespace

long count_crossings(const System& system, const State& state) {
  if (system.dimensions == 2) return count_crossing_springs(system, state);
  System touching = system;
  touching.contact.faces = true;
  return static_cast<long>(find_crossed_parts(touching, state).edges.size());
}

double max_overlap(const System& system, const State& state) {
  if (system.point_count() == 0) return 0.0;
  const Plan plan = make_plan(system, Numbering::AsListed);
  Motion motion;
  pack(plan, state, motion);
  std::vector<double> extent;
  for (const Point& point : system.points()) extent.push_back(point.radius);
  std::vector<PointPair> pairs;
  PairSearch().find(plan, motion.x, extent, pairs, PairSolver::max_pairs);
  double max = 0.0;
  for (const PointPair& pair : pairs)
    max = std::max(max, extent[pair.i] + extent[pair.j] - glm::distance(state.position[pair.i], state.position[pair.j]));
  return max;
}

}  // namespace hooke
