// A bound on what drag and dashpots dissipate in a frame, so that a loss by the method is not taken for theirs.
#pragma once

#include <vector>

#include "sim/forces/motion.h"
#include "sim/model/system.h"

namespace hooke {

// Parts of the scene that no spring connects, except through nails, exchange no energy as long as nothing touches and nothing but springs
// and gravity acts: each dissipates at most what it loses, and only at the rate of its own dashpots. So the dashpots of a part at rest do
// not explain the loss of another one. In all other frames, and in a scene of one part, the bound is that for the fastest dashpot of the
// scene.
class DissipationBound {
 public:
  // The state in which a frame starts.
  void begin_frame(const System& system, const State& state);
  // [J], in the frame that led from there to `state`. `plan`: of `system` after the frame, with or without the springs that broke in it.
  double end_frame(const Plan& plan, const System& system, const State& state, const Motion& motion);

 private:
  struct Part {
    double rate = 0.0;                   // [1/s], bound on that of its dashpots
    double kinetic = 0.0, energy = 0.0;  // [J]; the latter with elastic and gravitational energy
  };
  bool is_divided(const System& system);
  void divide(const System& system);
  double until_break(const std::vector<BrokenSpring>& breaks) const;
  void measure(const System& system, const State& state, std::vector<Part>& parts) const;

  std::vector<Index> part_of_;  // per point; empty: one part
  Index points_ = -1, springs_ = -1;
  SpringId last_{};  // with the counts: those of which part_of_ is
  std::vector<Part> before_, after_;
  double start_ = 0.0, kinetic_ = 0.0;  // [s], [J], of the whole
  std::vector<double> power_;           // [W], of the dashpots at the start; empty: no spring breaks
};

}  // namespace hooke
