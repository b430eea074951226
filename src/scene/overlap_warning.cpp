#include "scene/overlap_warning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "scene/crossed_parts.h"
#include "scene/placed_surface.h"
#include "sim/contact/closest.h"
#include "sim/contact/surface/surface_plan.h"

namespace hooke {

namespace {

// Features that start far closer to each other than their thickness, or in one place.
std::optional<std::string> close_start_warning(const System& system, const State& state) {
  auto [plan, place, tree] = place_surface(system, state);
  if (!plan.on) return std::nullopt;
  constexpr std::size_t max_pairs = 1'000'000;
  std::vector<SurfacePair> pairs;
  const bool is_complete = tree.find_pairs(plan, place, plan.max_thickness, {}, pairs, max_pairs);

  std::size_t count = 0, count_in_one_place = 0;
  double depth = 0.0, touching = 0.0;
  std::array<Index, 4> deepest{};
  bool is_face = false;
  for (const SurfacePair& pair : pairs) {
    const auto& [i, j, k, l] = pair.points;
    const double thickness = std::min({plan.thickness[i], plan.thickness[j], plan.thickness[k], plan.thickness[l]}),
                 distance = closest_points(pair.kind, {place[i], place[j], place[k], place[l]}).distance - plan.radius_of(i);
    // bent sheets touch at a quarter of it
    if (distance >= thickness / 8.0) continue;
    if (distance < coincident) {
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
  return setting + (is_complete ? "" : "at least ") + std::to_string(count) + (count == 1 ? " pair starts" : " pairs start") +
         " closer than an eighth of the thickness, " +
         (is_face
              ? "point " + name_of(0) + " and the face of points " + name_of(1) + ", " + name_of(2) + " and " + name_of(3)
              : "the edge of points " + name_of(0) + " and " + name_of(1) + " and that of points " + name_of(2) + " and " + name_of(3)) +
         " most, by " + quantity_text(depth, "m", 2) + " of " + quantity_text(touching, "m", 2) +
         ": they separate slowly, which may stretch springs and so supply energy";
}

}  // namespace

std::vector<std::string> crossing_warnings(const System& system, const State& state) {
  std::vector<std::string> warnings;
  if (system.contact.faces && system.dimensions == 2)
    warnings.emplace_back("contact.faces: faces touch in scenes of 3 dimensions only: this one has 2");
  if (system.contact.restitution > 0.0 && !system.contact.points && (system.contact.faces || system.contact.springs))
    warnings.emplace_back("contact.restitution: points alone rebound from each other; faces and springs do not");
  const CrossedParts crossed = find_crossed_parts(system, state);
  for (const CrossedText& text : describe(crossed, system))
    warnings.push_back(std::string(text.setting) + ": " + text.count + text.detail + ": " + text.consequence);
  // what crosses is closer as well
  if (crossed.edges.empty() && crossed.springs.empty())
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
  const bool is_long = min < given * (1.0 - round_off);
  if (!is_long && max <= given * (1.0 + round_off)) return std::nullopt;
  return "contact.thickness: " + quantity_text(given, "m", 3) + (is_long ? " is more than half of" : " is less than a twentieth of") +
         " the smallest height of some faces, or length of springs: they touch at " + quantity_text(is_long ? min : max, "m", 3);
}

}  // namespace hooke
