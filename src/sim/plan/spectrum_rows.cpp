#include "sim/plan/spectrum_rows.h"

#include <cmath>
#include <utility>

namespace hooke {

SpectrumRows spectrum_rows(const System& system) {
  SpectrumRows rows{std::vector<double>(system.points().size(), 0.0), std::vector<double>(system.points().size(), 0.0)};
  double product = 1.0, inverse_root = 1.0;  // of the masses; those of most springs are the same as of the one before
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Point &first = system.points()[i], &second = system.points()[j];
    if (const double masses = first.mass * second.mass; masses != product) {
      product = masses;
      inverse_root = 1.0 / std::sqrt(masses);
    }
    const double coupling = first.nailed || second.nailed ? 0.0 : inverse_root;
    const double stiffness = system.stiffness_bound_of(spring), damping = system.damping_of(spring);
    for (const auto& [at, point] : {std::pair{i, &first}, std::pair{j, &second}}) {
      if (point->nailed) continue;
      const double weight = 1.0 / point->mass + coupling;
      rows.stiffness[at] += stiffness * weight;
      rows.dashpot[at] += damping * weight;
    }
  }
  return rows;
}

}  // namespace hooke
