// The scenes of the hard cases on contact between points, springs and faces. The cases judge runs of them; tests count what passes through
// in the same runs.
#pragma once

#include <limits>
#include <vector>

#include "sim/model/settings.h"
#include "study/hard_cases/test_network.h"

namespace hooke {

struct ContactScene {
  TestNetwork network;
  double seconds = 1.0;  // [s], of the case
  int min_substeps = 1;
  // Nails that are removed at this time [s].
  std::vector<PointId> released;
  double release_time = std::numeric_limits<double>::infinity();
};

// A cloth of 1 m in eight layers, folded in halves three times, is dropped on a floor, where it opens.
ContactScene make_folded_cloth();
// Two cloths, one across the other, fly at each other at 20 m/s.
ContactScene make_crossing_cloths();
// A tube of cloth between two rings of nails, twisted by four turns; after half a second the lower ring is released.
ContactScene make_twisted_tube();
// A cloth hangs as a sleeve; a hand pulls one of its lower corners through it at 10 m/s.
ContactScene make_pulled_sleeve();
// 20 ropes fall crosswise into a bin.
ContactScene make_rope_heap();
// Substeps within the limits of the method on the scene, that of contact included.
Settings settings_for(const Integrator& method, const ContactScene& scene);

}  // namespace hooke
