// What the laboratory passes on to its meter, and when it measures.
#include "base/threads/thread_time.h"
#include "lab/lab.h"
#include "sim/control/automatic.h"

namespace hooke {
// Passes the frame from the present state to its end on to the meter.
void Lab::meter_frame(double energy) {
  if (measuring_.meter.mode() == AccuracyMode::Off) return;
  const bool is_torn = !frame_.runner.broken().empty();
  // a frame in which springs broke is computed again before they are removed, unless earlier ones wait: then the second runs start again
  const bool at_once = measuring_.at_once || (is_torn && !measuring_.meter.has_work());
  measuring_.meter.add_frame(plan_, scene_.system, settings_used(scene_.settings, frame_.end), scene_.state, frame_.end,
                             frame_.runner.motion(), energy_.total(), energy);
  // in most frames there is nothing to compute, and reading the clock would take as long as a frame of two points
  if (at_once && has_accuracy_to_measure()) {
    const double start = thread_cpu_seconds();
    measure_accuracy([] { return true; });
    measuring_.cpu_seconds += thread_cpu_seconds() - start;
  }
  if (is_torn) measuring_.meter.note_edit();
}

// `settings`: those before the edit. The speed of the clock affects no frame.
void Lab::pass_edit_to_meter(const Effect& effect, Settings settings) {
  settings.speed = scene_.settings.speed;
  if (effect.structure || effect.motion)
    measuring_.meter.restart();
  else if (effect.values || settings != scene_.settings)
    measuring_.meter.note_edit();
}

Accuracy Lab::accuracy() const {
  Accuracy accuracy = measuring_.meter.accuracy(settings_used(scene_.settings, scene_.state));
  accuracy.time = scene_.state.time;
  if (const auto& choice = scene_.state.memory.choice; choice && is_automatic(scene_.settings)) accuracy.estimated = choice->error;
  if (is_automatic(scene_.settings) && accuracy.half_error.substeps > 0)
    accuracy.half_error.tolerance = 0.5 * scene_.settings.tolerance.value_or(default_automatic_tolerance);
  return accuracy;
}

void Lab::measure_accuracy(const std::function<bool()>& should_continue) {
  const InPhase in(plan_.execution.phases, Phase::Accuracy);
  while (measuring_.meter.is_repeating() && should_continue()) measuring_.meter.repeat(scene_.system);
  while (measuring_.meter.has_work() && should_continue()) measuring_.meter.work(scene_.system);
}

}  // namespace hooke
