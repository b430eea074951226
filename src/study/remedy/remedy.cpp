#include "study/remedy/remedy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/file_limits.h"
#include "edit/command.h"
#include "lab/lab.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

constexpr double work_of_frame = 2000.0, work_of_point = 100.0, work_of_spring = 10.0;  // [ns], beside that of the substeps

// The work limit, shared by all copies.
struct Budget {
  double left;  // [ns]
  const std::atomic<bool>& stop;
  bool is_spent() const { return left <= 0.0 || stop; }
};

bool has_no_longest_step(const Integrator& method) {
  return method.stability == Stability::LStable || method.stability == Stability::AStable || method.stability == Stability::EachSpring;
}

struct Trial {
  enum class End { Finished, Diverged, OutOfBudget };
  End end = End::Finished;
  double seconds = 0.0;               // [s], simulated in whole frames
  std::vector<std::string> warnings;  // before the run, and of the run monitor
  bool went_wrong = false;            // the latter has some
  double work = 0.0, duration = 0.0;  // [ns]; [s], that a simulated second takes
  bool gains = false;                 // more energy than was supplied
};

struct BudgetIsSpent {};

// Of a remedy, relative to the energy supplied: less than what counts as a divergence, but no motion that anyone wants.
constexpr double max_energy_rise = 1.0;

// Of the work of a search: to repeat the divergence and to find its cause.
constexpr double share_of_diagnosis = 0.25;

// A test must come as far as `seconds` [s], and is given up as soon as it is clear that it will not. From there on it may take `work` [ns].
struct Goal {
  double seconds = 0.0, work = std::numeric_limits<double>::infinity();
};

// Parts of the work of a search: the most that a test may take after it has reached its goal, and the work after which a test may be given
// up.
constexpr double max_share = 1.0 / 8.0, judged_after = 1.0 / 64.0;

