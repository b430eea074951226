// One frame of a scene, substep by substep.
#pragma once

#include <span>

#include "sim/contact/contact.h"
#include "sim/integrator.h"
#include "sim/settings.h"
#include "sim/state.h"

namespace hooke {

// A frame in progress. Reused from frame to frame, so that stepping does not allocate:
//   frame.begin(plan, system, settings, state); while (!frame.done()) frame.substep(plan); frame.end(plan, state);
// Between begin and end the plan must stay as it is but for what the frame does to it: a spring that breaks loses its k and d
// there, until the plan is made anew or refreshed. The State is not touched.
class Frame {
 public:
  // Aims the hand, packs the state. The plan must be current.
  void begin(Plan& plan, const System& system, const Settings& settings, const State& state);
  void substep(Plan& plan);
  bool done() const { return substeps_done_ >= substeps_; }
  int substeps_done() const { return substeps_done_; }
  // Writes time, positions, velocities, the hand with the collider it carries, and into the ledger its work and that of what is no force.
  // The caller judges them (divergence.h) before showing them.
  void end(const Plan& plan, State& state) const;

  // Springs of the System that broke, in ascending order: they are to be removed.
  std::span<const Index> broken() const { return broken_; }

  long force_evaluations() const { return motion_.force_evaluations; }
  long factorizations() const { return motion_.factorizations; }
  // All counts of work, and the method's own estimate of its error.
  const Motion& motion() const { return motion_; }

 private:
  const Integrator* integrator_ = nullptr;
  double start_ = 0.0, duration_ = 0.0, h_ = 0.0;  // [s]
  int substeps_ = 0, substeps_done_ = 0;
  Vec3 target_{0.0};
  double hand_stretch_ = 0.0;  // [J], of this frame (EnergyLedger)
  Motion motion_;
  Workspace work_;
  ContactWorkspace before_;
  std::vector<Index> broken_;
  Vec3 collider_displacement_{0.0};  // [m], of the carried collider in this frame
};

// Adds the work of the listed forces (force_term.h) between two frames to the ledger of the later one.
void record_force_work(const Plan& plan, const State& before, State& after);

}  // namespace hooke
