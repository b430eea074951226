#include "study/remedy/remedy.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "base/file_limits.h"
#include "base/number_text.h"
#include "edit/apply.h"
#include "lab/lab.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "study/remedy/trial_work.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

// The work limit, shared by all copies.
struct Budget {
  double left;  // [ns]
  const std::atomic<bool>& stop;
  bool is_spent() const { return left <= 0.0 || stop; }
};

bool is_unconditionally_stable(const Integrator& method) {
  return method.stability == Stability::LStable || method.stability == Stability::AStable;
}

struct Trial {
  enum class End { Finished, Diverged, OutOfBudget };
  End end = End::Finished;
  double seconds = 0.0;                    // [s], simulated
  std::vector<std::string> step_warnings;  // before the run
  std::vector<std::string> warnings;       // of the run monitor
  double work = 0.0;                       // [ns]
  bool gains = false;                      // more energy than was supplied
  bool has_warnings() const { return !step_warnings.empty() || !warnings.empty(); }
  std::vector<std::string> all_warnings() const {
    std::vector<std::string> all = step_warnings;
    all.insert(all.end(), warnings.begin(), warnings.end());
    return all;
  }
};

struct BudgetIsSpent {};

// Of a remedy, relative to the energy supplied: less than what counts as a divergence, but no motion that anyone wants.
constexpr double max_rise = 1.0;

// Of the work of a search: to repeat the divergence and to find its cause.
constexpr double share_of_diagnosis = 0.25;

// Frame by frame, with the warnings and the monitor of `hooke run`.
Trial run_copy(Scene scene, double seconds, Budget& budget) {
  const double start = scene.state.time, given = budget.left;
  const long frames = std::lround(std::ceil(seconds * scene.settings.frame_rate * (1.0 - 1e-9)));
  Trial trial;
  for (const auto& warning : {unused_setting_warning(scene.settings), step_warning(scene.system, scene.state, scene.settings),
                              oscillation_warning(scene.system, scene.settings)})
    if (warning) trial.step_warnings.push_back(*warning);
  Lab lab(std::move(scene), KeepStart::No);
  TrialWork work(lab.plan());
  lab.watch_substeps([&] {
    budget.left -= work.since_last(lab.last_frame(), false);
    if (budget.is_spent()) throw BudgetIsSpent{};
  });
  RunMonitor monitor(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state, 0);
  const auto ended = [&](Trial::End end) {
    trial.end = end;
    trial.seconds = end == Trial::End::Finished ? seconds : lab.scene().state.time - start;
    trial.warnings = monitor.warnings({});
    trial.work = given - budget.left;
    trial.gains = !(monitor.energy_rise() <= max_rise);
    return trial;
  };
  try {
    for (long frame = 0; frame < frames; ++frame) {
      monitor.begin_frame(lab.scene().system, lab.scene().settings, lab.scene().state);
      const bool is_diverged = !lab.step();
      budget.left -= work.since_last(lab.last_frame(), true);
      if (is_diverged) return ended(Trial::End::Diverged);
      monitor.end_frame(lab.plan(), settings_used(lab.scene().settings, lab.scene().state), lab.scene().system, lab.scene().state,
                        lab.last_frame().motion());
    }
  } catch (const BudgetIsSpent&) {
    return ended(Trial::End::OutOfBudget);
  }
  return ended(Trial::End::Finished);
}

// Whether the scene no longer diverges without some of its parts.
template <class Remove>
bool is_cured_without(const Scene& start, double seconds, Budget& budget, const Remove& remove) {
  Scene scene = start;
  remove(scene);
  return run_copy(std::move(scene), seconds, budget).end == Trial::End::Finished;
}

Remedy::Cause find_cause(const Scene& start, double seconds, Budget& budget) {
  using enum Remedy::Cause;
  const Settings& settings = start.settings;
  const bool has_own_steps = settings.integrator->stability == Stability::Adaptive;
  if (!has_own_steps && settings.substep() > StepLimits(bound_spectrum(start.system)).stable_step(*settings.integrator)) return StepTooLong;

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
  if (has_contact(system) && is_cured_without(start, seconds, budget, [](Scene& copy) {
        copy.system.colliders.clear();
        copy.system.contact = {};
        copy.state.hand.collider.reset();
      }))
    return Contact;
  if (system.spring_count() > 0 && is_cured_without(start, seconds, budget, [](Scene& copy) { copy.system.set_springs({}); }))
    return Springs;
  return NotFound;
}

// At least so many substeps, and those that resolve the oscillations of the colliders, if there are not too many.
int resolving_oscillations(const StepNeeds& needs, const Integrator& method, double frame_rate, int substeps) {
  return std::max(substeps, StepLimits({}, {.oscillation = needs.oscillation}).resolving_substeps(method, frame_rate).value_or(1));
}

