#include "scene/overlap_warning.h"

#include <algorithm>

#include "base/number_text.h"
#include "scene/crossed_parts.h"
#include "sim/contact/surface/surface_plan.h"

namespace hooke {

std::vector<std::string> crossing_warnings(const System& system, const State& state) {
  std::vector<std::string> warnings;
  if (system.contact.faces && system.dimensions == 2)
    warnings.push_back("contact.faces: faces touch in scenes of 3 dimensions only: this one has 2");
  for (const CrossedText& text : describe(find_crossed_parts(system, state), system))
    warnings.push_back(std::string(text.setting) + ": " + text.count + text.detail + ": " + text.consequence);
  return warnings;
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
