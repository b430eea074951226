// The method `auto` in words and settings: it chooses the method and the substeps of each frame so that its error stays within a tolerance
// (frame_runner.h). Its choices follow from the scene alone, by a fixed model of the cost, so that every machine makes the same ones.
#pragma once

#include <string>

#include "sim/methods/automatic_method.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"

namespace hooke {

// [m], that a simulated second may add to the RMS error of the positions, without one in the settings.
inline constexpr double default_automatic_tolerance = 1e-3;
double automatic_tolerance(const Settings& settings);

// The most substeps that `auto` takes in a frame.
inline constexpr int max_automatic_substeps = 1 << 16;

// Whether the choice, which may come from a file, is one that can have been made: a method with fixed steps, and numbers of steps within
// their limits.
bool is_valid(const MethodMemory& memory);

// The settings with which the frame that led to `after` was computed.
Settings settings_used(const Settings& settings, const State& after);

// After an edit: the error of the next frame is estimated.
void estimate_after_edit(MethodMemory& memory);

// [m], that a second with the error of this frame adds; 0 where that was not estimated. And whether it is within the tolerance.
double error_per_second(const MethodChoice& choice, const Settings& settings);
bool is_tolerance_met(const MethodChoice& choice, const Settings& settings);

// "Velocity Verlet, 62 substeps: the fewest that are stable and resolve what moves; the error is 2e-06 m/s."
std::string describe(const MethodChoice& choice, const Settings& settings);

// Counts the frames of a run in which the tolerance was not met; none with another method.
class ToleranceMonitor {
 public:
  // After each frame.
  void add_frame(const Settings& settings, const State& after);
  long frames_beyond() const { return beyond_; }
  // "the tolerance was not met in 3 of 60 frames: up to 0.004 m/s"; empty if it was.
  std::string warning() const;

 private:
  long frames_ = 0, beyond_ = 0;
  double max_error_ = 0.0;  // [m/s]
};

}  // namespace hooke
