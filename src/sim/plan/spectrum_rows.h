// Row sums of the matrices of a scene, which bound their eigenvalues.
#pragma once

#include <vector>

#include "sim/model/system.h"

namespace hooke {

// Per point: the sum over its row of the norms of the 3x3 blocks of M^-1/2 K M^-1/2, K of the springs [1/s^2], and likewise of their
// dashpots [1/s]. No eigenvalue of either matrix exceeds its largest row (Gershgorin).
struct SpectrumRows {
  std::vector<double> stiffness, dashpot;
};

SpectrumRows spectrum_rows(const System& system);

}  // namespace hooke