// Settings to try, the most likely and cheapest first: the current method and then the default one, each with ever smaller steps, then the
// methods that are stable at any step, and those that choose their steps: these first where no number of substeps resolves a passage.
std::vector<Advice> candidates(const Scene& start) {
  const Settings& settings = start.settings;
  const StepNeeds needs = step_needs(start.system, start.state);
  const StepLimits limits(bound_spectrum(start.system), needs);
  std::vector<Advice> list;
  const auto add_refinements = [&](const Integrator& method, int min_substeps) {
    const auto limit = limits.stable_substeps(method, settings.frame_rate);
    const auto resolving = limits.resolving_substeps(method, settings.frame_rate);
    if (!limit || !resolving || method.stability == Stability::None) return;
    constexpr int refinements = 5;
    double substeps =
        std::max({static_cast<double>(min_substeps), static_cast<double>(needs.margin) * *limit, static_cast<double>(*resolving)});
    for (int i = 0; i < refinements && substeps <= max_substeps; ++i, substeps *= 2.0)
      list.push_back({&method, static_cast<int>(substeps)});
  };
  const auto add_adaptive = [&] {
    for (const Integrator& method : integrators())
      if (method.stability == Stability::Adaptive && method.for_production && &method != settings.integrator)
        list.push_back({&method, settings.substeps});
  };
  const bool is_for_adaptive = !limits.resolving_substeps(default_integrator(), settings.frame_rate);
  if (is_for_adaptive) add_adaptive();
  if (!is_automatic(settings)) add_refinements(*settings.integrator, 2 * std::min(settings.substeps, max_substeps / 2));
  if (settings.integrator != &default_integrator()) add_refinements(default_integrator(), settings.substeps);
  for (const Integrator& method : integrators()) {
    if (!is_unconditionally_stable(method) || !method.for_production || &method == settings.integrator) continue;
    std::vector<int> numbers{settings.substeps, std::min(max_substeps, 4 * settings.substeps)};
    // listed forces that are not part of its linear system may limit its step
    if (const auto limit = limits.stable_substeps(method, settings.frame_rate); limit && *limit > numbers.back())
      numbers.push_back(std::min(max_substeps, 2 * *limit));
    for (const int substeps : numbers) {
      const Advice advice{&method, resolving_oscillations(needs, method, settings.frame_rate, substeps)};
      if (list.empty() || list.back() != advice) list.push_back(advice);
    }
  }
  if (!is_for_adaptive) add_adaptive();
  return list;
}

// The newest edit without which the run from this state does not diverge.
std::optional<RecentChange> find_change(const Scene& from, const std::vector<RecentChange>& changes, double seconds,
                                        const std::atomic<bool>& stop, const RemedyProgress& progress) {
  constexpr std::size_t max_tested = 4;
  for (std::size_t i = 0; i < std::min(changes.size(), max_tested) && !stop; ++i) {
    if (progress) progress("Testing the scene without \"" + changes[i].text + "\"");
    Scene scene = from;
    for (const Command& command : changes[i].restore) {
      Effect effect;
      apply(scene, command, effect);
    }
    Budget budget{0.25 * default_remedy_work, stop};
    if (run_copy(std::move(scene), seconds, budget).end == Trial::End::Finished) return changes[i];
  }
  return std::nullopt;
}

// With its warnings, if every one has some.
std::optional<std::pair<Advice, std::vector<std::string>>> find_implicit(const Scene& from, double seconds, const std::atomic<bool>& stop,
                                                                         const RemedyProgress& progress) {
  // the most accurate first
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (is_unconditionally_stable(method) && method.for_production && &method != from.settings.integrator) methods.push_back(&method);
  std::ranges::stable_sort(methods, [](const Integrator* a, const Integrator* b) {
    return std::pair(a->stability == Stability::LStable, a->order) > std::pair(b->stability == Stability::LStable, b->order);
  });
  const StepNeeds needs = step_needs(from.system, from.state);
  std::optional<std::pair<Advice, std::vector<std::string>>> warned;
  for (const Integrator* one : methods) {
    if (stop) break;
    const Integrator& method = *one;
    const Advice advice{&method, resolving_oscillations(needs, method, from.settings.frame_rate, from.settings.substeps)};
    if (progress) progress("Testing " + describe(advice));
    Scene scene = from;
    scene.settings.integrator = &method;
    scene.settings.substeps = advice.substeps;
    Budget budget{0.25 * default_remedy_work, stop};
    const Trial trial = run_copy(std::move(scene), seconds, budget);
    if (trial.end != Trial::End::Finished || trial.gains) continue;
    if (!trial.has_warnings()) return std::pair(advice, trial.all_warnings());
    if (!warned) warned = {advice, trial.all_warnings()};
  }
  return warned;
}

