// Chooses the method and the number of substeps of an imported scene.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace hooke {

// Sets a stable method and number of substeps: the default method at four fifths of its linear limit, with at least `min_substeps`, if that
// is affordable, otherwise an implicit method. `forces_omega` [rad/s] is another estimate of the frequency of listed forces without a
// bound. Returns a warning if the scene will be slow, or if no step is stable.
std::optional<std::string> choose_stable_stepping(Scene& scene, int min_substeps, double forces_omega = 0.0);

}  // namespace hooke
