// Springs as compliant constraints, each projected alone, one after another (methods/xpbd.cpp). The same bits on every machine.
#pragma once

#include <vector>

#include "sim/forces/motion.h"
#include "sim/forces/sweep_runs.h"

namespace hooke {

class Constraints final : public Structure {
 public:
  // Color by color: springs of one color share no point. In grids (from min_springs_of_grids on), the colors are the directions, each for
  // even and for odd rows or columns; all other springs are colored greedily in the order of the distance of their ends in the list of
  // points.
  explicit Constraints(const Plan& plan);

  // For steps of h [s], in which a force on a point acts for phi [s].
  void prepare(const Plan& plan, double h, double phi);

  // v_i += w_i J u,  v_j -= w_j J u for every spring: J = -(phi k (l - l0) + phi d (v_i - v_j).u) / (1 + phi (h k + d)(w_i + w_j)) with
  // l and u at x + h v. Nothing where the ends coincide there.
  void sweep(const Plan& plan, double h, const Field& x, Field& v) const;

  // In an order that has the same result as color by color.
  const std::vector<SweepRun>& runs() const { return runs_; }

 private:
  std::vector<SweepRun> runs_;
  std::size_t list_size_ = 0;
  std::vector<double> rest_length_;
  std::vector<double> stiffness_, damping_;  // phi k and phi d over the denominator [N s/m], [kg]; damping empty: no dashpots
};

}  // namespace hooke
