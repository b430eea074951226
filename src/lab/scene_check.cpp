#include "lab/scene_check.h"

#include <cmath>
#include <cstdio>

#include "lab/lab.h"
#include "sim/divergence.h"

namespace hooke {
namespace {

std::string describe_end(const Lab& lab) {
  char text[160];
  const Energy energy = compute_energy(lab.scene().system, lab.scene().state);
  std::snprintf(text, sizeof text, "%.3g s under %s, %d substeps: energy %.4g J", lab.scene().state.time,
                std::string(lab.scene().settings.integrator->id).c_str(), lab.scene().settings.substeps, energy.total());
  return text;
}

}  // namespace

SceneCheck check_scene(const Scene& scene, SceneEnd expected, double seconds) {
  Lab lab(scene, KeepStart::No);
  const double patience = expected == SceneEnd::StopsOpenly ? 100.0 * seconds : seconds;
  const long frames = std::lround(std::ceil(patience * scene.settings.frame_rate));
  for (long i = 0; i < frames; ++i) {
    if (lab.step()) continue;
    lab.publish();
    const Status& status = *lab.status();
    const bool open = status.snapshot->divergence && !status.message.empty() && status.advice && is_finite(lab.scene().state);
    return {open && expected == SceneEnd::StopsOpenly, status.message};
  }
  const bool finite = is_finite(lab.scene().state);
  return {finite && expected == SceneEnd::Finite,
          describe_end(lab) + (expected == SceneEnd::StopsOpenly ? "; it was to be stopped by the watch" : "")};
}

SceneEnd expected_end(const std::string& id) { return id == "unstable" ? SceneEnd::StopsOpenly : SceneEnd::Finite; }

}  // namespace hooke
