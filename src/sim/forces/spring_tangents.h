// The tangent stiffness of each spring in the axial and transverse directions.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "sim/forces/spring_laws.h"

namespace hooke {

// Clamped: transverse stiffnesses are at least 0 (methods/implicit/stiffness.h).
enum class Curvature { Exact, Clamped };

// K = axial u u^T + transverse (I - u u^T), D = damping u u^T, u the unit vector along the spring.
struct SpringTangent {
  Vec3 u{0.0};
  double axial = 0.0, transverse = 0.0;  // [N/m]
  double damping = 0.0;                  // [N s/m]
};

// For every spring with a free end: use(first, second, packed index, tangent at x and this time), with dashpots at the velocities v unless
// it is null. `use` may treat both ends as free if its contribution to an end that is not free is ignored.
template <class Use>
void for_each_spring_tangent(const Plan& plan, double time, const Field& x, const Field* v, Curvature curvature, const Use& use) {
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    if (plan.inverse_mass[i] == 0.0 && plan.inverse_mass[j] == 0.0) return;
    SpringTangent tangent{.u = difference_at(plan, x, j, i)};
    const double length = glm::length(tangent.u);
    const auto [of, damping] = response_of(plan, s, time, length);
    tangent.axial = tangent.transverse = of.stiffness;
    if (length > 0.0) {
      tangent.u /= length;
      tangent.damping = damping;
      const double speed = v != nullptr ? glm::dot(tangent.u, difference_at(plan, *v, j, i)) : 0.0;
      tangent.transverse = (of.tension + damping * speed) / length;
      if (curvature == Curvature::Clamped) tangent.transverse = std::max(0.0, tangent.transverse);
    }
    use(i, j, s, tangent);
  });
}

}  // namespace hooke
