// The method `auto`: chooses the method and the substeps of each frame so that the error stays within a tolerance. Its choices follow from
// the scene alone, by a fixed model of the cost, so that every machine makes the same ones.
#pragma once

#include <memory>
#include <string>

#include "sim/methods/automatic_method.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"

namespace hooke {

class Frame;
class Trials;

// [m], that a simulated second may add to the RMS error of the positions, without one in the settings.
inline constexpr double default_automatic_tolerance = 1e-3;
double automatic_tolerance(const Settings& settings);

// Whether the choices, which may come from a file, are ones that can have been made: a method with fixed steps, numbers of steps within
// their limits, and no more groups than there can be.
bool is_valid(const MethodMemory& memory);

// The settings with which the frame that led to `after` was computed.
Settings settings_used(const Settings& settings, const State& after);

// The estimated error that a second at this choice adds [m], and whether it is more than the tolerance.
double error_per_second(const MethodChoice& choice, const Settings& settings);
bool is_tolerance_met(const MethodChoice& choice, const Settings& settings);

// "Velocity Verlet, 31 substeps: limited by stability; the error, 2e-06 m/s, is far below the tolerance."
std::string describe(const MethodChoice& choice, const Settings& settings);
// The same of each group of parts that are stepped separately. There must be a choice.
std::string describe(const MethodMemory& memory, const Settings& settings);

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

// Makes the choices. Kept from frame to frame, so that what belongs to the structure of the scene is computed once.
class AutomaticChoice {
 public:
  AutomaticChoice();
  ~AutomaticChoice();
  AutomaticChoice(AutomaticChoice&& other) noexcept;
  AutomaticChoice& operator=(AutomaticChoice&& other) noexcept;
  // For the frame that follows `state`, which remembers the choice for the one before. Computes frames on copies, now and then; often
  // after edits and impacts.
  MethodChoice choose(const Plan& plan, const System& system, const Settings& settings, const State& state);
  // The frame of the last call of `choose`, if it was computed to make the choice; it may be used once. Null: it was not.
  Frame* computed_frame(const MethodChoice& choice);
  // [ms], of what it computed on copies so far and was not used, by the model of the cost.
  double trial_cost() const;

 private:
  std::unique_ptr<Trials> trials_;
};

}  // namespace hooke
