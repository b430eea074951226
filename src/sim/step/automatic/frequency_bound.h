// A bound on the frequencies of the springs in the present state. That of the Plan holds for every deformation, also where all springs of a
// point are parallel, and is up to 1.4 times as large.
#pragma once

#include "sim/model/state.h"
#include "sim/plan/plan.h"

namespace hooke {

class FrequencyBound {
 public:
  // The bound for the coming `duration` [s], relative to that of the Plan [1], at most 1; of the rates of the dashpots too. 1 where other
  // things than springs and dashpots act.
  double relative(const Plan& plan, const State& state, double duration);
  // [ms], of that, by the model of the cost.
  double cost(const Plan& plan);

 private:
  // Where a spring points, and by how much that may change.
  struct Direction {
    Vec3 along{0.0};
    double turn = 0.0;  // [rad]
  };
  void find_neighbors(const Plan& plan);

  std::vector<SpringRun> runs_;
  std::vector<Index> first_, second_;    // ends of each packed spring
  std::vector<Index> begin_, adjacent_;  // springs of each point: adjacent_[begin_[i]] to adjacent_[begin_[i + 1]]
  std::size_t pairs_ = 0;                // of adjacent springs
  std::vector<Direction> directions_;
  std::vector<double> tension_;  // [1/s^2], per point
};

}  // namespace hooke
