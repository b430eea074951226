#include "sim/contact/clearance.h"

#include <algorithm>
#include <cmath>

#include "sim/contact/gap.h"

namespace hooke {
namespace {

// The minimum over the free points of distance(x, y, z) - radius. One loop without branches, for the compiler to vectorize.
template <class Distance>
double min_gap(const Plan& plan, const Field& field, const Distance& distance) {
  const auto n = static_cast<std::size_t>(plan.points);
  const double *x = field.data(), *y = x + n, *z = plan.dimensions == 3 ? y + n : nullptr;
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < n; ++i) {
    const double gap = distance(x[i], y[i], z != nullptr ? z[i] : 0.0) - plan.radius[i];
    min = plan.inverse_mass[i] != 0.0 && !(gap >= min) ? gap : min;
  }
  return min;
}

double min_gap(const Plan& plan, const Field& field, const Plane& plane) {
  const Vec3 &n = plane.normal, &p = plane.point;
  return min_gap(plan, field, [&](double x, double y, double z) { return n.x * (x - p.x) + n.y * (y - p.y) + n.z * (z - p.z); });
}

double min_gap(const Plan& plan, const Field& field, const Sphere& sphere) {
  const Vec3& center = sphere.center;
  return min_gap(plan, field, [&](double x, double y, double z) {
    const double u = x - center.x, v = y - center.y, w = z - center.z;
    return std::sqrt(u * u + v * v + w * w) - sphere.radius;
  });
}

// The distance along the axis on which the point is farthest out.
double min_gap(const Plan& plan, const Field& field, const Box& box) {
  const auto outside = [](double x, double min, double max) { return std::max(min - x, x - max); };
  return min_gap(plan, field, [&](double x, double y, double z) {
    return std::max({outside(x, box.min.x, box.max.x), outside(y, box.min.y, box.max.y), outside(z, box.min.z, box.max.z)});
  });
}

}  // namespace

double compute_clearance(const Plan& plan, const Field& x) {
  double clearance = std::numeric_limits<double>::infinity();
  for (const Collider& collider : plan.colliders)
    clearance = std::min(clearance, std::visit([&](const auto& shape) { return min_gap(plan, x, shape); }, collider.shape));
  if (plan.colliders.empty()) return clearance;

  // round-off, and the gap at which contact counts as such
  double extent = 0.0;
  for (const double component : x) extent = std::max(extent, std::abs(component));
  return clearance - contact_tolerance(Vec3(3.0 * extent));
}

}  // namespace hooke
