// The effect of the arrow keys and brackets: they change stiffness, substeps and speed step by step.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "edit/history.h"
#include "lab/status.h"
#include "scene/selection.h"

namespace hooke {

struct Tuning {
  std::vector<Command> commands;  // one undo step together
  std::string message;            // the new value: "k = 110 N/m (3 springs)"
};

enum class TunedBy { StiffnessKeys, SubstepKeys, SpeedKeys };
struct LastTuning {
  TunedBy keys;
  Gesture gesture;
  std::chrono::steady_clock::time_point at;
};

// Stiffness of the selected springs, else of all springs; in a scene without springs, of new ones. By a factor of 1.1, or by the step that
// the scene defines. Direction +1 or -1.
Tuning tune_stiffness(const Status& status, const Selection& selection, int direction);

// To the next multiple of 5 substeps, at least 1; with the method `auto`, to half the tolerance or twice as much.
Tuning tune_substeps(const Status& status, int direction);

// The simulation speed times a factor, within its range.
Tuning tune_speed(const Status& status, double times);

}  // namespace hooke
