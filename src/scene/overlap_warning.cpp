#include "scene/overlap_warning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "scene/crossed_parts.h"
#include "sim/contact/surface/surface_plan.h"

namespace hooke {

std::vector<std::string> crossing_warnings(const System& system, const State& state) {
  std::vector<std::string> warnings;
  if (system.contact.faces && system.dimensions == 2)
    warnings.emplace_back("contact.faces: faces touch in scenes of 3 dimensions only: this one has 2");
  for (const CrossedText& text : describe(find_crossed_parts(system, state), system))
    warnings.push_back(std::string(text.setting) + ": " + text.count + text.detail + ": " + text.consequence);
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
