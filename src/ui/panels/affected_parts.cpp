#include "ui/panels/affected_parts.h"

#include <cmath>

namespace hooke {
namespace {

AffectedParts compute(const System& system, const DocumentStatus& document, const Selection& selection) {
  AffectedParts parts;
  for (const PointId id : selection.points)
    if (const Index i = system.index_of(id); i != no_index) parts.points.push_back(i);
  if (selection.has_parts())
    for (const SpringId id : affected_springs(system, selection))
      if (const Index s = system.index_of(id); s != no_index) parts.springs.push_back(s);

  const auto of_points = [&](auto Point::*member) { return common(parts.points, [&](Index i) { return system.points()[i].*member; }); };
  const auto of_springs = [&](auto Spring::*member) { return common(parts.springs, [&](Index s) { return system.springs()[s].*member; }); };
  parts.nailed = of_points(&Point::nailed);
  parts.color = of_points(&Point::color);
  parts.mass = of_points(&Point::mass);
  parts.radius = of_points(&Point::radius);
  parts.stiffness = of_springs(&Spring::stiffness);
  parts.damping = of_springs(&Spring::damping);
  parts.rest_length = of_springs(&Spring::rest_length);
  parts.break_strain = of_springs(&Spring::break_strain);

  parts.slider_springs.all = parts.springs.empty();
  for (const Index s : parts.springs) parts.slider_springs.selected.push_back(system.springs()[s].id);
  const auto rows = parameters();
  parts.slider_values.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (!std::isnan(document.parameter_values[i]))
      parts.slider_values[i] = values_of(rows[i], system, document.sheet.get(), parts.slider_springs);
  return parts;
}

}  // namespace

const AffectedParts& AffectedPartsCache::of(const Status& status, const Selection& selection) {
  const std::shared_ptr<const System>& system = status.snapshot->system;
  if (system_ == system && document_ == status.document && selection_ == selection) return parts_;
  parts_ = compute(*system, *status.document, selection);
  system_ = system;
  document_ = status.document;
  selection_ = selection;
  ++computations_;
  return parts_;
}

}  // namespace hooke
