// The sweeps of dashpot.h over all springs, those with a law included, and what they change.
#pragma once

#include <vector>

#include "sim/forces/dashpots/dashpot.h"

namespace hooke {

// Sweeps over the same duration. Only `prepare` allocates.
class DashpotSweeps {
 public:
  // As plan_dashpot_decay.
  void prepare(const Plan& plan, double duration);
  // As decay_dashpots, and springs with a law, of which those act that do at this time.
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

  double duration_ = 0.0;      // [s]
  std::vector<double> decay_;  // of the packed springs
  bool is_measured_ = false, has_swept_ = false;
  Field before_, change_;  // [m/s], before a sweep, and by all of them
  Field work_;             // [J]
};

}  // namespace hooke
