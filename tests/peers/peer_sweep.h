// Sweeps the settings of an engine on a problem: the same sweep for every engine and every method of Hooke.
#pragma once

#include <string>

#include "peers/peer.h"
#include "study/work_precision.h"

namespace hooke {

struct PeerSweep {
  std::string id;                  // of the rows
  double first_step = 0.0;         // [s], of the first setting, which must be about the largest stable one; 0: there is none
  std::vector<int> iterations{1};  // of each setting
};

// Adds the rows of the engine to the record: from the coarsest stable setting to the finest that still reduces the error within the effort.
// Of several numbers of iterations only the rows that no other row of the engine beats in both error and cost.
void sweep_peer(const PeerSweep& sweep, Peer& peer, const Problem& problem, const Reference& reference, const Effort& effort,
                ProblemRecord& record);

// CPU time of a step per spring in the row with the cheapest steps [s]; 0: no row.
double step_seconds_per_spring(const ProblemRecord& record, const std::string& id);

}  // namespace hooke
