// The sweeps of dashpot.h. Over the springs of a net with short runs: spring by spring, in the order of the sweep but with independent
// springs side by side, so that processors overlap them; to the same bits. Large nets are swept from the middle to both sides and back, on
// two threads if there are any; to the same bits for any number of them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/forces/dashpots/dashpot.h"

namespace hooke {

// A spring with what a sweep reads of it: a cache line.
struct OrderedSpring {
  double along[4];              // [m], x1 - x2, and 0
  double factor;                // decay / |x1 - x2|^2
  double inverse_mass[2];       // [1/kg]
  std::uint32_t first, second;  // where the four numbers of its points are
};

// Sweeps over the same duration. Only `prepare` allocates.
class DashpotSweeps {
 public:
  // As plan_dashpot_decay.
  void prepare(const Plan& plan, double duration);
  // As decay_dashpots with all runs. `is_same`: x is that of the last sweep since prepare.
  void sweep(const Plan& plan, SweepDirection sweep, bool is_same, const Field& x, Field& v);

  // Whether sweeps are measured, over fields of this size.
  void measure(bool is_measured, std::size_t size);
  // Of the sweeps since then, if they are measured: whether there were any; by what they changed each component of the velocities [m/s],
  // and the kinetic energy in it [J].
  void begin_step();
  bool has_swept() const { return has_swept_; }
  const Field& change() const { return change_; }
  const Field& work() const { return work_; }

 private:
  void apply(const Plan& plan, SweepDirection sweep, bool is_same, const Field& x, Field& v);
  void order_springs(const Plan& plan);
  void divide_springs(const Plan& plan);
  void clear_halves();
  void sweep_halves(const Plan& plan, SweepDirection sweep, const Field& x, Field& v) const;

  std::vector<double> decay_;  // of the packed springs
  // The springs in their new order; empty: as they are packed. A spring comes after all those before it in the sweep that share a point
  // with it, and otherwise as early as possible.
  std::vector<OrderedSpring> springs_;
  std::vector<Index> packed_;
  std::vector<double> ordered_decay_;
  // Of a large net: springs between the points of the first half, between those of the second one, and from one to the other; empty: it is
  // swept as one.
  std::array<std::vector<SpringRun>, 2> halves_;
  std::vector<SpringRun> middle_;
  std::vector<SpringRun> known_runs_;  // those of which these are the order or the halves
  bool is_known_ = false;              // whether the springs have the vectors and factors of the last sweep
  std::vector<double> x_, v_;          // four numbers for each point, the last of them 0
  bool is_measured_ = false, has_swept_ = false;
  Field before_, change_;  // [m/s], before a sweep, and by all of them
  Field work_;             // [J]
};

}  // namespace hooke
