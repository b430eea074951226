// How the motion of a scene depends on its springs, its masses and its start: the exact derivatives of the steps themselves (the discrete
// adjoint), for all parameters at once.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "sim/model/settings.h"
#include "sim/model/state.h"

namespace hooke {

// What the derivatives are of: the sum of weight times component over the positions, and the velocities, of all points in these samples.
struct SampleWeights {
  std::vector<long> frames;                  // of each sample, ascending: 0 is the start
  std::span<const Vec3> position, velocity;  // samples x points, or empty
};

// Derivatives of that sum by the properties of each spring and point, where the switches of the scene let them act: zero otherwise.
struct Gradient {
  std::vector<double> stiffness, rest_length, damping;  // per [N/m], [m], [N s/m]
  std::vector<double> mass;                             // per [kg]; zero for nails
  std::vector<Vec3> position, velocity;                 // of the start, per [m], [m/s]
  std::uint64_t hash = 0;                               // of the last state of the run
};

// The gradient of a run of `frames` frames from `start`. The run is computed twice, and once backwards; the start of every frame and every
// substep of one frame are kept. `progress` is called with (done, all) frames. Throws InputError "contact: ..." if anything but springs,
// dashpots, gravity, loads, drag and nails acts, or with another method than velocity_verlet and runge_kutta4.
Gradient compute_gradient(const System& system, const Settings& settings, const State& start, long frames, const SampleWeights& weights,
                          const std::function<void(long, long)>& progress);

}  // namespace hooke
