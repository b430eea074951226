// Which method and how many substeps an imported scene is given.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace hooke {

// Sets a stable method and number of substeps: the default method at four fifths of its linear limit, with at least `min_substeps`,
// if that is affordable, else an implicit method. `forces_omega` [rad/s] estimates the frequency of listed forces for which there is
// no bound. Returns a warning if the scene will be slow, or if no step is stable.
std::optional<std::string> choose_stable_stepping(Scene& scene, int min_substeps, double forces_omega = 0.0);

}  // namespace hooke
