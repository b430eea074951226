#include "scene/new_point.h"

#include <algorithm>
#include <vector>

namespace hooke {
namespace {

NewPoint chosen(const Defaults& defaults, const NewPoint& like) {
  return {.mass = defaults.mass > 0.0 ? defaults.mass : like.mass, .radius = defaults.radius > 0.0 ? defaults.radius : like.radius};
}

std::vector<char> held_points(const System& system) {
  std::vector<char> held(system.points().size(), 0);
  const auto hold = [&](PointId id) {
    if (const Index i = system.index_of(id); i != no_index) held[static_cast<std::size_t>(i)] = 1;
  };
  for (const Spring& spring : system.springs()) hold(spring.first), hold(spring.second);
  for (const Face& face : system.faces)
    for (const PointId corner : face.points) hold(corner);
  return held;
}

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

NewPoint new_point_like(const Defaults& defaults, const System& system) {
  if ((defaults.mass > 0.0 && defaults.radius > 0.0) || system.points().empty()) return chosen(defaults, {});
  const std::vector<char> held = held_points(system);
  const bool has_loose = std::ranges::find(held, 0) != held.end();
  std::vector<double> masses, radii;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (has_loose && held[i] != 0) continue;
    const Point& point = system.points()[static_cast<Index>(i)];
    masses.push_back(point.mass);
    radii.push_back(point.radius);
  }
  return chosen(defaults, {.mass = median_of(masses), .radius = median_of(radii)});
}

NewPoint new_point_like(const Defaults& defaults, const Point& neighbor) {
  return chosen(defaults, {.mass = neighbor.mass, .radius = neighbor.radius});
}

}  // namespace hooke
