// The effect of a parameter on the current scene: a line below its slider.
#pragma once

#include "scene/parameters.h"
#include "ui/panels.h"

namespace hooke {

// Below the substeps: the step and omega h; below stiffness and gravity: the sag; below damping and drag: the damping ratios. A dash if no
// value is available.
void parameter_hint_row(const Parameter& row, const PanelInput& input);

}  // namespace hooke
