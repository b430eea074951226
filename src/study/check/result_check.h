// How far the result of a scene depends on how it is computed: the same run with half the step, and with twice the resolution of its sheets
// and ropes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"
#include "study/forecast.h"

namespace hooke {

struct CheckedQuantity {
  std::string_view name, unit;
  std::optional<double> now, half_step, finer;  // none: not known
  std::string why_unknown{};                    // of any of them
  // Differences count relative to the larger value, or to this one if it is larger still.
  double scale = 0.0;
};

// "64 mm", "12 %", "-16 μJ (-0.001 %)".
std::string value_text(const CheckedQuantity& quantity, double value);

struct ResultCheck {
  double seconds = 0.0;  // [s], of the runs
  // sag [m] of the equilibrium, as the method finds it; period [s] of the slowest vibration, as the method computes it; maximum strain [1]
  // in the run; change of the energy [J] in the run
  std::vector<CheckedQuantity> quantities;
  std::optional<double> distance;  // [m], RMS over the points, between the ends of the runs with the step and with half of it
  double size = 1.0;               // [m], of the scene
  Index sheets = 0, ropes = 0;     // with twice the resolution
  std::string why_not_finer;       // in a clause; empty: it was computed
  std::string note;                // in a sentence: why there is no result; empty: there is one

  // "Independent of the step (0.02 mm); depends on resolution: sag 64 mm → 71 mm, refine once more."
  std::string sentence() const;
};

inline constexpr double default_check_seconds = 2.0;

// Quantities that change by less than this [1] count as independent.
inline constexpr double independent_change = 0.01;

// Runs copies from this state for `seconds` [s], and from the equilibrium. The finer copy takes half the step too, because its frequencies
// are twice as high: its values are to be compared with those of half the step. `progress` is called between substeps with the part done;
// false ends the check with a note.
ResultCheck check_result(const System& system, const State& state, const Settings& settings, double seconds, const Progress& progress,
                         const Forecast& before = {});

// Whether a change between two values counts. Not if either is unknown.
bool depends(const CheckedQuantity& quantity, const std::optional<double>& from, const std::optional<double>& to);

// The table as text, in lines.
std::string format_table(const ResultCheck& check);
std::string format_json(const ResultCheck& check);

}  // namespace hooke
