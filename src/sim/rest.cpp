#include "sim/rest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces.h"

namespace hooke {
namespace {

// Half the diagonal of a box around all points [m].
double size_of(const Plan& plan, const Field& x) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const auto [least, most] = std::minmax_element(x.begin() + c * plan.points, x.begin() + (c + 1) * plan.points);
    sum += (*most - *least) * (*most - *least);
  }
  return 0.5 * std::sqrt(sum);
}

void forces_where_free(const Plan& plan, const Field& x, const Field& v, Field& f) {
  compute_position_forces(plan, 0.0, x, v, f);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] == 0.0) f[static_cast<std::size_t>(c) * plan.points + i] = 0.0;
}

double farthest(const Field& s) {
  double most = 0.0;
  for (const double each : s) most = std::max(most, std::abs(each));
  return most;
}

}  // namespace

double come_to_rest(const Plan& plan, StiffnessMatrix& matrix, double small, int most_steps, Field& x, const std::atomic<bool>& stop) {
  const double reach = 0.1 * size_of(plan, x);  // of a step [m]
  const double pull = glm::length(plan.acceleration), longest = 1e6 / plan.spectrum.omega;
  double b = std::min(longest, pull > 0.0 && reach > 0.0 ? std::sqrt(reach / pull) : 10.0 / plan.spectrum.omega);

  Field f(x.size()), still(x.size(), 0.0);
  double left = INFINITY;
  for (int step = 0; !stop; ++step) {
    forces_where_free(plan, x, still, f);
    left = root_mean_square(plan, f);
    if (!(left > small) || step == most_steps) break;

    // far off the exact curvature is hardly ever positive
    constexpr double far = 1e5;
    const auto factorize = [&](Curvature curvature) {
      matrix.assemble(plan, b, x, still, curvature);
      return matrix.factorize();
    };
    if (!(left < far * small && factorize(Curvature::Exact)) && !factorize(Curvature::Clamped)) break;
    matrix.solve(f);
    const double share = std::min(1.0, reach / (b * b * farthest(f)));
    for (std::size_t at = 0; at < x.size(); ++at) x[at] += share * b * b * f[at];
    b = std::min(longest, share < 1.0 ? 0.5 * b : 2.0 * b);
  }
  return left;
}

}  // namespace hooke
