#include "scene/warnings/warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ranges>

#include "base/disjoint_sets.h"
#include "base/number_text.h"
#include "scene/crossed_parts.h"
#include "scene/placed_surface.h"
#include "sim/contact/constants.h"
#include "sim/plan/surface_plan.h"

namespace hooke {

namespace {

// Features that start far closer to each other than their thickness, or in one place.
std::optional<std::string> close_start_warning(const System& system, const State& state) {
  auto [plan, place, tree] = place_surface(system, state);
  if (!plan.on) return std::nullopt;
  constexpr std::size_t max_pairs = 1'000'000;
  SurfacePairs pairs;
  const bool is_complete = tree.find_pairs(plan, place, plan.max_thickness, {}, max_pairs, pairs);

  std::size_t count = 0, count_in_one_place = 0;
  double depth = 0.0, touching = 0.0;
  std::array<Index, 4> deepest{};
  bool is_face = false;
  for (const SurfacePair& pair : pairs | std::views::join) {
    const double thickness = plan.thickness_of(pair.points), distance = pair.distance, separation = distance + plan.radius_of(pair.points);
    // bent sheets touch at a quarter of it
    if (distance >= thickness / 8.0) continue;
    if (separation < contact::coincident * plan.max_thickness) {
      ++count_in_one_place;
      continue;
    }
    ++count;
    if (thickness - distance <= depth) continue;
    depth = thickness - distance;
    touching = thickness;
    deepest = pair.points;
    is_face = pair.kind == FeaturePair::PointFace;
  }
  const std::string setting = std::string("contact.") + (system.contact.faces && system.dimensions == 3 ? "faces" : "springs") + ": ";
  if (count == 0 && count_in_one_place > 0)
    return setting + (is_complete ? "" : "at least ") + std::to_string(count_in_one_place) +
           (count_in_one_place == 1 ? " pair is" : " pairs are") + " in the same place, where they never touch: move one of them apart";
  if (count == 0) return std::nullopt;
  const auto name_of = [&, &points = plan.points](int c) { return std::to_string(points[deepest[static_cast<std::size_t>(c)]]); };
  const auto is_sphere = [&](std::size_t c) { return deepest[c] == deepest[c + 1]; };
  const auto ends_of = [&](int c) { return name_of(c) + " and " + name_of(c + 1); };
  const std::string edges = is_sphere(0)   ? "point " + name_of(0) + " and the edge of points " + ends_of(2)
                            : is_sphere(2) ? "the edge of points " + ends_of(0) + " and point " + name_of(2)
                                           : "the edge of points " + ends_of(0) + " and that of points " + ends_of(2);
  return setting + (is_complete ? "" : "at least ") + std::to_string(count) + (count == 1 ? " pair starts" : " pairs start") +
         " closer than an eighth of the thickness, " +
         (is_face ? "point " + name_of(0) + " and the face of points " + name_of(1) + ", " + name_of(2) + " and " + name_of(3) : edges) +
         " most, by " + quantity_text(depth, "m", 2) + " of " + quantity_text(touching, "m", 2) +
         ": move them apart, because they separate slowly and may supply energy";
}

// Springs that may touch, unless both ends are on faces: those of a lattice cross each other at rest.
bool is_thread(const Spring& spring) {
  return (spring.family == SpringFamily::None || spring.family == SpringFamily::Structural) && spring.first != spring.second;
}

// Springs between two points of faces touch nothing. In a sheet or a solid, faces are in front of them; a spring that leads from one
// surface to another has none. Springs shorter than the thickness keep two surfaces together.
std::optional<std::string> bridge_warning(const System& system) {
  if (!system.contact.faces || !system.contact.springs || system.dimensions == 2 || system.faces.empty()) return std::nullopt;
  const auto n = static_cast<std::size_t>(system.point_count());
  DisjointSets surfaces(n);
  std::vector<char> is_on_face(n, 0);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) {
      const Index i = system.index_of(id);
      surfaces.join(system.index_of(face.points[0]), i);
      is_on_face[i] = 1;
    }
  const double thickness = plan_surface(system).max_thickness;
  std::size_t count = 0;
  Index first = 0, second = 0;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const bool is_bridge = is_thread(spring) && is_on_face[i] != 0 && is_on_face[j] != 0 && surfaces.root(i) != surfaces.root(j);
    if (!is_bridge || spring.rest_length <= thickness) continue;
    if (count++ == 0) first = i, second = j;
  }
  if (count == 0) return std::nullopt;
  return "contact.springs: " + std::to_string(count) + (count == 1 ? " spring joins" : " springs join") + " two surfaces and " +
         (count == 1 ? "touches" : "touch") + " nothing, between points " + std::to_string(first) + " and " + std::to_string(second) +
         (count == 1 ? "" : " for example") + ": divide it by a point, so that both halves touch";
}

