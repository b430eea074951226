#include "batch/run_frames.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/number_text.h"
#include "base/text_lines.h"
#include "base/threads/thread_time.h"
#include "batch/scene_options.h"
#include "lab/accuracy/accuracy_text.h"
#include "scene/crossed_parts.h"
#include "sim/control/automatic.h"
#include "sim/model/hash.h"
#include "study/benchmark.h"
#include "study/remedy/remedy.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

double wall_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr double round_off = 1e-9;

// Computes a frame, and adds its costs. False: the state is that of the previous frame, and the run ends.
bool compute_frame(Lab& lab, RunTotals& totals) {
  const double cpu = thread_cpu_seconds(), wall = wall_now();
  try {
    totals.diverged = !lab.step();
  } catch (const Interrupted&) {
    totals.interrupted = true;
  }
  const double measuring = lab.accuracy_cpu_seconds() - totals.accuracy_cpu_seconds;
  totals.cpu_seconds += std::max(0.0, thread_cpu_seconds() - cpu - measuring);
  totals.wall_seconds += std::max(0.0, wall_now() - wall - measuring);
  totals.accuracy_cpu_seconds += measuring;
  totals.force_evaluations += lab.last_frame().force_evaluations();
  totals.factorizations += lab.last_frame().factorizations();
  return !totals.diverged && !totals.interrupted;
}

}  // namespace

long count_frames(double seconds, double frame_rate) {
  check_option("seconds", seconds, not_negative);
  constexpr double max = 1e15;
  const double frames = seconds * frame_rate;
  if (!(frames <= max)) throw OptionError("seconds", format_exact(seconds), "must be at most 1e15 frames");
  if (frames == 0.0) return 0;
  return std::max(1L, static_cast<long>(std::ceil(frames * (1.0 - round_off) - round_off)));
}

SampleClock::SampleClock(std::optional<double> spacing, double frame_rate, long frames)
    : frames_per_sample_(spacing ? *spacing * frame_rate : 0.0), last_(frames) {}

bool SampleClock::is_due(long frame) {
  if (frames_per_sample_ == 0.0) return frame == last_;
  if (static_cast<double>(frame) < next_ * frames_per_sample_ * (1.0 - round_off)) return false;
  // at most one sample per frame: multiples within the same frame share it
  next_ = std::floor(static_cast<double>(frame) / frames_per_sample_ * (1.0 + round_off)) + 1.0;
  return true;
}

long SampleClock::max_count(std::optional<double> spacing, double frame_rate, long frames) {
  if (!spacing) return 1;
  // at most one sample per frame and per multiple of the spacing
  const double multiples = std::floor(static_cast<double>(frames) / (*spacing * frame_rate) * (1.0 + round_off)) + 1.0;
  return std::min(frames + 1, static_cast<long>(std::min(multiples + 1.0, 1e18)));
}

RunResults run_frames(Lab& lab, const RunRequest& request, const RunHooks& hooks) {
  if (request.sample) check_option("sample", *request.sample, positive);
  const Scene& scene = lab.scene();
  const double start = scene.state.time;
  const long frames = count_frames(request.seconds, scene.settings.frame_rate);
  lab.submit(SetAccuracy{request.accuracy});
  lab.apply_pending();

  RunResults results;
  RunTotals& totals = results.totals;
  ToleranceMonitor tolerance;
  // two states, so that one is at least a second before a divergence
  SampleClock kept_states(1.0, scene.settings.frame_rate, frames);
  const bool keeps_states = may_reach(scene.settings.frame_rate, scene.system.point_count(), scene.system.spring_count());
  auto last_kept = keeps_states ? std::make_shared<const State>(scene.state) : nullptr;
  RunMonitor monitor(lab.plan(), scene.settings, scene.system, scene.state, 0);
  const auto add_sample = [&] {
    if (hooks.sample) hooks.sample(scene.state, lab.accuracy());
  };
  SampleClock samples(request.sample, scene.settings.frame_rate, frames);
  for (long frame = 0;; ++frame) {
    const bool is_sampled = samples.is_due(frame);
    if (is_sampled) add_sample();
    const bool is_ended = hooks.frame && !hooks.frame();
    if (is_ended && !is_sampled) add_sample();
    if (is_ended || frame == frames) break;

    if (keeps_states && kept_states.is_due(frame) && frame > 0) {
      results.before_end = std::move(last_kept);
      last_kept = std::make_shared<const State>(scene.state);
    }
    monitor.begin_frame(scene.system, scene.settings, scene.state);
    if (!compute_frame(lab, totals)) {
      // the last good state, unless it was already sampled
      if (!is_sampled) add_sample();
      break;
    }
    tolerance.add_frame(scene.settings, scene.state);
    monitor.end_frame(lab.plan(), settings_used(scene.settings, scene.state), scene.system, scene.state, lab.last_frame().motion());
    if (hooks.progress) hooks.progress(frame + 1, frames);
  }
  const PairContact& contact = scene.system.contact;
  if (!totals.diverged && (scene.system.dimensions == 3 ? contact.faces : contact.springs))
    monitor.note_crossings(static_cast<long>(count_crossings(scene.system, scene.state)), scene.state.time);
  totals.seconds = scene.state.time - start;
  totals.hash = hash_state(scene.state);
  if (is_automatic(scene.settings)) totals.frames_beyond_tolerance = tolerance.frames_beyond();
  results.warnings = monitor.warnings({});
  totals.gas_releases = lab.gas_releases();
  if (!totals.gas_releases.empty())
    results.warnings.push_back("tears released the gas of " + pluralize(totals.gas_releases.size(), "surface", "surfaces") + ", from " +
                               quantity_text(totals.gas_releases.front(), "s") + " on");
  if (const std::string refusal = lab.device_refusal(); !refusal.empty())
    results.warnings.push_back(refusal + "; the processor computed the rest");
  if (tolerance.frames_beyond() > 0) results.warnings.push_back(tolerance.warning());
  if (!totals.diverged)
    if (const auto warning = accumulated_warning(lab.accuracy())) results.warnings.push_back(*warning);
  return results;
}

RunTotals replay_frames(Lab& lab, const std::shared_ptr<const Recording>& recording, const RunRequest& request, const RunHooks& hooks) {
  if (request.sample) check_option("sample", *request.sample, positive);
  const Scene& scene = lab.scene();
  lab.submit(Play{recording});
  lab.submit(SetAccuracy{request.accuracy});
  lab.apply_pending();

  RunTotals totals;
  ToleranceMonitor tolerance;
  SampleClock samples(request.sample, scene.settings.frame_rate, recording->frames);
  for (long frame = 0;; ++frame) {
    const bool is_ended = !lab.is_playing(), is_sampled = samples.is_due(frame);
    if ((is_sampled || is_ended) && hooks.sample) hooks.sample(scene.state, lab.accuracy());
    if (is_ended) break;
    const bool is_valid = compute_frame(lab, totals);
    if (hooks.progress) hooks.progress(frame + 1, recording->frames);
    if (!is_valid) {
      if (!is_sampled && hooks.sample) hooks.sample(scene.state, lab.accuracy());
      break;
    }
    totals.seconds += lab.last_frame().duration();
    ++totals.frames;
    tolerance.add_frame(scene.settings, scene.state);
  }
  totals.gas_releases = lab.gas_releases();
  totals.hash = hash_state(scene.state);
  if (is_automatic(scene.settings)) totals.frames_beyond_tolerance = tolerance.frames_beyond();
  return totals;
}

}  // namespace hooke
