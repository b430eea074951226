// The sweeps of dashpot.h over all springs. Large nets are swept from the middle to both sides and back, on two threads if there are any;
// to the same bits for any number of them.
#pragma once

#include <array>
#include <vector>

#include "sim/forces/dashpots/dashpot.h"

namespace hooke {

// Sweeps over the same duration. Only `prepare` allocates.
class DashpotSweeps {
 public:
  // As plan_dashpot_decay.
  void prepare(const Plan& plan, double duration);
  // As decay_dashpots with all runs, and springs with a law, of which those act that do at this time.
  void sweep(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v);

  // Whether sweeps are measured, over fields of this size.
  void measure(bool is_measured, std::size_t size);
  // Of the sweeps since then, if they are measured: whether there were any; by what they changed each component of the velocities [m/s],
  // and the kinetic energy in it [J].
  void begin_step();
  bool has_swept() const { return has_swept_; }
  const Field& change() const { return change_; }
  const Field& work() const { return work_; }

 private:
  void apply(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v);
  void divide_springs(const Plan& plan);
  void clear_halves();
  void sweep_halves(const Plan& plan, SweepDirection sweep, const Field& x, Field& v) const;

  double duration_ = 0.0;      // [s]
  std::vector<double> decay_;  // of the packed springs
  // Of a large net: springs between the points of the first half, between those of the second one, and from one to the other; empty: it is
  // swept as one.
  std::array<std::vector<SpringRun>, 2> halves_;
  std::vector<SpringRun> middle_;
  std::vector<SpringRun> known_runs_;  // those of which these are the halves
  bool is_measured_ = false, has_swept_ = false;
  Field before_, change_;  // [m/s], before a sweep, and by all of them
  Field work_;             // [J]
};

}  // namespace hooke