std::optional<int> linear_limit(const Integrator& method, const Scene& scene) {
  const StepLimits limits(bound_spectrum(scene.system));
  if (!std::isfinite(limits.stable_step(method))) return std::nullopt;
  return limits.stable_substeps(method, scene.settings.frame_rate);
}

std::string seconds_text(double seconds) { return quantity_text(seconds, "s", 3); }

}  // namespace

bool may_reach(double frames, double points, double springs) {
  return work_beside_substeps(points, springs, frames) <= share_of_diagnosis * default_remedy_work;
}

Remedy find_remedy(const Scene& start, double seconds, const std::atomic<bool>& stop, double max_work, const RemedyProgress& progress) {
  const auto report = [&](const std::string& test) {
    if (progress) progress(test);
  };
  // a quarter of the work is for the cause, and no setting takes more than half of the rest
  Remedy remedy;
  Budget diagnosis{share_of_diagnosis * max_work, stop};
  report("Repeating the run");
  const Trial original = run_copy(start, seconds, diagnosis);
  if (original.end == Trial::End::OutOfBudget) {
    remedy.cause = Remedy::Cause::SearchLimit;
    remedy.reached = start.state.time + original.seconds;
  }
  if (original.end != Trial::End::Diverged) return remedy;
  const double frame = 1.0 / start.settings.frame_rate, diverged_after = original.seconds + frame;
  report("Looking for the cause");
  remedy.cause = find_cause(start, diverged_after, diagnosis);

  double left = max_work - (share_of_diagnosis * max_work - std::max(0.0, diagnosis.left));
  // in the order of preference: no warning for as long as the work allowed, only one about the step, and any other
  enum Rank { PartlyTested, StepWarning, OtherWarning, Ranks };
  std::optional<std::pair<Advice, Trial>> kept[Ranks];
  const auto recommend = [&](const Advice& advice, const Trial& trial) {
    remedy.advice = advice;
    remedy.linear_limit = linear_limit(*advice.integrator, start);
    remedy.has_recommended_margin =
        remedy.linear_limit && advice.substeps == recommended_margin(start.system, start.state) * *remedy.linear_limit;
    remedy.tested_seconds = trial.seconds;
    remedy.duration = trial.seconds > 0.0 ? 1e-9 * trial.work / trial.seconds : 0.0;
    remedy.warnings = trial.all_warnings();
    return remedy;
  };
  const Integrator* cut_short = nullptr;  // the method whose last test was
  for (const Advice& advice : candidates(start)) {
    if (stop) break;
    // more substeps would take longer still
    if (left <= 0.0 || advice.integrator == cut_short) {
      ++remedy.settings_left;
      continue;
    }
    report("Testing " + describe(advice));
    Scene scene = start;
    scene.settings.integrator = advice.integrator;
    scene.settings.substeps = advice.substeps;
    if (advice.integrator->stability != Stability::Adaptive) scene.settings.tolerance.reset();
    Budget budget{0.5 * left, stop};
    const double given = budget.left;
    const Trial trial = run_copy(std::move(scene), seconds, budget);
    left -= given - std::max(0.0, budget.left);
    ++remedy.settings_tried;
    cut_short = trial.end == Trial::End::OutOfBudget ? advice.integrator : nullptr;
    if (cut_short != nullptr) ++remedy.settings_cut_short;
    const bool is_tested =
        trial.end == Trial::End::Finished || (trial.end == Trial::End::OutOfBudget && trial.seconds >= 2.0 * diverged_after);
    if (!is_tested || trial.gains) continue;
    if (trial.end == Trial::End::Finished && !trial.has_warnings()) return recommend(advice, trial);
    const Rank rank = !trial.has_warnings() ? PartlyTested : trial.warnings.empty() ? StepWarning : OtherWarning;
    if (!kept[rank]) kept[rank] = {advice, trial};
  }
  for (const auto& one : kept)
    if (one) return recommend(one->first, one->second);
  return remedy;
}

