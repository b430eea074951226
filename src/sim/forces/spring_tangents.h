// The tangent stiffness of each spring in the axial and transverse directions.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/forces/spring_laws.h"

namespace hooke {

// K = axial u u^T + transverse (I - u u^T), u the unit vector along the spring; clamped, as in stiffness.h.
struct SpringTangent {
  double u[3] = {};
  double axial = 0.0, transverse = 0.0;  // [N/m]
};

// For every spring with a free end: use(first, second, packed index, tangent at x and this time). `use` may treat both ends as free if its
// contribution to an end that is not free is ignored.
template <class Use>
void for_each_spring_tangent(const Plan& plan, double time, const Field& x, const Use& use) {
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) {
      const Index i = run.first + e, j = run.second + e, s = run.begin + e;
      if (plan.inverse_mass[i] == 0.0 && plan.inverse_mass[j] == 0.0) continue;
      SpringTangent tangent;
      double square = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        const std::size_t start = static_cast<std::size_t>(c) * plan.points;
        tangent.u[c] = x[start + i] - x[start + j];
        square += tangent.u[c] * tangent.u[c];
      }
      const double length = std::sqrt(square);
      const SpringResponse of = response_of(plan, s, time, length).of;
      for (double& component : tangent.u) component = length > 0.0 ? component / length : 0.0;
      tangent.axial = of.stiffness;
      tangent.transverse = length > 0.0 ? std::max(0.0, of.tension / length) : of.stiffness;
      use(i, j, s, tangent);
    }
}

}  // namespace hooke
