// Points that touch nothing in a substep, and those that rest or slide on one plane or ball for all of it, by vectors.
#pragma once

#include <cstdint>
#include <span>

#include "sim/contact/obstacle.h"

namespace hooke {

// What became of points in a substep: of consecutive ones, at most `max` of them.
struct RestingPoints {
  static constexpr std::size_t max = 512;
  enum Outcome : std::uint8_t {
    Free,    // it certainly touches nothing
    Solved,  // its path was corrected
    Open,    // left to TouchSimulation
  };
  Outcome* outcome = nullptr;
  double* work = nullptr;  // [J], of contact in addition to that of the forces; 0 unless it was solved
  bool any_solved = false, any_open = false;
};

// Corrects the step of h from (x0, v0) to (x, v) of those of the points `first` .. `end` - 1 that lie on one obstacle at the start, press
// on it during all of the step, and touch no other. They start with v0 (without friction with u, the velocity of the method's
// path), are supported by N = -(n . a + v^2 / R), and end with
//   v' = v + h (d - mu N v' / |v'|),    x' = x + h (v + v') / 2 + lag h (v' - v),
// where d is the acceleration along the surface; what friction stops within the step rests from then on. On a ball, the end is moved along
// the normal onto the surface, and friction takes the mean of N at both ends (RATTLE, H. C. Andersen 1983). `lag` [1]: of methods that keep
// their path under friction (ContactWorkspace::friction_lag). `left_out`: per point, those that are left alone; null: there are none.
void solve_resting_points(const Plan& plan, std::span<const Obstacle> obstacles, double h, double lag, const char* left_out,
                          std::size_t first, std::size_t end, const Field& x0, const Field& v0, Field& x, Field& v, RestingPoints& points);

}  // namespace hooke
