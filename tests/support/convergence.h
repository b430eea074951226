// Convergence orders measured from errors, from which the tests derive their tolerances.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "sim/methods/integrator.h"

namespace hooke {

// p such that error(steps) ~ steps^-p: log2 of the error ratio when the step is halved.
inline double measured_order(const std::function<double(int)>& error, int steps) { return std::log2(error(steps) / error(2 * steps)); }

// The error falls at the declared order when the step is halved, neither slower nor faster, within at least a twentieth of the order. An
// error at round-off level has no order.
inline void expect_order(const std::function<double(int)>& error, int steps, double order, double tolerance = 0.15) {
  const double coarse = error(steps), fine = error(2 * steps);
  constexpr double round_off = 2e-13;
  if (coarse < round_off) return;
  EXPECT_NEAR(std::log2(coarse / fine), order, std::max(tolerance, 0.05 * order))
      << "errors " << coarse << " and " << fine << " at " << steps << " and " << 2 * steps << " steps";
}

// The number of steps for a motion of a few radians that is in the asymptotic range of a method of this order and above round-off.
inline int asymptotic_steps(int order) { return order == 1 ? 20000 : order == 2 ? 1000 : order <= 4 ? 100 : 16; }

// A fixture for claims about every method of the table.
class EveryMethod : public testing::TestWithParam<const Integrator*> {
 protected:
  const Integrator& method() const { return *GetParam(); }
};

inline std::vector<const Integrator*> every_method() {
  std::vector<const Integrator*> methods;
  for (const Integrator& row : integrators()) methods.push_back(&row);
  return methods;
}

// Those for which the test is meant.
template <class Predicate>
std::vector<const Integrator*> methods_that(const Predicate& predicate) {
  std::vector<const Integrator*> methods = every_method();
  std::erase_if(methods, [&](const Integrator* method) { return !predicate(*method); });
  return methods;
}
inline bool can_be_stable(const Integrator& method) { return method.stability != Stability::None; }

inline std::string method_name(const testing::TestParamInfo<const Integrator*>& info) { return std::string(info.param->id); }

}  // namespace hooke
