#include "lab/hard_cases/watched_run.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <glm/geometric.hpp>

#include "lab/diagnosis.h"
#include "sim/divergence.h"
#include "sim/frame_error.h"

namespace hooke {
namespace {

constexpr double round_off = 1e-9;

Scene make_scene(const Draft& draft, const Settings& settings) {
  Scene scene;
  scene.name = "hard case";
  scene.system = draft.system;
  scene.state = draft.state;
  scene.settings = settings;
  return scene;
}

// [W], taken by dashpots and drag.
double dissipated_power(const System& system, const State& state) {
  double power = 0.0;
  const double drag = system.drag_rate();
  for (Index i = 0; drag > 0.0 && i < system.point_count(); ++i)
    if (!system.points()[i].nailed) power += drag * system.points()[i].mass * glm::dot(state.velocity[i], state.velocity[i] - system.wind);
  for (const Spring& spring : system.springs()) {
    const double damping = system.damping_of(spring);
    if (damping == 0.0) continue;
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const Vec3 along = state.position[i] - state.position[j];
    const double length = glm::length(along);
    if (length == 0.0) continue;
    const double approach = glm::dot(state.velocity[i] - state.velocity[j], along) / length;
    power += damping * approach * approach;
  }
  return power;
}

// The last good state is kept, and the status names what broke, where, and what would hold.
bool is_open(Lab& lab, const State& before) {
  lab.publish();
  const Status& status = *lab.status();
  const System& system = lab.scene().system;
  const auto& divergence = status.snapshot->divergence;
  const bool named = divergence && (divergence->point || system.point_count() == 0) && (divergence->spring || system.spring_count() == 0);
  const bool kept = lab.scene().state.position == before.position && lab.scene().state.velocity == before.velocity && is_finite(before);
  return named && kept && !status.message.empty() && status.advice;
}

std::string name_stop(const Divergence& divergence, const System& system) {
  std::string where;
  if (divergence.point) where += ", point " + std::to_string(system.index_of(*divergence.point));
  if (divergence.spring) where += ", spring " + std::to_string(system.index_of(*divergence.spring));
  const bool numbers = divergence.kind == Divergence::Kind::NotFinite;
  return text("stopped by the watch at %.3g s: %s", divergence.time, numbers ? "beyond all numbers" : "energy from nowhere") + where;
}

bool is_beyond_limit(const WatchedRun& run, double largest) { return run.settings().substep() > largest * (1.0 + round_off); }

}  // namespace

WatchedRun::WatchedRun(const Draft& draft, const Settings& settings) : lab_(make_scene(draft, settings)) {
  start_energy_ = lowest_energy_ = energy_less_given();
  power_ = dissipated_power(system(), state());
}

double WatchedRun::energy_less_given() const { return compute_energy(system(), state()).total() - state().ledger.given; }

bool WatchedRun::frame() {
  if (stopped_) return false;
  const State before = state();
  if (!lab_.step()) {
    stopped_ = true;
    stopped_openly_ = is_open(lab_, before);
    return false;
  }
  ++frames_;
  unconverged_solves_ += lab_.last_frame().motion().unconverged_solves;

  const double energy = energy_less_given(), power = dissipated_power(system(), state());
  largest_rise_ = std::max(largest_rise_, energy - lowest_energy_);
  lowest_energy_ = std::min(lowest_energy_, energy);
  dissipated_ += 0.5 * (power_ + power) * (state().time - before.time);
  power_ = power;
  return true;
}

bool WatchedRun::run(double seconds) {
  const long frames = std::lround(seconds * settings().frame_rate);
  for (long i = 0; i < frames; ++i)
    if (!frame()) return false;
  return true;
}

double WatchedRun::unaccounted_energy() const {
  return (energy_less_given() + dissipated_ - start_energy_) / state().ledger.scale;
}

std::string WatchedRun::report(const Tolerance& tolerance) const {
  if (stopped_) return stopped_openly_ ? name_stop(*lab_.status()->snapshot->divergence, system()) : "";

  const double largest = largest_stable_step(*settings().integrator, bound_spectrum(system()));
  if (is_beyond_limit(*this, largest))
    return largest == 0.0 ? "its status: no step is stable" : text("its status: the step is %.2g times the largest stable one", settings().substep() / largest);
  if (!all_solves_converged()) return text("%ld solves did not converge", unconverged_solves_);
  if (system().colliders.empty() && std::abs(unaccounted_energy()) > tolerance.energy)
    return text("its energy balance: %+.2g of what was put in", unaccounted_energy());
  if (std::isfinite(tolerance.position)) {
    const double error = estimate_frame_error(system(), settings(), state());
    if (error * static_cast<double>(frames_) > tolerance.position) return text("its estimate of the error: %.1g m a frame", error);
  }
  return {};
}

Settings settings_for(const Integrator& method, const System& system, const Stepping& stepping) {
  Settings settings{.integrator = &method, .substeps = stepping.least};
  if (takes_any_step(method)) {
    settings.substeps = stepping.free;
  } else if (const auto fewest = fewest_stable_substeps(method, bound_spectrum(system), settings.frame_rate * stepping.share)) {
    if (*fewest <= stepping.most) settings.substeps = std::max(stepping.least, *fewest);
  }
  return settings;
}

bool takes_any_step(const Integrator& method) {
  return method.stability == Stability::EachSpring || method.stability == Stability::Absolute || method.stability == Stability::Stiff;
}

Expectation expectation_of(const WatchedRun& run) {
  const Integrator& method = *run.settings().integrator;
  const bool together = method.stability == Stability::EachSpring && run.system().spring_count() > 1;
  const bool beyond = is_beyond_limit(run, largest_stable_step(method, bound_spectrum(run.system())));
  return beyond || together ? Expectation::HoldOrReport : Expectation::Hold;
}

Verdict judge(const WatchedRun& run, Expectation expected, bool met, std::string measured, const Tolerance& tolerance) {
  Verdict verdict{.expected = expected, .measured = std::move(measured)};
  if (met && !run.stopped()) return verdict;
  verdict.reason = run.report(tolerance);
  verdict.outcome = verdict.reason.empty() ? Outcome::FailedSilently : Outcome::FailedOpenly;
  if (run.stopped()) verdict.measured.clear();
  return verdict;
}

Verdict judge(const WatchedRun& run, bool met, std::string measured, const Tolerance& tolerance) {
  return judge(run, expectation_of(run), met, std::move(measured), tolerance);
}

std::string text(const char* pattern, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

}  // namespace hooke
