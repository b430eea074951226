// Which method and how many substeps an imported scene is given.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace hooke {

// Sets a method and substeps under which the scene does not blow up, however it moves: velocity Verlet at four
// fifths of its limit, with at least `min_substeps`, where that is affordable; else an implicit method, where there is one that holds.
// `forces_omega` [rad/s] bounds what the scene's listed forces add to its springs' highest frequency. Returns a sentence if
// the scene will be slow, or if nothing holds.
std::optional<std::string> choose_stable_stepping(Scene& scene, int min_substeps, double forces_omega = 0.0);

}  // namespace hooke
