// How wrong a run is, as measured beside it: the error of a frame, its accumulation, the growth of small differences, and where the
// energy went. lab/accuracy measures it; panels, reports and plots only read it.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "sim/model/energy_ledger.h"

namespace hooke {

// A value, or why there is none: one clause for panels and reports.
struct Measured {
  std::optional<double> value{};
  std::string_view reason{};
};

// Why the accumulated error is not known although it was measured: the run lost the motion, or what it is compared with failed.
enum class Loss { None, Unpredictable, Dissipated, HalfStepDiverged, NoSecondRun, Unresolved };

// Where the energy came from and went since `since`.
struct EnergyBalance {
  double since = 0.0;   // [s]
  double change = 0.0;  // [J], of kinetic, elastic and gravitational energy together
  EnergyLedger ledger;  // what explains it
  // [J], the rest, gained or lost by the numerical method.
  double method() const { return change - ledger.sum(); }
  // [J], the change, its terms and the rest, by their names in reports.
  std::array<std::pair<const char*, double>, 11> terms() const {
    using enum EnergyCause;
    return {{{"change", change},
             {"hand", ledger[Hand]},
             {"edits", ledger[Edits]},
             {"forces", ledger.forces()},
             {"muscles", ledger[Muscles]},
             {"colliders", ledger[Colliders]},
             {"limits", ledger.limits()},
             {"drag", ledger[Drag]},
             {"dashpots", ledger[Dashpots]},
             {"contact", ledger[Contact]},
             {"method", method()}}};
  }
  bool operator==(const EnergyBalance&) const = default;
};

struct Accuracy {
  bool is_on = false;
  std::string_view off_reason = "switched off";  // why nothing is measured, if it is not on
  double size = 1.0;                             // [m], largest extent of the scene: errors are shown relative to it

  // [m], RMS and maximum over the points, of the frame that ended at `frame_time`, made by the method within that one frame
  Measured frame, frame_max;
  double frame_time = 0.0, time = 0.0;  // [s]; `time`: of the last frame
  std::optional<double> estimated{};    // [m], error of the last frame as `auto` estimated it; none with another method

  // [m], maximum RMS distance of the points from where they were at `since`: what an accumulated error is relative to; 0: not measured
  double motion = 0.0;

  // [m], RMS over the points: how far the run is from the exact motion that started at `since` with the same state and had the same input
  Measured accumulated;
  Loss loss = Loss::None;
  bool is_smooth = true;  // nothing touched or broke, no strain limit and no hand acted: a tolerance decides about the accumulated error
  double since = 0.0, accumulated_time = 0.0;  // [s]: start, and the time up to which it is known
  // [m], [s]: the largest one since then, and when; an error may fall again, as when a vibration of the wrong frequency dies out
  double max_accumulated = 0.0, max_accumulated_time = 0.0;

  // [1], factor by which a small difference grows in a second; and the rate [1/s] of its exponential growth, 0: none
  Measured amplification, growth_rate;
  Measured predictable;  // [s], until small errors have grown to a tenth of the size; infinity: no exponential growth

  EnergyBalance energy;
  double energy_scale = 0.0;  // [J], all that was supplied: what the gain or loss by the method is relative to; 0: not measured

  // What half the error needs: the number of substeps or the tolerance, and the time a frame takes relative to now [1]
  int half_error_substeps = 0;
  double half_error_tolerance = 0.0;  // [m], of an adaptive method; 0: it has none
  double half_error_cost = 0.0;
  std::string_view half_error_reason{};  // why nothing is known, if so
};

}  // namespace hooke
