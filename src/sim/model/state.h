// Everything that changes from step to step: nothing survives a step outside this list.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

// What was supplied so far, which bounds the energy and the places that a motion can reach (divergence.h). [J]
struct EnergySupply {
  double net_input = 0.0;     // energy at the start, plus the work of the hand, of forces and of edits
  double scale = 0.0;         // sum of the magnitudes of these contributions
  double hand_stretch = 0.0;  // elastic energy if each spring were stretched by the hand's longest displacement in a step so far
  // Bounds on the motion supplied so far, used to bound how far it can lead: the maximum distance from the origin [m] and the maximum speed
  // [m/s] at the start, after edits and of the hand. None: not recorded.
  std::optional<double> extent{}, speed{};
  // Work of forces with a potential since the start, and its minimum and maximum [J]. It comes and goes, as on an orbit: the scale contains
  // its range and not the sum. None: 0.
  std::optional<double> reversible{}, min_reversible{}, max_reversible{};
  void add_reversible(double work);
  bool operator==(const EnergySupply&) const = default;
};

struct Integrator;

// What the method `auto` (control/frame_runner.h) chose for a frame, and what it needs to choose for the next one.
struct MethodChoice {
  const Integrator* method = nullptr;
  int substeps = 1;
  int min_substeps = 1;           // of the method, for stability and what must be resolved
  std::optional<double> error{};  // [m], of this frame, RMS over the free points; infinity: it diverged; none: not estimated
  double ratio = 0.0;             // [1], of the last estimate to the error aimed at
  int next_substeps = 1;          // of the next frame
  int until_estimate = 0;         // frames that need no estimate of their error
  int selected_substeps = 0;      // that the method needed when it was selected
  bool operator==(const MethodChoice&) const = default;
};

// Step size control of adaptive methods. Zero: not yet set.
struct MethodMemory {
  double step = 0.0;                     // [s], the next step
  double error = 0.0;                    // [1], of its last step, relative to the tolerance
  std::optional<MethodChoice> choice{};  // none: another method, or not yet made
  bool operator==(const MethodMemory&) const = default;
};

// A collider that the hand drags: its anchor moves to the target within the coming frame. Release writes its shape back to the System.
struct CarriedCollider {
  Index collider = no_index;
  ColliderShape shape;  // where the hand has moved it, without its own path
  Vec3 target{0.0};     // [m]
  bool operator==(const CarriedCollider&) const = default;
};

// The hand of the user.
struct Hand {
  Vec3 position{0.0};  // [m], now; meaningful while the System has a grab
  Vec3 target{0.0};    // [m], of the grabbed point at the end of the coming frame
  std::optional<CarriedCollider> collider;
  bool operator==(const Hand&) const = default;
};

struct State {
  double time = 0.0;           // [s]
  std::vector<Vec3> position;  // [m], one per point, in the order of the System
  std::vector<Vec3> velocity;  // [m/s]
  Hand hand;
  EnergySupply supply;
  MethodMemory memory;
  std::uint32_t torn = 0;  // index of the latest tear; 0 means intact
  bool operator==(const State&) const = default;
};

// A collider with the shape as moved by the hand, without its path; and with its path at the time of the State.
Collider carried_collider(const System& system, const State& state, std::size_t collider);
Collider current_collider(const System& system, const State& state, std::size_t collider);
// All colliders with the carried one where the hand has it.
std::vector<Collider> carried_colliders(const System& system, const State& state);

}  // namespace hooke
