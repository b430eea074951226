// Determines why a run diverged, and a setting that does not diverge, by running copies of the scene.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "lab/status.h"
#include "scene/scene.h"
#include "scene/step_advice.h"
#include "sim/control/frame_runner.h"

namespace hooke {

// A setting that was run on a copy and did not diverge.
struct TestedSetting {
  Advice advice;
  double seconds = 0.0;   // [s], simulated with it
  double duration = 0.0;  // [s], that a simulated second of it takes, by the model of TrialWork
  // That `hooke run` prints with it: about its step, and of the run monitor about the test with it. Only where every setting that does not
  // diverge has some.
  std::vector<std::string> warnings;
};

struct Remedy {
  enum class Cause {
    NotReproduced,  // the run from this state did not diverge again
    SearchLimit,    // the work limit was reached before it did
    StepTooLong,    // beyond the linear stability limit
    Force,          // stable without the listed forces
    Contact,        // stable without colliders and contact between points
    Hand,           // stable without the hand
    Springs,        // stable without springs, and within the linear limit, which does not cover springs that rotate far
    NotFound,       // diverges without each of these, or the work limit was reached
  };
  Cause cause = Cause::NotReproduced;
  std::optional<TestedSetting> cheapest;     // of any method; none if none was found
  std::optional<TestedSetting> same_method;  // of the present one, if it is another setting
  std::optional<TestedSetting> untested;     // of the present one: too expensive to be tested as long as the divergence took
  int settings_tried = 0;
  int settings_cut_short = 0;  // of those: by the work limit, before they diverged
  int settings_left = 0;       // not tried, because the work limit was reached
  double reached = 0.0;        // [s], where the cause is SearchLimit: the time that the copy had reached
  std::optional<double> from;  // [s], of the recorded state that the copies started from; none: the start of the run
  // The edit to which the divergence is due: with what it changed as it was before, a copy ran through for as long as with the advice.
  std::optional<RecentChange> change{};
};

// The work of stepping a copy of a scene, from counts: the same on every machine.
class TrialWork {
 public:
  // Of the coming frames; they may still change the plan.
  explicit TrialWork(const Plan& plan) : plan_(plan) {}
  // [ns], approximately, of what was computed since the last call: of the frame in progress or, at its end, of the rest of it. To be called
  // after every substep, and with `is_finished` after the frame.
  double since_last(const FrameRunner& frame, bool is_finished);

 private:
  const Plan& plan_;
  double counted_ = 0.0, trials_ = 0.0;  // [ns], of this frame; of the trials of `auto`, in all frames
  long calls_ = 0;                       // in this frame
};

// [ns], a limit on the work of all copies of one search, by a fixed model of what it takes: the same on every machine, of which the default
// takes a second or two.
inline constexpr double default_remedy_work = 1.5e9;

// Whether a search for a remedy may reach a divergence that is so many frames after its start. A bound: for a scene that is too large for
// that it is false, for another one it may be true without reason.
bool may_reach(double frames, double points, double springs);

// Receives what is being tested: "Testing Velocity Verlet with 80 substeps per frame". Called on the thread of the search.
using RemedyProgress = std::function<void(const std::string& test)>;

// Runs copies of `start` (a state before the divergence, best the start of the run) with its own settings, without its forces,
// contact and hand, and with other settings: each for `seconds` or until the divergence. A setting is accepted when it neither diverges nor
// is warned about, as by `hooke run`, for `seconds`; if there is none, one that is only warned that its step may be too long; then likewise
// where the work allows less, for at least twice the time that the divergence took; then one with warnings about what went wrong. Never one
// with which the energy rises by more than was supplied. Of those, the cheapest counts. Deterministic. Can run on any
// thread; `stop` ends it early.
Remedy find_remedy(const Scene& start, double seconds, const std::atomic<bool>& stop, double max_work = default_remedy_work,
                   const RemedyProgress& report = {});

// From the last recorded state before the energy grew or, where there is none or it does not diverge again, from the start of the run: up
// to two searches, and one to find the edit that the divergence is due to, if it is due to one.
Remedy find_remedy(const FailedRun& run, const std::atomic<bool>& stop, const RemedyProgress& report = {});

// "0.59\u00d7 real time" between these; empty for settings that are faster than that.
std::string speed_text(const TestedSetting& setting, const char* before = "", const char* after = "");

// What to do, as a sentence: "Use Velocity Verlet with 80 substeps per frame, which does not diverge (tested for 2 s): ...".
std::string describe(const Remedy& remedy, const Settings& settings);

}  // namespace hooke
