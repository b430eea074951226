#include "lab/scene_check.h"

#include <cmath>
#include <cstdio>

#include "lab/lab.h"
#include "lab/run_books.h"
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

// What is known of how far the run may be trusted.
std::string describe_trust(const RunBooks& books, const System& system) {
  char text[80];
  std::snprintf(text, sizeof text, "; errors of %.1g m in all, as estimated", books.estimated_error());
  std::string trust = text;
  for (const std::string& doubt : books.doubts(system, {})) trust += "; " + doubt;
  return trust;
}

}  // namespace

SceneCheck check_scene(const Scene& scene, SceneEnd expected, double seconds) {
  Lab lab(scene, KeepStart::No);
  const double patience = expected == SceneEnd::StopsOpenly ? 100.0 * seconds : seconds;
  const long frames = std::lround(std::ceil(patience * scene.settings.frame_rate));
  constexpr int frames_per_estimate = 20;
  RunBooks books(lab.scene().system, lab.scene().state, expected == SceneEnd::Finite ? frames_per_estimate : 0);
  for (long i = 0; i < frames; ++i) {
    books.begin_frame(lab.scene().system, lab.scene().settings, lab.scene().state);
    if (lab.step()) {
      books.end_frame(lab.scene().system, lab.scene().state, lab.last_frame().motion());
      continue;
    }
    lab.publish();
    const Status& status = *lab.status();
    const bool open = status.snapshot->divergence && !status.message.empty() && status.advice && is_finite(lab.scene().state);
    return {open && expected == SceneEnd::StopsOpenly, status.message};
  }
  const bool finite = is_finite(lab.scene().state);
  return {finite && expected == SceneEnd::Finite,
          describe_end(lab) + (expected == SceneEnd::StopsOpenly ? "; it was to be stopped by the watch" : describe_trust(books, lab.scene().system))};
}

SceneEnd expected_end(const std::string& id) { return id == "unstable" ? SceneEnd::StopsOpenly : SceneEnd::Finite; }

}  // namespace hooke