// Frame by frame, with the warnings and the monitor of `hooke run`.
Trial run_copy(Scene scene, double seconds, Budget& budget, const Goal& goal = {}) {
  const double start = scene.state.time, given = budget.left, frame_duration = 1.0 / scene.settings.frame_rate;
  const double substeps = scene.settings.integrator->stability == Stability::Adaptive ? HUGE_VAL : scene.settings.substeps;
  const long frames = std::lround(std::ceil(seconds * scene.settings.frame_rate * (1.0 - 1e-9)));
  Trial trial;
  trial.warnings = settings_warnings(scene.system, scene.state, scene.settings);
  Lab lab(std::move(scene), KeepStart::No);
  TrialWork work(lab.plan());
  lab.watch_substeps([&] {
    budget.left -= work.since_last(lab.last_frame(), false);
    const double done = lab.scene().state.time - start + frame_duration * lab.last_frame().substeps_done() / substeps;
    const double used = given - budget.left;
    if (done > 0.0) trial.duration = 1e-9 * used / done;
    const bool is_too_slow = std::isfinite(substeps) && used > judged_after * given && used * goal.seconds > given * done;
    if (budget.is_spent() || (done >= goal.seconds ? used > goal.work : is_too_slow)) throw BudgetIsSpent{};
  });
  RunMonitor monitor(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state, 0);
  const auto ended = [&](Trial::End end) {
    trial.end = end;
    trial.seconds = end == Trial::End::Finished ? seconds : lab.scene().state.time - start;
    for (std::string& warning : monitor.warnings({})) trial.went_wrong = true, trial.warnings.push_back(std::move(warning));
    trial.work = given - budget.left;
    trial.gains = !(monitor.energy_rise() <= max_energy_rise);
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
  const StepLimits limits(bound_spectrum(start.system));
  const bool is_linear = !has_own_steps && !limits.is_set_by_contact(*settings.integrator);
  if (is_linear && settings.substep() > limits.stable_step(*settings.integrator)) return StepTooLong;

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

// The settings of one method to try, the cheapest first; but one substep only after the present number.
std::vector<Advice> settings_of(const Integrator& method, const Scene& start, const StepLimits& limits) {
  const Settings& settings = start.settings;
  const double frame_rate = settings.frame_rate;
  const auto limit = limits.stable_substeps(method, frame_rate), resolving = limits.resolving_substeps(method, frame_rate);
  const bool is_present = &method == settings.integrator;
  if (method.stability == Stability::Adaptive)
    return is_present ? std::vector<Advice>{} : std::vector<Advice>{{&method, settings.substeps}};
  std::vector<Advice> list;
  if (has_no_longest_step(method)) {
    std::vector<int> numbers{settings.substeps, 1, std::min(max_substeps, 4 * settings.substeps)};
    // listed forces that are not part of its linear system may limit its step
    if (limit && *limit > numbers.back()) numbers.push_back(std::min(max_substeps, 2 * *limit));
    for (const int substeps : numbers) {
      const Advice advice{&method, resolving_oscillations(limits.needs(), method, frame_rate, substeps)};
      const bool is_tried = is_present && advice.substeps <= settings.substeps;
      if (!is_tried && std::ranges::find(list, advice) == list.end()) list.push_back(advice);
    }
    return list;
  }
  if (!limit || !resolving || method.stability == Stability::None) return {};
  constexpr int refinements = 5;
  const int min_substeps = is_present ? 2 * std::min(settings.substeps, max_substeps / 2) : 1;
  double substeps =
      std::max({static_cast<double>(min_substeps), static_cast<double>(limits.needs().margin) * *limit, static_cast<double>(*resolving)});
  for (int i = 0; i < refinements && substeps <= max_substeps; ++i, substeps *= 2.0) list.push_back({&method, static_cast<int>(substeps)});
  return list;
}

// The methods to try: the present one, those that are stable at any step without a nonlinear solve, which prove the others too expensive
// soon, the default one, and those that choose their steps last; but first where no number of substeps resolves a passage. Not methods
// with a fixed number of iterations: where they do not converge, a stiff cloth is stable but moves far too slowly.
std::vector<const Integrator*> methods_to_try(const Settings& settings, const StepLimits& limits) {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators())
    if (!method.iterates() || &method == settings.integrator) methods.push_back(&method);
  const bool is_for_adaptive = !limits.resolving_substeps(default_integrator(), settings.frame_rate);
  const auto rank = [&](const Integrator* method) {
    if (method->stability == Stability::Adaptive) return is_for_adaptive ? 0 : 6;
    if (method == settings.integrator) return 1;
    if (has_no_longest_step(*method)) return method->implicit_solve == ImplicitSolve::Iterative ? 4 : 2;
    return method == &default_integrator() ? 3 : 5;
  };
  std::ranges::stable_sort(methods, {}, rank);
  return methods;
}

// The newest edit without which the run from this state does not diverge.
std::optional<RecentChange> find_change(const Scene& from, const std::vector<RecentChange>& changes, double seconds,
                                        const std::atomic<bool>& stop, const RemedyProgress& progress) {
  constexpr std::size_t max_tested = 4;
  Budget budget{share_of_diagnosis * default_remedy_work, stop};
  for (std::size_t i = 0; i < std::min(changes.size(), max_tested) && !stop; ++i) {
    if (progress) progress("Testing the scene without \"" + changes[i].text + "\"");
    Scene scene = from;
    for (const Command& command : changes[i].restore) {
      Effect effect;
      apply(scene, command, effect);
    }
    if (run_copy(std::move(scene), seconds, budget).end == Trial::End::Finished) return changes[i];
  }
  return std::nullopt;
}

// Tests settings on copies, and keeps the best of each method.
class SettingSearch {
 public:
  SettingSearch(const Scene& start, double seconds, double diverged_after, double max_work, Budget budget, Remedy& remedy)
      : start_(start), seconds_(seconds), diverged_after_(diverged_after), max_work_(max_work), budget_(budget), remedy_(remedy) {}

  void try_method(const Integrator& method, const StepLimits& limits, const RemedyProgress& progress) {
    const std::vector<Advice> settings = settings_of(method, start_, limits);
    const bool is_present = &method == start_.settings.integrator;
    bool needs_no_more = false;
    for (std::size_t i = 0; i < settings.size() && !budget_.stop; ++i) {
      if (needs_no_more && settings[i].substeps > settings[i - 1].substeps) return;
      if (budget_.left <= 0.0) {
        remedy_.settings_left += static_cast<int>(settings.size() - i);
        return;
      }
      if (progress) progress("Testing " + describe(settings[i]));
      // no setting takes more than half of the rest, nor, except to keep the method, more than the cheapest that was found
      const double half = 0.5 * budget_.left, allowed = is_present ? half : std::min(half, cheapest_work_);
      const Trial trial = run(settings[i], allowed);
      // with more substeps, what would do but for the energy that it gains may do; all else would take longer still
      const bool is_cut_short = trial.end == Trial::End::OutOfBudget && !(trial.gains && trial.seconds >= 2.0 * diverged_after_);
      if (keep(settings[i], trial, is_present) || is_cut_short) needs_no_more = true;
      if (!is_cut_short) continue;
      if (is_present && trial.duration > 0.0) remedy_.untested = {settings[i], trial.seconds, trial.duration, {}};
      if (allowed < half) continue;
      ++remedy_.settings_cut_short;
      for (std::size_t more = i + 1; more < settings.size(); ++more)
        remedy_.settings_left += settings[more].substeps > settings[i].substeps ? 1 : 0;
    }
  }

  void finish() {
    for (const auto& one : cheapest_)
      if (one && !remedy_.cheapest) remedy_.cheapest = one;
    // the test counts more than a warning that is given before it, where the choice is otherwise slower than real time
    for (const Rank rank : {StepWarning, PartlyStepWarning})
      if (const auto& one = cheapest_[rank]; one && remedy_.cheapest->duration > std::max(1.0, one->duration)) remedy_.cheapest = one;
    for (const auto& one : same_method_)
      if (one && !remedy_.same_method) remedy_.same_method = one;
    if (remedy_.same_method) remedy_.untested.reset();
    if (remedy_.same_method && remedy_.cheapest->advice == remedy_.same_method->advice) remedy_.same_method.reset();
  }

 private:
  // in the order of preference: tested for all of the time, without a warning or only with one about the step; for as long as the work
  // allowed, likewise; and with any other warning
  enum Rank { Tested, StepWarning, PartlyTested, PartlyStepWarning, OtherWarning, Ranks };

  Trial run(const Advice& advice, double allowed) {
    Scene scene = start_;
    scene.settings.integrator = advice.integrator;
    scene.settings.substeps = advice.substeps;
    if (advice.integrator->stability != Stability::Adaptive) scene.settings.tolerance.reset();
    Budget budget{allowed, budget_.stop};
    Trial trial = run_copy(std::move(scene), seconds_, budget, {2.0 * diverged_after_, max_work_});
    budget_.left -= allowed - std::max(0.0, budget.left);
    ++remedy_.settings_tried;
    return trial;
  }

  // Whether it needs no other setting of the same method.
  bool keep(const Advice& advice, const Trial& trial, bool is_present) {
    const bool is_finished = trial.end == Trial::End::Finished;
    const bool is_tested = is_finished || (trial.end == Trial::End::OutOfBudget && trial.seconds >= 2.0 * diverged_after_);
    if (!is_tested || trial.gains) return false;
    const Rank rank = trial.went_wrong         ? OtherWarning
                      : trial.warnings.empty() ? (is_finished ? Tested : PartlyTested)
                                               : (is_finished ? StepWarning : PartlyStepWarning);
    const TestedSetting setting{.advice = advice, .seconds = trial.seconds, .duration = trial.duration, .warnings = trial.warnings};
    auto& best = cheapest_[rank];
    if (!best || setting.duration < best->duration) best = setting;
    if (is_present && !same_method_[rank]) same_method_[rank] = setting;
    if (rank == Tested) cheapest_work_ = std::min(cheapest_work_, trial.work);
    if (rank == PartlyTested) cheapest_work_ = std::min(cheapest_work_, 2e9 * diverged_after_ * setting.duration);
    return rank == Tested;
  }

  const Scene& start_;
  const double seconds_, diverged_after_, max_work_;
  Budget budget_;
  Remedy& remedy_;
  double cheapest_work_ = std::numeric_limits<double>::infinity();  // [ns], of a test without warnings
  std::optional<TestedSetting> cheapest_[Ranks], same_method_[Ranks];
};

}  // namespace

