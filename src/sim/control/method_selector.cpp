#include "sim/control/method_selector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/control/automatic.h"
#include "sim/control/constants.h"
#include "sim/control/cost_model.h"
#include "sim/control/frame_error.h"
#include "sim/control/step_controller.h"

namespace hooke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Whether vibrations that are too fast for its step disappear: half the step then agrees on what both lost.
bool damps_vibrations(const Integrator& method) { return method.energy == EnergyTrend::Falls || method.stability == Stability::EachSpring; }

}  // namespace

std::optional<int> min_automatic_substeps(const StepLimits& limits, const Integrator& method, double frame_rate) {
  const Spectrum& spectrum = limits.spectrum();
  const auto min = limits.min_substeps(method, frame_rate);
  if (!min) return std::nullopt;
  double rate = method.splits_dashpots ? spectrum.dashpot_rate : 0.0;
  // contact takes the path of a step for a parabola, which that of a method with many stages need not be
  if (spectrum.contact && method.order > control::parabolic_order) rate = std::max(rate, spectrum.omega);
  const double resolving = std::ceil(rate / frame_rate);
  if (!(std::max<double>(*min, resolving) <= max_automatic_substeps / 4.0)) return std::nullopt;
  return std::max(*min, static_cast<int>(resolving));
}

// One run of the frame, and its cost [ms]; its end is not finite if that is more than `max_cost`.
double MethodSelector::compute(const Scene& scene, const Integrator& method, int substeps, double max_cost, FrameEnd& end) {
  refresh_values(plan_, scene.system);  // restores springs that broke in the run before
  const CostModel model(plan_);
  Settings settings = scene.settings;
  settings.integrator = &method;
  settings.substeps = substeps;
  frame_.begin(plan_, scene.system, settings, scene.state);
  double cost = 0.0;
  while (!frame_.done() && cost <= max_cost) {
    frame_.substep(plan_);
    cost = model.of(method, frame_.motion(), frame_.substeps_done());
  }
  total_cost_ += cost;
  end.is_finite = false;
  if (frame_.done()) set_end(end, frame_, plan_, scene.state, scratch_);
  return cost;
}

// The frame with half of these substeps, and with all.
FrameTrial MethodSelector::attempt(const Scene& scene, const Integrator& method, int substeps, double max_cost) {
  FrameTrial trial{.method = &method};
  runs_.restart(plan_.spectrum.omega);
  for (int n = first_substeps(substeps); runs_.count() < 2; n *= 2) {
    trial.substeps = n;
    trial.cost += compute(scene, method, n, max_cost - trial.cost, runs_.add());
  }
  trial.error = runs_.error(scene.system, method);
  return trial;
}

// Whether the finest run agrees with one of a method that damps nothing, with stable steps; yes if that costs too much.
bool MethodSelector::keeps_vibrations(const Scene& scene, const FrameTrial& trial, double max_cost) {
  const Integrator& exact = default_integrator();
  const auto substeps = min_automatic_substeps(scene.limits, exact, scene.settings.frame_rate);
  if (!substeps || CostModel(plan_).expected(exact, 2 * *substeps) > max_cost) return true;
  compute(scene, exact, std::max(2 * *substeps, trial.substeps), max_cost, with_all_);
  return !with_all_.is_finite || weighted_distance(scene.system, with_all_.position, runs_.finest().position, 1.0).rms <= scene.share;
}

std::vector<MethodSelector::Candidate> MethodSelector::candidates_for(const StepLimits& limits, double frame_rate) const {
  const CostModel model(plan_);
  std::vector<Candidate> list;
  for (const Integrator& method : integrators()) {
    if (!method.for_production || method.stability == Stability::Adaptive) continue;
    const auto min = min_automatic_substeps(limits, method, frame_rate);
    if (!min) continue;
    list.push_back({.method = &method, .substeps = 2 * *min, .cost = control::cost_of_estimate * model.expected(method, 2 * *min)});
  }
  return list;
}

// The candidate that would be the cheapest if its next attempt met the share comes first; after an attempt that does not, its order says
// how many substeps may.
FrameTrial MethodSelector::select(const Plan& plan, const System& system, const Settings& settings, const State& state,
                                  const StepLimits& limits, double share, double max_cost) {
  plan_ = plan;
  const Scene scene{system, settings, state, limits, share};
  std::vector<Candidate> candidates = candidates_for(limits, settings.frame_rate);
  FrameTrial best{.error = infinity, .cost = max_cost};
  bool is_met = false;
  const double start = total_cost_;
  while (total_cost_ - start <= max_cost) {
    const auto next = std::ranges::min_element(candidates, {}, &Candidate::cost);
    if (next == candidates.end() || !(next->cost < best.cost)) break;
    const FrameTrial trial = attempt(scene, *next->method, next->substeps, best.cost);
    const bool is_small = is_accepted(trial.error, share);
    const bool meets = is_small && (!damps_vibrations(*trial.method) || keeps_vibrations(scene, trial, max_cost));
    if (meets ? !is_met || trial.cost < best.cost : !is_met && trial.error < best.error) {
      best = {trial.method, trial.substeps, trial.error, meets ? trial.cost : max_cost};
      is_met = meets;
    }
    const int order = order_of(system, *trial.method, runs_.finest());
    const int more = refined_substeps({.substeps = trial.substeps, .error = trial.error, .order = order}, share);
    if (is_small || more > max_automatic_substeps || ++next->attempts > control::max_rejections) {
      candidates.erase(next);
      continue;
    }
    next->substeps = more;
    next->cost = trial.cost * more / trial.substeps;
  }
  return best;
}

}  // namespace hooke
