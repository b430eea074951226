// The problems on which engines are compared.
#pragma once

#include <vector>

#include "study/problem.h"

namespace hooke {

// Drum, drum with dashpots, rope and cloths: error against CPU time.
std::vector<Problem> peer_problems();

// A cloth of n x n points, 1 m, 0.2 kg, nailed at two corners; or one that falls on a ball and a floor.
Problem peer_cloth(int n, double seconds);
Problem cloth_on_ball_and_floor(int n, double seconds);
// A hanging cloth of n x n points, slightly wavy, that is dropped on its lower edge and falls into its own folds.
Problem cloth_in_folds(int n, double seconds);

// The same with a dashpot in each spring [N s/m].
Problem with_dashpots(Problem problem, double damping);

}  // namespace hooke
