// Points that rest on a ball or plane, or slide along it, by vectors: what most points that touch a collider do.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/plan/plan.h"

namespace hooke {

// What became of the points first .. end - 1 in a step, at most `max` of them.
struct RestingPoints {
  static constexpr std::size_t max = 512;
  enum Outcome : std::uint8_t {
    Free,    // it certainly touches nothing
    Solved,  // its path was corrected
    Open,    // neither is known: left to the PointContactSolver
  };
  // Of each point from `first` on: the outcome, and the work [J] of the contact in addition to the work of the forces, 0 unless it was
  // solved.
  Outcome* outcome = nullptr;
  double* work = nullptr;
  bool any_solved = false, any_open = false;
};

// Corrects the step of h that led from (x0, v0) to (x, v), of those of the points that lie on the surface of one ball or plane at the
// start, stay on it for the whole step, under any friction, and are certainly out of reach of all other colliders. To the bits of the
// PointContactSolver. For colliders that do not move.
void solve_resting_points(const Plan& plan, double h, std::size_t first, std::size_t end, const Field& x0, const Field& v0, Field& x,
                          Field& v, RestingPoints& points);

}  // namespace hooke
