// What the arrow keys and the brackets do: k, substeps and speed, step by step.
#pragma once

#include <string>
#include <vector>

#include "edit/command.h"
#include "lab/status.h"
#include "scene/selection.h"

namespace hooke {

struct Tuning {
  std::vector<Command> commands;  // one step of undo together
  std::string message;            // the new value: "k = 110 N/m (3 springs)"
};

// k of the selected springs, else of all and of new ones: times 1.1, or by the scene's own step. Direction +1 or -1.
Tuning tune_stiffness(const Status& status, const Selection& selection, int direction);

// 5 substeps more or fewer, on multiples of 5; at least 1.
Tuning tune_substeps(const Status& status, int direction);

// The speed times a factor, within its range.
Tuning tune_speed(const Status& status, double times);

}  // namespace hooke
