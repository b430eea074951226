// Runs of copies of a scene, for the checks.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/progress.h"
#include "lab/lab.h"
#include "study/forecast.h"

namespace hooke {

// A check was canceled.
struct Stopped {};

// Reports the work done within a part of the whole, and throws Stopped when it is canceled.
class Part {
 public:
  Part(const Progress& progress, double begin, double end) : progress_(progress), begin_(begin), end_(end) {}
  void report(double fraction) const {
    if (!progress_(begin_ + (end_ - begin_) * std::clamp(fraction, 0.0, 1.0))) throw Stopped{};
  }
  Part within(double begin, double end) const { return {progress_, begin_ + (end_ - begin_) * begin, begin_ + (end_ - begin_) * end}; }

 private:
  const Progress& progress_;
  double begin_, end_;
};

Scene scene_of(const System& system, const State& state, const Settings& settings);

// Computes frames until `seconds` [s] have passed; `after_frame` is called after each. False if it diverged.
template <class AfterFrame>
bool run_frames(Lab& lab, double seconds, const Part& part, const AfterFrame& after_frame) {
  const double rate = lab.scene().settings.frame_rate;
  const long frames = std::max(1L, std::lround(std::ceil(seconds * rate - 1e-9)));
  long frame = 0;
  const struct ProgressWatch {
    Lab& lab;
    ~ProgressWatch() { lab.watch_substeps({}); }
  } watch{lab};
  lab.watch_substeps([&] { part.report(static_cast<double>(frame) / static_cast<double>(frames)); });
  for (; frame < frames; ++frame) {
    if (!lab.step()) return false;
    after_frame(lab.scene());
  }
  return true;
}

// Computed on another thread, so that it can be canceled.
// `before`: an initial guess, see make_forecast.
Forecast forecast_of(const System& system, const State& state, const Part& part, const Forecast& before = {});

// Without hand, colliders and wind, at rest in the equilibrium of the forecast.
Scene resting_scene(const System& system, const State& state, const Settings& settings, const Forecast& forecast);

// The equilibrium of the method: its steps from that of the forecast, which must have a slowest mode, with critical damping of this mode.
// None if they diverge.
std::optional<std::vector<Vec3>> settle(const System& system, const State& state, const Settings& settings, const Forecast& forecast,
                                        const Part& part);

}  // namespace hooke
