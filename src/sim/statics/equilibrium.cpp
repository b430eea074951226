#include "sim/statics/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/forces.h"
#include "sim/statics/constants.h"

namespace hooke {
namespace {

// Half the diagonal of a box around all points [m].
double half_diagonal(const Plan& plan, const Field& x) {
  double sum = 0.0;
  for (int c = 0; c < plan.dimensions; ++c) {
    const auto [min, max] = std::minmax_element(x.begin() + c * plan.points, x.begin() + (c + 1) * plan.points);
    sum += (*max - *min) * (*max - *min);
  }
  return 0.5 * std::sqrt(sum);
}

void compute_free_forces(const Plan& plan, const Field& x, const Field& v, Field& f) {
  compute_position_forces(plan, 0.0, x, v, f);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] == 0.0) f[static_cast<std::size_t>(c) * plan.points + i] = 0.0;
}

double max_abs(const Field& s) {
  double max = 0.0;
  for (const double each : s) max = std::max(max, std::abs(each));
  return max;
}

}  // namespace

double find_equilibrium(const Plan& plan, StiffnessMatrix& matrix, double tolerance, int max_steps, Field& x,
                        const std::atomic<bool>& stop) {
  const double max_displacement = 0.1 * half_diagonal(plan, x);  // of a step [m]
  const double gravity_magnitude = glm::length(plan.acceleration), max_b = 1e6 / plan.spectrum.omega;
  double b = std::min(max_b, gravity_magnitude > 0.0 && max_displacement > 0.0 ? std::sqrt(max_displacement / gravity_magnitude)
                                                                               : 10.0 / plan.spectrum.omega);

  Field f(x.size()), zero_velocity(x.size(), 0.0);
  double residual = INFINITY;
  for (int step = 0; !stop; ++step) {
    compute_free_forces(plan, x, zero_velocity, f);
    residual = root_mean_square(plan, f);
    if (!(residual > tolerance) || step == max_steps) break;

    // far from equilibrium the exact matrix is hardly ever positive definite
    const auto factorize = [&](Curvature curvature) {
      matrix.assemble(plan, b, x, zero_velocity, curvature);
      return matrix.factorize();
    };
    if (!(residual < max_exact_residual * tolerance && factorize(Curvature::Exact)) && !factorize(Curvature::Clamped)) break;
    matrix.solve(f);
    clear_fixed_axes(plan, f.data());
    const double scale = std::min(1.0, max_displacement / (b * b * max_abs(f)));
    for (std::size_t at = 0; at < x.size(); ++at) x[at] += scale * b * b * f[at];
    b = std::min(max_b, scale < 1.0 ? 0.5 * b : 2.0 * b);
  }
  return residual;
}

}  // namespace hooke