Remedy find_remedy(const FailedRun& run, const std::atomic<bool>& stop, const RemedyProgress& report) {
  const auto search_from = [&](Scene scene) {
    scene.settings = run.settings;
    const double seconds_to_failure = std::max(0.0, run.time - scene.state.time);
    return find_remedy(scene, 2.0 * seconds_to_failure + 1.0, stop, default_remedy_work, report);
  };
  // with the present settings in every copy
  Scene from = *run.start;
  Remedy remedy;
  const bool has_state_between = run.before && run.before->time > run.start->state.time;
  if (has_state_between) {
    from.system = *run.system;
    from.state = *run.before;
    remedy = search_from(from);
    remedy.from = run.before->time;
  }
  if (remedy.cause == Remedy::Cause::NotReproduced && !stop) {
    from = *run.start;
    remedy = search_from(from);
    // which states were tried
    if (remedy.cause == Remedy::Cause::NotReproduced && has_state_between) remedy.from = run.before->time;
  }
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return remedy;
  from.settings = run.settings;
  const double seconds = 2.0 * std::max(0.0, run.time - from.state.time) + 1.0;
  remedy.change = find_change(from, run.changes, seconds, stop, report);
  const bool is_implicit = remedy.advice && is_unconditionally_stable(*remedy.advice->integrator);
  if (is_implicit) return remedy;
  if (auto found = find_implicit(from, seconds, stop, report)) std::tie(remedy.implicit, remedy.implicit_warnings) = *std::move(found);
  return remedy;
}

namespace {

// The warnings in quotation marks, since they have semicolons; empty without warnings.
std::string exceptions(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) text += (text.empty() ? "" : ", ") + ("\"" + warning + "\"");
  if (text.empty()) return text;
  return (warnings.size() == 1 ? ", but there is a warning: " : ", but there are warnings: ") + text;
}

}  // namespace

std::string describe(const Remedy& remedy, const Settings& settings) {
  const auto cause = [&]() -> std::string {
    if (remedy.change) return "Cause: " + remedy.change->text + "; without this change it does not diverge.";
    switch (remedy.cause) {
      case Remedy::Cause::NotReproduced:
        return "No remedy was tested: copies from the start" + (remedy.from ? " and from t = " + seconds_text(*remedy.from) : "") +
               " do not diverge.";
      case Remedy::Cause::SearchLimit:
        return "No remedy was tested: the work limit of the search was reached at t = " + seconds_text(remedy.reached) +
               ", before the copy from " + (remedy.from ? "t = " + seconds_text(*remedy.from) : "the start") + " diverged.";
      case Remedy::Cause::StepTooLong:
        return "Cause: the step is beyond the linear stability limit of " + std::string(settings.integrator->label) + ".";
      case Remedy::Cause::Force:
        return "Cause: the listed forces; without them it does not diverge.";
      case Remedy::Cause::Contact:
        return "Cause: contact; without it the scene does not diverge.";
      case Remedy::Cause::Hand:
        return "Cause: the hand; without it the scene does not diverge.";
      case Remedy::Cause::Springs:
        return "Cause: springs that rotate far within a step; the linear stability limit does not cover them.";
      case Remedy::Cause::NotFound:
        return "The cause was not found.";
    }
    return {};
  };
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return cause();
  if (!remedy.advice) {
    const std::string tried = " other settings were tried" + std::string(remedy.change || remedy.implicit ? " without success" : "");
    const std::string found = remedy.implicit ? " With " + std::string(remedy.implicit->integrator->label) + " it does not diverge" +
                                                    exceptions(remedy.implicit_warnings) + "."
                                              : "";
    std::string cut_short;
    if (remedy.settings_cut_short > 0)
      cut_short = ", " + std::to_string(remedy.settings_cut_short) + " of them only up to the work limit of the search";
    if (remedy.settings_left > 0) cut_short += "; " + std::to_string(remedy.settings_left) + " more were not, because of that limit";
    return cause() + (remedy.change || remedy.implicit ? " " : " No remedy found: ") + std::to_string(remedy.settings_tried) + tried +
           cut_short + "." + found;
  }
  // why more substeps than the limit shown below the slider; a step beyond it has a warning of its own
  std::string margin;
  if (remedy.linear_limit && remedy.advice->substeps >= *remedy.linear_limit) {
    const double ratio = static_cast<double>(remedy.advice->substeps) / *remedy.linear_limit;
    margin = ", " + number_text(ratio, 2) + " times the linear limit of " + std::to_string(*remedy.linear_limit) +
             (remedy.has_recommended_margin ? " (a measured margin)" : "") + ",";
  }
  const std::string from = remedy.from ? " from t = " + seconds_text(*remedy.from) : "";
  constexpr double max_practical = 10.0;  // [s], of computing per simulated second
  const std::string duration =
      remedy.duration > max_practical ? "; a simulated second takes about " + quantity_text(std::round(remedy.duration), "s", 2) : "";
  return cause() + " " + describe(*remedy.advice) + margin + " does not diverge (tested for " + seconds_text(remedy.tested_seconds) + from +
         duration + ")" + exceptions(remedy.warnings) + ".";
}

}  // namespace hooke
