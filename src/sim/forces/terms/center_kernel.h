// A central attraction with a whole exponent on all points, by vectors.
#pragma once

#include "sim/plan/plan.h"

namespace hooke {

// f -= m s a(r) / r (x - c), with a(r) / r = r^exponent outside the core and core_law (alpha + beta (r / core)^2) inside, as in center.cpp.
struct CenterLaw {
  Vec3 center{0.0};
  double strength = 0.0, core = 0.0;
  int exponent = 0;
  double core_law = 0.0, alpha = 0.0, beta = 0.0;
};

// To the same bits as point by point.
void add_center_forces(const Plan& plan, const CenterLaw& law, const double* x, double* f);

}  // namespace hooke
