// Points that rest on a ball or plane, or slide along it, by vectors: what most points that touch a collider do.
#pragma once

#include <array>
#include <cstdint>

#include "sim/plan.h"

namespace hooke {

// What became of some consecutive points in a step.
struct RestingPoints {
  static constexpr std::size_t max = 512;
  enum Outcome : std::uint8_t {
    Free,    // it certainly touches nothing
    Solved,  // its path was corrected
    Open,    // neither is known: left to the PointContactSolver
  };
  std::array<Outcome, max> outcome;
  std::array<double, max> work;  // [J], of the contact on solved points, in addition to the work of the forces
};

// Corrects the step of h that led from (x0, v0) to (x, v), of those of `max` points from `first` on that lie on the surface of one ball or
// plane at the start, stay on it for the whole step, under any friction, and are certainly out of reach of all other colliders. To the bits
// of the PointContactSolver. For colliders that do not move.
void solve_resting_points(const Plan& plan, double h, std::size_t first, const Field& x0, const Field& v0, Field& x, Field& v,
                          RestingPoints& points);

}  // namespace hooke