// Faces, and springs of parts without any, of which only one kind touches: the other passes through. Parts are what springs and faces hold
// together; the springs inside solids are behind faces.
std::optional<std::string> one_sided_warning(const System& system) {
  const PairContact& contact = system.contact;
  if (contact.faces == contact.springs || system.dimensions == 2 || system.faces.empty()) return std::nullopt;
  const auto n = static_cast<std::size_t>(system.point_count());
  DisjointSets parts(n);
  for (const Spring& spring : system.springs()) parts.join(system.index_of(spring.first), system.index_of(spring.second));
  for (const Face& face : system.faces)
    for (const PointId id : face.points) parts.join(system.index_of(face.points[0]), system.index_of(id));
  std::vector<char> has_faces(n, 0), moves(n, 0);  // per part, at its root
  for (const Face& face : system.faces) has_faces[parts.root(system.index_of(face.points[0]))] = 1;
  for (Index i = 0; i < system.point_count(); ++i)
    if (!system.points()[i].nailed) moves[parts.root(i)] = 1;

  Face face = system.faces[0];  // one that moves, if any does
  for (const Face& each : system.faces)
    if (moves[parts.root(system.index_of(face.points[0]))] == 0) face = each;
  const bool faces_move = moves[parts.root(system.index_of(face.points[0]))] != 0;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second), part = parts.root(i);
    if (!is_thread(spring) || has_faces[part] != 0 || (moves[part] == 0 && !faces_move)) continue;
    const auto name_of = [&](int corner) { return std::to_string(system.index_of(face.points[corner])); };
    return std::string(contact.faces ? "contact.springs" : "contact.faces") + ": off: springs such as that of points " + std::to_string(i) +
           " and " + std::to_string(j) + " pass through faces such as that of points " + name_of(0) + ", " + name_of(1) + " and " +
           name_of(2) + ": switch it on";
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::string> crossing_warnings(const System& system, const State& state) {
  std::vector<std::string> warnings;
  if (system.contact.faces && system.dimensions == 2)
    warnings.emplace_back("contact.faces: faces touch in scenes of 3 dimensions only: this one has 2");
  if (auto warning = one_sided_warning(system)) warnings.push_back(*std::move(warning));
  if (auto warning = bridge_warning(system)) warnings.push_back(*std::move(warning));
  const CrossedParts crossed = find_crossed_parts(system, state);
  for (const CrossedText& text : describe(crossed, system))
    warnings.push_back(std::string(text.setting) + ": " + text.count + text.detail + ": " + text.consequence);
  // what crosses is closer as well
  if (crossed.edges.empty() && crossed.springs.empty() && crossed.spheres.empty())
    if (auto warning = close_start_warning(system, state)) warnings.push_back(*std::move(warning));
  return warnings;
}

std::optional<std::string> thickness_warning(const System& system) {
  const SurfacePlan plan = plan_surface(system);
  const double given = system.contact.thickness;
  if (!plan.on || given == 0.0) return std::nullopt;
  double min = std::numeric_limits<double>::infinity(), max = 0.0;
  for (const double thickness : plan.thickness)
    if (std::isfinite(thickness)) min = std::min(min, thickness), max = std::max(max, thickness);
  constexpr double round_off = 1e-12;
  const bool is_long = min<given*(1.0 - round_off), is_short = max> given * (1.0 + round_off);
  if (!is_long && !is_short) return std::nullopt;
  const std::string of_small = " more than half of the smallest faces or springs, which touch at " + quantity_text(min, "m", 3),
                    of_large = " less than a twentieth of the largest faces or springs, which touch at " + quantity_text(max, "m", 3);
  return "contact.thickness: " + quantity_text(given, "m", 3) + ": is" + (is_long ? of_small : "") + (is_long && is_short ? ", and" : "") +
         (is_short ? of_large : "");
}

}  // namespace hooke