double TrialWork::since_last(const FrameRunner& frame, bool is_finished) {
  constexpr double ns_per_ms = 1e6;
  // what each call costs by itself [ns], which the cost model of `auto` leaves out
  constexpr double call = 250.0;
  ++calls_;
  const double counted = ns_per_ms * frame.cost(plan_) + call * static_cast<double>(calls_);
  const double trials = ns_per_ms * frame.trial_cost();
  const double work = std::max(0.0, counted - counted_) + std::max(0.0, trials - trials_);
  counted_ = is_finished ? 0.0 : counted;
  trials_ = trials;
  if (!is_finished) return work;
  calls_ = 0;
  const double items = plan_.points + 3.0 * static_cast<double>(plan_.force_data.faces), forces = static_cast<double>(plan_.forces.size());
  return work + work_of_frame + items * (work_of_point + 45.0 * forces) + work_of_spring * plan_.springs;
}

bool may_reach(double frames, double points, double springs) {
  const double work = frames * (work_of_frame + work_of_point * points + work_of_spring * springs);
  return work <= share_of_diagnosis * default_remedy_work;
}

Remedy find_remedy(const Scene& start, double seconds, const std::atomic<bool>& stop, double max_work, const RemedyProgress& progress) {
  const auto report = [&](const std::string& test) {
    if (progress) progress(test);
  };
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

  const Budget left{max_work - (share_of_diagnosis * max_work - std::max(0.0, diagnosis.left)), stop};
  const StepLimits limits(bound_spectrum(start.system), step_needs(start.system, start.state));
  SettingSearch tested(start, seconds, diverged_after, max_share * max_work, left, remedy);
  for (const Integrator* method : methods_to_try(start.settings, limits)) tested.try_method(*method, limits, progress);
  tested.finish();
  return remedy;
}

Remedy find_remedy(const FailedRun& run, const std::atomic<bool>& stop, const RemedyProgress& report) {
  Scene from = *run.start;
  const auto seconds = [&] { return 2.0 * std::max(0.0, run.time - from.state.time) + 1.0; };
  // with the present settings in every copy
  const auto search = [&] {
    from.settings = run.settings;
    return find_remedy(from, seconds(), stop, default_remedy_work, report);
  };
  Remedy remedy;
  const bool has_state_between = run.before && run.before->time > run.start->state.time;
  if (has_state_between) {
    from.system = *run.system;
    from.state = *run.before;
    remedy = search();
    remedy.from = run.before->time;
  }
  if (remedy.cause == Remedy::Cause::NotReproduced && !stop) {
    from = *run.start;
    remedy = search();
    // which states were tried
    if (remedy.cause == Remedy::Cause::NotReproduced && has_state_between) remedy.from = run.before->time;
  }
  if (remedy.cause == Remedy::Cause::NotReproduced || remedy.cause == Remedy::Cause::SearchLimit) return remedy;
  remedy.change = find_change(from, run.changes, seconds(), stop, report);
  return remedy;
}

}  // namespace hooke
