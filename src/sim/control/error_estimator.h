// The error of a frame, from two runs of it, the second with more substeps than the first, usually twice as many. The second is kept.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/methods/integrator.h"
#include "sim/model/state.h"
#include "sim/model/system.h"
#include "sim/step/step.h"

namespace hooke {

// Where a frame ended that was computed with one number of substeps.
struct FrameEnd {
  std::vector<Vec3> position, velocity;  // [m], [m/s]
  std::vector<Index> broken;             // springs, indices in the System
  bool has_touched = false;              // something touched, or a spring went slack or taut
  bool has_impact = false;
  bool has_flipped = false;  // the ends of a spring passed each other within a substep
  bool is_finite = false;    // no step failed, and every coordinate is a number
};

// Sets where the frame ended that followed `start`. `scratch`: memory that is used again.
void set_end(FrameEnd& end, const Frame& frame, const Plan& plan, const State& start, State& scratch);

// The order with which the error of such a frame falls: that of the method on this scene, but 1 where something touched or broke.
int order_of(const System& system, const Integrator& method, const FrameEnd& end);

// The substeps of the first of two runs whose second one takes so many.
int first_substeps(int substeps);

// The last two runs of one frame.
class FrameRuns {
 public:
  // For a scene whose fastest vibration has this frequency [rad/s]; 0: nothing vibrates.
  void restart(double frequency) { count_ = 0, frequency_ = frequency; }
  // Where the end of the next run goes.
  FrameEnd& add();
  int count() const { return count_; }
  const FrameEnd& finest() const { return ends_[0]; }
  FrameEnd& finest() { return ends_[0]; }
  // In one of them: whether something touched or broke; or a spring flipped, too; and whether a velocity or a force jumped, because
  // something struck, broke or flipped.
  bool have_contacts() const;
  bool have_events() const;
  bool have_jumps() const;
  // RMS error [m] of the finest over the free points:
  //   d(n) / (q - 1),  d(n)^2 = |x(n) - x(n/2)|^2 + |v(n) - v(n/2)|^2 / frequency^2     (Richardson)
  // Positions alone may agree by chance while a vibration is out of phase.
  // q is 2^p, but at most max_assumed_reduction. Infinity if a run failed, or if springs broke in only one of them.
  double error(const System& system, const Integrator& method) const;
  // The distance of the velocities [m/s].
  double velocity_error(const System& system) const;

 private:
  std::span<const FrameEnd> all() const { return std::span(ends_).first(count_ > 1 ? 2 : 1); }

  std::array<FrameEnd, 2> ends_;  // the finest first
  int count_ = 0;
  double frequency_ = 0.0;  // [rad/s]
};

// Whether nothing can make the error of the coming frame much larger than that of the last one: nothing touches, breaks or is held, and no
// spring turns or changes its length by more than control::max_turn within `duration` [s]. Then also none passes through zero length.
bool is_calm(const Plan& plan, const State& state, double duration);

// Whether a spring may break in the coming frame: its own energy, that of its ends relative to each other included, could stretch it to
// half of its limit.
bool may_break(const Plan& plan, const State& state);

}  // namespace hooke
