// Diagonally implicit Runge-Kutta methods from their tableaux, common to tr_bdf2, esdirk4, implicit_midpoint and
// implicit_euler.
#pragma once

#include <array>
#include <complex>

#include "sim/methods/integrator.h"

namespace hooke {

inline constexpr int max_dirk_stages = 6;

// y = (x, v), k_i = f(t + c_i h, y + h sum_j a_ij k_j), y' = y + h sum_i b_i k_i; c_i is the sum of row i. All implicit
// stages have the same a_ii, so that one matrix serves them; a method with a_00 = 0 starts explicitly.
struct DirkTable {
  using Row = std::array<double, max_dirk_stages>;
  int stages;
  std::array<Row, max_dirk_stages> a;
  Row b;
  Row b_embedded;    // of the embedded method, or no_embedded
  double tolerance;  // [1], of the solution of a stage: far below the error of the method

  constexpr double node(int stage) const {
    double c = 0.0;
    for (int j = 0; j <= stage; ++j) c += a[stage][j];
    return c;
  }
  // The last stage is the result: its slopes are the first ones of the next step.
  constexpr bool stiffly_accurate() const { return b == a[stages - 1]; }
};

inline constexpr DirkTable::Row no_embedded{};

void prepare_dirk(const DirkTable& table, const Plan& plan, const Motion& motion, Workspace& work);
void step_dirk(const DirkTable& table, const Plan& plan, Motion& motion, Workspace& work, double h);

// R(z) of y' = lambda y, z = h lambda.
std::complex<double> stability_function(const DirkTable& table, std::complex<double> z);

// The functions of an Integrator's row.
template <const DirkTable& table>
struct DirkMethod {
  static void prepare(const Plan& plan, double, const Motion& motion, Workspace& work) { prepare_dirk(table, plan, motion, work); }
  static void step(const Plan& plan, Motion& motion, Workspace& work, double h) { step_dirk(table, plan, motion, work, h); }
  static Amplification amplification(const Oscillator& oscillator) {
    return amplification_from([](std::complex<double> z) { return stability_function(table, z); }, oscillator);
  }
};

}  // namespace hooke
