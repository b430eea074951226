// Measures how wrong a run is while it runs, without affecting it: the error of a frame by repeating one now and then, the accumulated
// error and the growth of small differences by second runs, and the energy balance from the work that frames report. The values
// follow from the run alone: they do not depend on when the work for them is done.
#pragma once

#include <vector>

#include "lab/accuracy/frame_repetition.h"
#include "lab/accuracy/second_runs.h"
#include "lab/controls.h"
#include "sim/forces/motion.h"
#include "sim/model/accuracy.h"

namespace hooke {

// What has happened in a run since its start.
struct RunEvents {
  bool is_unresolved = false;  // springs passed through zero length faster than the steps resolve
  bool is_aliased = false;     // colliders or muscles oscillated faster than the steps resolve
  bool has_broken = false;     // a spring did
  bool is_smooth = true;       // without contact, springs that break, a strain limit and a hand
  double max_kinetic = 0.0;    // [J]
  double supplied = 0.0;       // [J]
};

// Keeps the energy balance of a run, frame by frame.
class EnergyAccounts {
 public:
  // Starts at this state with its energy [J].
  void start(const State& state, double energy) {
    balance_ = {.since = state.time};
    start_ = energy;
    net_input_ = state.supply.net_input;
  }
  // The frame that led from `before` to `after`, whose energy is `energy` [J].
  void add_frame(const Plan& plan, const State& before, const State& after, const Motion& motion, double energy) {
    // what was supplied before the frame contains the edits since the last one
    balance_.ledger.add(EnergyCause::Edits, before.supply.net_input - net_input_);
    balance_.ledger += explained(motion.energy, plan.hand.held || plan.collider_paths.any_moves);
    balance_.change = energy - start_;
    net_input_ = after.supply.net_input;
  }

  const EnergyBalance& balance() const { return balance_; }

 private:
  EnergyBalance balance_;
  double start_ = 0.0;      // [J]
  double net_input_ = 0.0;  // [J], supplied up to the end of the last frame
};

class AccuracyMeter {
 public:
  AccuracyMode mode() const { return mode_; }
  void set_mode(AccuracyMode mode);

  // Starts again with the next frame: the state was replaced, or points were added, removed or moved.
  void restart();
  // Anything else that affects the motion was edited, besides the position of the hand.
  void note_edit();

  // A finished frame of the run: the plan and the System it was computed with, the states before and after it and their energies [J].
  // Springs that broke in it are whole in both, and missing in the energy after it. Before they are removed, which is an edit, the work for
  // this frame has to be done; otherwise the second runs start again.
  void add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                 const Motion& motion, double energy_before, double energy);

  // Whether a frame is being repeated; then `repeat` computes a substep of it.
  bool is_repeating() const { return mode_ != AccuracyMode::Off && repetition_.is_in_progress(); }
  void repeat(const System& system);
  // Whether that frame is the first one, one in which something began to touch, or the first after an edit: what was known before says
  // nothing of it.
  bool is_urgent() const { return is_urgent_; }
  // The same for the second runs, which may be late.
  bool has_work() const { return mode_ == AccuracyMode::Full && second_runs_.has_work(); }
  void work(const System& system) { second_runs_.substep(system); }

  // What is known now.
  Accuracy accuracy(const Settings& settings) const;

 private:
  void measure_frame(Accuracy& accuracy) const;
  void measure_run(Accuracy& accuracy) const;
  void measure_half_error(const Settings& settings, Accuracy& accuracy) const;
  bool is_damped_by_method() const;

  AccuracyMode mode_ = AccuracyMode::Off;
  RunEvents past_;
  bool is_started_ = false;
  bool is_edited_ = false, was_touching_ = false;  // since the last repeated frame; in the last frame
  bool is_urgent_ = false;                         // of the frame that is repeated
  double size_ = 1.0;                              // [m]
  int order_ = 1;                                  // of the method on this scene
  // Whether something may touch there, or a strain limit act: then the order is measured, or unknown for a method that adapts its step.
  bool touches_ = false, ignores_tolerance_ = false;
  bool collapses_ = false;  // whether springs of the repeated frame could pass through zero length, where nothing touches
  // [m], sums over repeated frames, older ones with less weight
  std::optional<FrameRefinement> refinement_;
  int repetitions_ = 0;  // since the order was determined
  const Integrator* method_ = nullptr;
  int frames_since_repetition_ = 0;
  std::vector<Vec3> start_;  // positions [m], in full mode
  double motion_ = 0.0;      // [m], maximum RMS distance from there
  EnergyAccounts energy_;
  FrameRepetition repetition_;
  SecondRuns second_runs_;
};

}  // namespace hooke
