// Nets, curtains and chains given by formulas: benchmark scenes that start in motion or in equilibrium, which the generators of scene files
// cannot express.
#pragma once

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// An initial state, without the settings and views of a document.
struct InitialState {
  System system;
  State state;
};

// n x n points of equal mass on 1 m x 1 m, vertical, 1 kg, the top row nailed; springs right and down, all of stiffness k [N/m] and damping
// d [N s/m]. Starts in hanging equilibrium, row r below row r-1 by 1/(n-1) + (n-r) m g / k, with the velocity v_z = s (1 + cos(pi u)) / 4
// [m/s], s below the top row and u from the left [m] of the undeformed net. It swings under tension, which is smooth and predictable
// motion.
InitialState make_net(int n, double k, double d);

// The same sheet with both diagonals (k and d too), started undeformed with v_z = s (1 + cos(pi u)) / 2: it falls and
// buckles.
InitialState make_curtain(int n, double k, double d);

// 1 m of links hanging from a nail, each of 1 g except the last, which is `mass_ratio` times as heavy; its weight stretches every link by 5
// %. Starts in hanging equilibrium and rotates as a whole at 1 rad/s.
InitialState make_chain(int links, double mass_ratio);

}  // namespace hooke
