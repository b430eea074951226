// The row of the method `auto`, which chooses the method and the substeps of each frame by a tolerance.
#pragma once

#include "sim/methods/integrator.h"
#include "sim/model/settings.h"

namespace hooke {

// For menus and files. It is not in the table of integrators, because it has no step of its own.
const Integrator& automatic_method();
inline bool is_automatic(const Settings& settings) { return settings.integrator == &automatic_method(); }

}  // namespace hooke
