#include "scene/crossed_parts.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <ranges>

#include "base/number_text.h"
#include "scene/placed_surface.h"
#include "sim/contact/pair_solver.h"

namespace hooke {
namespace {

// Whether the line through a and b has c and d on different sides, in the plane of flat scenes.
bool separates(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto side = [&](const Vec3& x) { return (b.x - a.x) * (x.y - a.y) - (b.y - a.y) * (x.x - a.x); };
  const double first = side(c), second = side(d);
  return (first < 0.0 && second > 0.0) || (first > 0.0 && second < 0.0);
}

void find_surfaces(const System& system, PlacedSurface& surface, CrossedParts& parts) {
  auto& [plan, place, tree] = surface;
  if (!plan.on) return;
  const auto id_of = [&, &points = plan.points](Index point) { return system.points()[points[point]].id; };
  if (system.dimensions == 3) {
    const auto [crossings, is_complete] = tree.find_crossings(plan, place);
    parts.is_complete = is_complete;
    for (const auto& [edge, face] : crossings) {
      const auto& [p, q] = plan.edges[edge];
      const auto& [a, b, c] = plan.pieces[face].points;
      parts.edges.push_back({id_of(p), id_of(q)});
      parts.faces.push_back({id_of(a), id_of(b), id_of(c)});
    }
    return;
  }
  // the distance of springs that cross is 0 up to rounding
  constexpr double reach = 1e-6;
  constexpr std::size_t max_pairs = 1'000'000;
  SurfacePairs close;
  parts.is_complete = tree.find_pairs(plan, place, reach * plan.max_thickness, {}, max_pairs, close);
  for (const SurfacePair& pair : close | std::views::join) {
    const auto& [p, q, r, s] = pair.points;
    if (!separates(place[p], place[q], place[r], place[s]) || !separates(place[r], place[s], place[p], place[q])) continue;
    parts.springs.push_back({id_of(p), id_of(q)});
    parts.across.push_back({id_of(r), id_of(s)});
  }
}

// Of spheres, and of faces and springs that touch them.
void find_spheres(const System& system, PlacedSurface& surface, CrossedParts& parts) {
  auto& [plan, place, tree] = surface;
  if (!plan.on || plan.radius.empty()) return;
  SurfacePairs pairs;
  parts.has_all_spheres = tree.find_pairs(plan, place, plan.max_thickness, {}, PairSolver::max_pairs, pairs);
  constexpr double ignored = 1e-3;
  for (const SurfacePair& pair : pairs | std::views::join) {
    const double depth = -pair.distance;
    if (!(depth > ignored * plan.radius_of(pair.points))) continue;
    parts.spheres.push_back(system.points()[plan.points[pair.points[0]]].id);
    if (depth <= parts.sphere_depth) continue;
    parts.sphere_depth = depth;
    parts.deepest_sphere = parts.spheres.back();
  }
  std::ranges::sort(parts.spheres);
  parts.spheres.erase(std::unique(parts.spheres.begin(), parts.spheres.end()), parts.spheres.end());
}

void find_points(const System& system, const State& state, CrossedParts& parts) {
  const Plan plan = make_plan(system);
  Motion motion;
  pack(plan, state, motion);
  std::vector<double> extent;
  for (const Point& point : system.points()) extent.push_back(point.radius + 0.5 * system.contact.thickness);
  std::vector<PointPair> pairs;
  parts.has_all_points = PairSearch().find(plan, motion.x, extent, pairs, PairSolver::max_pairs);

  constexpr double ignored = 1e-3;
  for (const auto& [i, j] : pairs) {
    const double touching = extent[i] + extent[j], overlap = touching - glm::distance(state.position[i], state.position[j]);
    if (!(overlap > ignored * touching)) continue;
    parts.points.push_back({system.points()[i].id, system.points()[j].id});
    if (overlap <= parts.depth) continue;
    parts.depth = overlap;
    parts.deepest = parts.points.back();
  }
}

std::string count_of(std::size_t count, bool is_complete, const char* one, const char* many) {
  return (is_complete ? "" : "at least ") + std::to_string(count) + (count == 1 ? one : many);
}

}  // namespace

CrossedParts find_crossed_parts(const System& system, const State& state) {
  CrossedParts parts;
  PlacedSurface surface = place_surface(system, state);
  find_surfaces(system, surface, parts);
  find_spheres(system, surface, parts);
  if (system.contact.points && system.point_count() > 0) find_points(system, state, parts);
  return parts;
}

std::vector<CrossedText> describe(const CrossedParts& parts, const System& system) {
  std::vector<CrossedText> texts;
  const auto name_of = [&](PointId id) { return std::to_string(system.index_of(id)); };
  const auto names_of = [&](const std::array<PointId, 2>& ends) { return name_of(ends[0]) + " and " + name_of(ends[1]); };
  constexpr const char* apart = "they do not touch until they are apart";
  if (!parts.edges.empty()) {
    const auto& [a, b, c] = parts.faces[0];
    texts.push_back({"contact.faces", count_of(parts.edges.size(), parts.is_complete, " edge passes", " edges pass") + " through faces",
                     ", the one of points " + names_of(parts.edges[0]) + " through that of points " + name_of(a) + ", " + name_of(b) +
                         " and " + name_of(c),
                     apart});
  }
  if (!parts.springs.empty())
    texts.push_back({"contact.springs",
                     count_of(parts.springs.size(), parts.is_complete, " pair of springs crosses", " pairs of springs cross"),
                     ", the one of points " + names_of(parts.springs[0]) + " that of points " + names_of(parts.across[0]), apart});
  if (!parts.spheres.empty())
    texts.push_back({system.contact.faces && system.dimensions == 3 ? "contact.faces" : "contact.springs",
                     count_of(parts.spheres.size(), parts.has_all_spheres, " point overlaps", " points overlap") + " faces or springs",
                     ", point " + name_of(parts.deepest_sphere) + " most, by " + quantity_text(parts.sphere_depth, "m", 2),
                     "each leaves them on the side of its center"});
  if (!parts.points.empty())
    texts.push_back({"contact.points",
                     count_of(parts.points.size(), parts.has_all_points, " pair of points overlaps", " pairs of points overlap"),
                     ", points " + names_of(parts.deepest) + " most, by " + quantity_text(parts.depth, "m", 2),
                     "they cannot get closer; accelerations separate deep overlaps slowly"});
  return texts;
}

std::size_t count_crossings(const System& system, const State& state) {
  System touching = system;
  touching.contact.faces = touching.dimensions == 3;
  touching.contact.springs = touching.dimensions == 2;
  CrossedParts parts;
  PlacedSurface surface = place_surface(touching, state);
  find_surfaces(touching, surface, parts);
  return parts.edges.size() + parts.springs.size();
}

}  // namespace hooke
