// A point that touches a plane stays there until the sum of the other forces pulls it off with more than s [N].
#include <glm/geometric.hpp>

#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {{"strength", "Stickiness", "N", 0.0, 1000.0, 1.0}};

// [m], the distance within which a point counts as touching: contact places resting points on the surface to round-off
constexpr double contact_tolerance = 1e-9;

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, double* f) {
  const std::size_t n = plan.points;
  for (std::size_t k = 0; k < plan.colliders.size(); ++k) {
    const auto* plane = std::get_if<Plane>(&plan.colliders[k].shape);
    if (plane == nullptr) continue;
    const double height = glm::dot(plane->normal, plane->point + plan.offset_of(k, time));
    for (std::size_t i = 0; i < n; ++i) {
      double distance = -height - plan.radius[i], pull = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        distance += plane->normal[c] * x[c * n + i];
        pull += plane->normal[c] * f[c * n + i];
      }
      if (distance > contact_tolerance || pull <= 0.0 || pull > values[0]) continue;
      for (int c = 0; c < plan.dimensions; ++c) f[c * n + i] -= pull * plane->normal[c];
    }
  }
}

// The force projects the derivative of the other forces, whose eigenvalues do not grow by that; it has no derivative of its own and does no
// work.
ForceBound bound(const System&, const Plan&, const ForceValues&, double) { return {}; }

}  // namespace

constinit const ForceTerm sticky_force{
    .id = "sticky",
    .label = "Sticky walls",
    .description = "Holds a point on a plane that it touches until a larger force pulls it off.",
    .numbers = numbers,
    .depends_on_velocity = false,
    .is_continuous = false,
    .add = add,
    .bound = bound,
    .add_tangent = nullptr,
    .potential = nullptr,
    .power = nullptr,
};

}  // namespace hooke
