// Energy and momentum of a state, for display, divergence checks and tests.
#pragma once

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

// [J]. Gravitational energy is zero at the origin; the spring of a pulling hand counts as elastic.
struct Energy {
  double kinetic = 0.0, elastic = 0.0, gravitational = 0.0;
  double total() const { return kinetic + elastic + gravitational; }
};

struct Momentum {
  Vec3 linear{0.0};   // [kg m/s]
  Vec3 angular{0.0};  // [kg m^2/s], about the origin
};

// Nailed points have no kinetic energy or momentum.
Energy compute_energy(const System& system, const State& state);
double kinetic_energy(const System& system, const State& state);                        // [J]
double elastic_energy(const System& system, const State& state, const Spring& spring);  // [J]
// What the law of a spring gives at its present length, and whether it acts there.
SpringResponse response_at(const System& system, const State& state, const Spring& spring);
// [N], without the dashpot; negative: compression.
double tension(const System& system, const State& state, const Spring& spring);
Momentum compute_momentum(const System& system, const State& state);

// l / l0 - 1 of a spring [1]; for l0 = 0 the length [m] itself.
double strain(const System& system, const State& state, const Spring& spring);

// Whether the motion can compress a spring to zero length, where its direction reverses: the amplitude that its extension and the relative
// velocity of its ends correspond to, with the frequency of the spring alone, is at least its rest length.
bool can_collapse(const System& system, const State& state);

// Position of the grabbed point, or patch [m]. There must be a grab.
Vec3 grabbed_position(const System& system, const State& state);

// (M g + F) L [J]: mass of the free points times gravity, and their loads, times the size of the scene: the minimum of the supplied energy.
// A scene without extent, such as a single point, counts as 1 m.
double reference_energy(const System& system, const State& state);

}  // namespace hooke
