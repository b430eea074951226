// What a number means for the scene on the screen: a line under its slider.
#pragma once

#include "scene/parameters.h"
#include "ui/panels.h"

namespace hooke {

// Under the substeps the step and omega h; under stiffness and weight the sag; under dashpots and drag how fast they take swings
// away. A dash where nothing can be said.
void parameter_hint_row(const Parameter& row, const PanelInput& input);

}  // namespace hooke
