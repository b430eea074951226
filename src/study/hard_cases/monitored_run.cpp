#include "study/hard_cases/monitored_run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "scene/step_advice.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

std::atomic<bool> interrupted = false;

constexpr double round_off = 1e-9;
constexpr int frames_per_estimate = 20;

Scene make_scene(const TestNetwork& network, const Settings& settings) {
  Scene scene;
  scene.name = "hard case";
  scene.system = network.system;
  scene.state = network.state;
  scene.settings = settings;
  if (is_automatic(settings) && !settings.tolerance) scene.settings.tolerance = automatic_case_tolerance;
  return scene;
}

// "diverged at 0.3 s: ...", if the last good state was kept and the status reports what diverged and where; else nothing.
std::string describe_stop(Lab& lab, const State& before) {
  lab.publish();
  const Status& status = *lab.status();
  const System& system = lab.scene().system;
  const auto& divergence = status.snapshot->divergence;
  const bool named = divergence && (divergence->point || system.point_count() == 0) && (divergence->spring || system.spring_count() == 0);
  const bool kept = lab.scene().state.position == before.position && lab.scene().state.velocity == before.velocity && is_finite(before);
  if (!named || !kept || status.diagnosis.message.empty()) return {};

  constexpr std::array kinds{"infinite or NaN",           "energy gain",     "implausible distance", "no feasible step", "no feasible step",
                             "too many pairs in contact", "matrix too large"};
  std::string name = formatted("diverged at %.3g s: %s", divergence->time, kinds[static_cast<std::size_t>(divergence->kind)]);
  if (divergence->point) name += ", point " + std::to_string(system.index_of(*divergence->point));
  if (divergence->spring) name += ", spring " + std::to_string(system.index_of(*divergence->spring));
  return name;
}

double largest_step(const MonitoredRun& run) { return StepLimits(bound_spectrum(run.system())).stable_step(*run.settings().integrator); }

bool exceeds_stable_step(const MonitoredRun& run, double largest) { return run.settings().substep() > largest * (1.0 + round_off); }

}  // namespace

void set_interrupted(bool stop) { interrupted = stop; }

MonitoredRun::MonitoredRun(const TestNetwork& network, const Settings& settings, const Tolerance& tolerance)
    : lab_(make_scene(network, settings)), tolerance_(tolerance) {
  monitor_.emplace(lab_.plan(), this->settings(), system(), state(), std::isfinite(tolerance.position) ? frames_per_estimate : 0);
}

bool MonitoredRun::frame() {
  if (interrupted) throw Interrupted{};
  if (stopped_) return false;

  // apply queued edits before the estimate: they belong to its frame
  if (monitor_->estimate_is_due()) lab_.advance(0.0, [] { return true; });
  monitor_->begin_frame(system(), settings(), state());
  const State before = state();
  if (!lab_.step()) {
    stopped_ = true;
    stop_reason_ = describe_stop(lab_, before);
    return false;
  }
  missed_.add_frame(settings(), state());
  monitor_->end_frame(lab_.plan(), settings(), system(), state(), lab_.last_frame().motion());
  return true;
}

bool MonitoredRun::run(double seconds) {
  const long frames = std::lround(seconds * settings().frame_rate);
  for (long i = 0; i < frames; ++i)
    if (!frame()) return false;
  return true;
}

std::string MonitoredRun::report() const {
  if (stopped_) return stop_reason_;
  const double largest = largest_step(*this);
  if (largest == 0.0) return "status: no step is stable";
  if (exceeds_stable_step(*this, largest))
    return formatted("status: the step is %.2g times the largest stable one", settings().substep() / largest);
  if (std::string warning = missed_.warning(); !warning.empty()) return warning;
  const std::vector<std::string> warnings = monitor_->warnings(tolerance_);
  return warnings.empty() ? "" : warnings.front();
}

Settings settings_for(const Integrator& method, const System& system, const Stepping& stepping) {
  Settings settings{.integrator = &method, .substeps = stepping.min};
  if (is_stable_at_any_step(method)) {
    settings.substeps = stepping.free;
  } else if (const auto fewest = StepLimits(bound_spectrum(system)).stable_substeps(method, settings.frame_rate * stepping.fraction)) {
    if (*fewest <= stepping.max) settings.substeps = std::max(stepping.min, *fewest);
  }
  return settings;
}

bool is_stable_at_any_step(const Integrator& method) {
  return method.stability == Stability::EachSpring || method.stability == Stability::AStable || method.stability == Stability::LStable;
}

Expectation expectation_of(const MonitoredRun& run) {
  const Integrator& method = *run.settings().integrator;
  const bool has_many_springs = run.system().spring_count() > 1;
  const bool fast = run.settings().substep() * bound_spectrum(run.system()).omega > 2.0;
  const bool has_no_guarantee =
      has_many_springs && (method.stability == Stability::EachSpring || (method.stability == Stability::AStable && fast));
  return has_no_guarantee || exceeds_stable_step(run, largest_step(run)) ? Expectation::HoldOrReport : Expectation::Hold;
}

Verdict judge(const MonitoredRun& run, Expectation expected, bool met, std::string measured) {
  Verdict verdict{.expected = expected, .measured = std::move(measured)};
  if (met && !run.stopped()) return verdict;
  verdict.reason = run.report();
  verdict.outcome = verdict.reason.empty() ? Outcome::FailedSilently : Outcome::FailedOpenly;
  if (run.stopped()) verdict.measured.clear();
  return verdict;
}

Verdict judge(const MonitoredRun& run, bool met, std::string measured) { return judge(run, expectation_of(run), met, std::move(measured)); }

}  // namespace hooke
