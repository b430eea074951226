// A scene as the buffers of shaders/compute/common.glsl, in float or double.
#pragma once

#include <array>
#include <vector>

#include "sim/forces/motion.h"
#include "sim/methods/integrator.h"
#include "sim/step/frame_device.h"

namespace hooke {

// The bindings of the buffers.
enum Binding {
  FromState,
  ToState,
  Accelerations,
  FirstNeighbor,
  Neighbors,
  Springs,
  FrameNumbers,
  Moments,
  PanelCorners,
  FirstPanel,
  PanelsOfPoints,
  Radii,
  Events,
  SpringEnds,
  BreakLimits,
  Colliders,
  Sweeps,
  Works,
  Sums
};
inline constexpr int bindings = Sums + 1;

// Which items belong to each point, in ascending order: items[first[i]] .. items[first[i + 1] - 1].
struct PointLists {
  std::vector<Index> first, items;
};

// The ends of the packed springs, and for each point the pairs (other end, spring).
struct SpringGraph {
  std::vector<Index> ends;
  PointLists neighbors;
};
SpringGraph graph_of(const Plan& plan);
// The panels of each point.
PointLists panels_of_points(const Plan& plan);

// Whether all points are one grid, whose springs need no lists; and of how many of its rows the springs are stored: 1 if all are the same.
bool is_grid(const Plan& plan);
Index stored_rows(const Grid& grid);

// All numbers below are those of the structs of the shaders, in their order.
std::vector<double> state_numbers(const Plan& plan, const Motion& motion);
void read_state(const std::vector<double>& numbers, const Plan& plan, Motion& motion);
std::vector<double> spring_numbers(const Plan& plan);
std::vector<double> limit_numbers(const Plan& plan);
std::vector<double> frame_numbers(const Plan& plan, const FrameSteps& steps);
std::vector<double> moment_numbers(const Plan& plan, const FrameSteps& steps, double start);
std::vector<double> collider_numbers(const Plan& plan, const FrameSteps& steps, double start);
// The dashpots of `velocity_verlet`, which act one after another, over `duration` [s], level by level: those of a level share no point, and
// each level follows those on which it depends. Level n: sweeps begin[n] .. begin[n + 1] - 1 of the numbers.
struct SweepLevels {
  std::vector<double> numbers;
  std::vector<Index> begin;
};
SweepLevels sweep_levels(const Plan& plan, double duration);
// In the order of `passes` in the frame.
enum PassKind { WholeKick, FirstHalf, LastHalf };

}  // namespace hooke
