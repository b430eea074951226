#include "study/remedy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/file_limits.h"
#include "base/number_text.h"
#include "lab/lab.h"

namespace hooke {
namespace {

constexpr double any_gain = std::numeric_limits<double>::infinity();

// The work limit, shared by all copies.
struct Budget {
  double left;
  const std::atomic<bool>& stop;
  bool is_spent() const { return left <= 0.0 || stop; }
};

// Rough cost of a substep in force evaluations.
double relative_cost(const Integrator& method) {
  switch (method.stability) {
    case Stability::AStable:
    case Stability::LStable:
      return 300.0;
    case Stability::EachSpring:
      return 4.0;
    case Stability::Adaptive:
      return 100.0;
    default:
      return method.order > 2 ? 6.0 : 1.0;
  }
}

struct Trial {
  enum class End { Finished, Diverged, GainedEnergy, OutOfBudget };
  End end = End::Finished;
  double seconds = 0.0;  // [s], simulated
};

// [J], the gain beyond the supplied energy
double unexplained_energy(const Scene& scene) { return compute_energy(scene.system, scene.state).total() - scene.state.ledger.net_input; }

// Ends early at a gain of more than `max_energy_gain` of the energy supplied [1].
Trial run_copy(Scene scene, double seconds, double max_energy_gain, Budget& budget) {
  constexpr int checks = 32;
  const double start = scene.state.time;
  const double cost = relative_cost(*scene.settings.integrator) * (scene.system.spring_count() + scene.system.point_count() + 10.0);
  const auto spend = [&] {
    budget.left -= cost;
    return !budget.is_spent();
  };

  Lab lab(std::move(scene), KeepStart::No);
  double lowest = unexplained_energy(lab.scene());
  for (int check = 1; check <= checks; ++check) {
    lab.submit(RunTo{start + seconds * check / checks});
    lab.advance(0.0, spend);
    const double simulated = lab.scene().state.time - start;
    if (lab.status()->snapshot->divergence) return {Trial::End::Diverged, simulated};
    const double energy = unexplained_energy(lab.scene());
    if (!std::isfinite(energy)) return {Trial::End::Diverged, simulated};
    if (energy - lowest > max_energy_gain * lab.scene().state.ledger.scale) return {Trial::End::GainedEnergy, simulated};
    lowest = std::min(lowest, energy);
    if (budget.is_spent()) return {Trial::End::OutOfBudget, simulated};
  }
  return {Trial::End::Finished, seconds};
}

// Whether the scene no longer diverges without some of its parts.
template <class Remove>
bool is_cured_without(const Scene& start, double seconds, Budget& budget, const Remove& remove) {
  Scene scene = start;
  remove(scene);
  return run_copy(std::move(scene), seconds, any_gain, budget).end == Trial::End::Finished;
}

Remedy::Cause find_cause(const Scene& start, double seconds, Budget& budget) {
  using enum Remedy::Cause;
  const Settings& settings = start.settings;
  if (settings.substep() > largest_stable_step(*settings.integrator, bound_spectrum(start.system))) return StepTooLong;

  const System& system = start.system;
  const bool has_forces = std::ranges::any_of(system.forces, &Force::on);
  const bool has_hand = system.grab || start.state.hand.collider || system.scripted_hand;
  if (has_forces && is_cured_without(start, seconds, budget, [](Scene& copy) { copy.system.forces.clear(); })) return Force;
  if (has_hand && is_cured_without(start, seconds, budget, [](Scene& copy) {
        copy.system.grab.reset();
        copy.state.hand.collider.reset();
        copy.system.scripted_hand.reset();
      }))
    return Hand;
  if (!system.colliders.empty() && is_cured_without(start, seconds, budget, [](Scene& copy) {
        copy.system.colliders.clear();
        copy.state.hand.collider.reset();
      }))
    return Contact;
  return Springs;
}

// Settings to try, the most likely and cheapest first: the current method and then the default one, each with ever smaller steps, then the
// methods that are stable at any step.
std::vector<Advice> candidates(const Scene& start) {
  const Settings& settings = start.settings;
  const Spectrum spectrum = bound_spectrum(start.system);
  std::vector<Advice> list;
  const auto add_refinements = [&](const Integrator& method, int min_substeps) {
    const auto limit = min_stable_substeps(method, spectrum, settings.frame_rate);
    if (!limit || method.stability == Stability::None) return;
    constexpr int refinements = 5;
    double substeps = std::max<double>(min_substeps, static_cast<double>(recommended_margin) * *limit);
    for (int i = 0; i < refinements && substeps <= max_substeps; ++i, substeps *= 2.0)
      list.push_back({&method, static_cast<int>(substeps)});
  };
  add_refinements(*settings.integrator, 2 * std::min(settings.substeps, max_substeps / 2));
  if (settings.integrator != &default_integrator()) add_refinements(default_integrator(), settings.substeps);
  for (const Integrator& method : integrators()) {
    const bool is_implicit = method.stability == Stability::LStable || method.stability == Stability::AStable;
    if (!is_implicit || !method.for_production || &method == settings.integrator) continue;
    for (const int substeps : {settings.substeps, 4 * settings.substeps})
      if (substeps <= max_substeps) list.push_back({&method, substeps});
  }
  return list;
}

std::optional<int> linear_limit(const Integrator& method, const Scene& scene) {
  const Spectrum spectrum = bound_spectrum(scene.system);
  if (!std::isfinite(largest_stable_step(method, spectrum))) return std::nullopt;
  return min_stable_substeps(method, spectrum, scene.settings.frame_rate);
}

std::string seconds_text(double seconds) { return quantity_text(seconds, "s", 3); }

}  // namespace

Remedy find_remedy(const Scene& start, double seconds, const std::atomic<bool>& stop, double max_work, const RemedyProgress& progress) {
  const auto report = [&](const std::string& test) {
    if (progress) progress(test);
  };
  // a quarter of the work is for the cause, and no setting takes more than half of the rest
  Remedy remedy;
  Budget diagnosis{0.25 * max_work, stop};
  report("Repeating the run");
  const Trial original = run_copy(start, seconds, any_gain, diagnosis);
  if (original.end != Trial::End::Diverged) return remedy;
  const double frame = 1.0 / start.settings.frame_rate, diverged_after = original.seconds + frame;
  report("Looking for the cause");
  remedy.cause = find_cause(start, diverged_after, diagnosis);

  double left = max_work - (0.25 * max_work - std::max(0.0, diagnosis.left));
  std::optional<Advice> partly_tested;
  for (const Advice& advice : candidates(start)) {
    if (stop || left <= 0.0) break;
    report("Testing " + describe(advice));
    Scene scene = start;
    scene.settings.integrator = advice.integrator;
    scene.settings.substeps = advice.substeps;
    if (advice.integrator->stability != Stability::Adaptive) scene.settings.tolerance.reset();
    Budget budget{0.5 * left, stop};
    const double given = budget.left;
    constexpr double max_energy_gain = 0.02;
    const Trial trial = run_copy(std::move(scene), seconds, max_energy_gain, budget);
    left -= given - std::max(0.0, budget.left);
    ++remedy.settings_tried;
    if (trial.end == Trial::End::Finished) {
      remedy.advice = advice;
      remedy.linear_limit = linear_limit(*advice.integrator, start);
      remedy.tested_seconds = trial.seconds;
      return remedy;
    }
    const bool is_tested = trial.end == Trial::End::OutOfBudget && trial.seconds >= 2.0 * diverged_after;
    if (is_tested && !partly_tested) {
      partly_tested = advice;
      remedy.tested_seconds = trial.seconds;
    }
  }
  remedy.advice = partly_tested;
  if (partly_tested) remedy.linear_limit = linear_limit(*partly_tested->integrator, start);
  return remedy;
}

Remedy find_remedy(const FailedRun& run, const std::atomic<bool>& stop, const RemedyProgress& report) {
  const auto search_from = [&](Scene scene) {
    scene.settings = run.settings;
    const double seconds_to_failure = std::max(0.0, run.time - scene.state.time);
    return find_remedy(scene, 2.0 * seconds_to_failure + 1.0, stop, default_remedy_work, report);
  };
  Remedy remedy = search_from(*run.start);
  if (remedy.cause != Remedy::Cause::NotReproduced || !run.before || stop) return remedy;
  Scene before;
  before.system = *run.system;
  before.state = *run.before;
  remedy = search_from(std::move(before));
  remedy.from = run.before->time;
  return remedy;
}

std::string describe(const Remedy& remedy, const Settings& settings) {
  const auto cause = [&]() -> std::string {
    switch (remedy.cause) {
      case Remedy::Cause::NotReproduced:
        return "No remedy was tested: copies from the start" + (remedy.from ? " and from t = " + seconds_text(*remedy.from) : "") +
               " do not diverge.";
      case Remedy::Cause::StepTooLong:
        return "Cause: the step is beyond the linear stability limit of " + std::string(settings.integrator->label) + ".";
      case Remedy::Cause::Force:
        return "Cause: the listed forces; without them it does not diverge.";
      case Remedy::Cause::Contact:
        return "Cause: contact; without the colliders it does not diverge.";
      case Remedy::Cause::Hand:
        return "Cause: the hand; without it the scene does not diverge.";
      case Remedy::Cause::Springs:
        return "Cause: springs that rotate far within a step; the linear stability limit does not cover them.";
    }
    return {};
  };
  if (remedy.cause == Remedy::Cause::NotReproduced) return cause();
  if (!remedy.advice) return cause() + " No remedy found: " + std::to_string(remedy.settings_tried) + " other settings were tried.";
  // why more substeps than the limit shown below the slider
  std::string margin;
  if (remedy.linear_limit) {
    const double ratio = static_cast<double>(remedy.advice->substeps) / *remedy.linear_limit;
    margin = ", " + number_text(ratio, 2) + " times the linear limit of " + std::to_string(*remedy.linear_limit) +
             (remedy.advice->substeps == recommended_margin * *remedy.linear_limit ? " (a measured margin)" : "") + ",";
  }
  const std::string from = remedy.from ? " from t = " + seconds_text(*remedy.from) : "";
  return cause() + " " + describe(*remedy.advice) + margin + " does not diverge (tested for " + seconds_text(remedy.tested_seconds) + from +
         ").";
}

}  // namespace hooke
