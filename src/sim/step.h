// One frame of a scene, substep by substep.
#pragma once

#include "sim/contact.h"
#include "sim/integrator.h"
#include "sim/settings.h"
#include "sim/state.h"

namespace hooke {

// A frame in progress. Reused from frame to frame, so that stepping does not allocate:
//   frame.begin(plan, system, settings, state); while (!frame.done()) frame.substep(plan); frame.end(plan, state);
// Between begin and end the plan must stay as it is, and the State is not touched.
class Frame {
 public:
  // Aims the hand, packs the state. The plan must be current.
  void begin(Plan& plan, const System& system, const Settings& settings, const State& state);
  void substep(const Plan& plan);
  bool done() const { return substeps_done_ >= substeps_; }
  int substeps_done() const { return substeps_done_; }
  // Writes time, positions, velocities and the hand. The caller judges them (divergence.h) before showing them.
  void end(const Plan& plan, State& state) const;

  long force_evaluations() const { return motion_.force_evaluations; }
  long factorizations() const { return motion_.factorizations; }
  // All counts of work, and the method's own estimate of its error.
  const Motion& motion() const { return motion_; }

 private:
  const Integrator* integrator_ = nullptr;
  double start_ = 0.0, duration_ = 0.0, h_ = 0.0;  // [s]
  int substeps_ = 0, substeps_done_ = 0;
  Vec3 target_{0.0};
  Motion motion_;
  Workspace work_;
  ContactWorkspace before_;
};

// Adds the work of the listed forces (force_term.h) between two frames to the ledger of the later one.
void book_forces_work(const Plan& plan, const State& before, State& after);

// Adds the hand's work between two frames to the ledger of the later one.
void book_hand_work(const System& system, const State& before, State& after);

}  // namespace hooke
