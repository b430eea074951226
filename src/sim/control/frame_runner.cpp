#include "sim/control/frame_runner.h"

#include <algorithm>
#include <cmath>

#include "sim/control/automatic.h"
#include "sim/control/constants.h"
#include "sim/control/step_controller.h"
#include "sim/methods/passage_step.h"
#include "sim/model/portable_math.h"
#include "sim/plan/phase_times.h"

namespace hooke {
namespace {

// Whether the method was selected for a motion that needed far fewer or far more substeps.
bool needs_selection(const MethodChoice& choice) {
  const double change = static_cast<double>(choice.next_substeps) / choice.selected_substeps;
  return !(change <= control::selection_change && change >= 1.0 / control::selection_change);
}

}  // namespace

void FrameRunner::begin(Plan& plan, const System& system, const Settings& settings, const State& state) {
  is_automatic_ = is_automatic(settings);
  if (!is_automatic_) return frame_.begin(plan, system, settings, state);
  system_ = &system;
  start_ = state;
  settings_ = settings;
  settings_.tolerance.reset();
  settings_.locates_breaks = true;
  share_ = automatic_tolerance(settings) / settings.frame_rate;
  is_accepted_ = false;
  rejections_ = 0;
  agreed_before_ = false;
  frame_cost_ = 0.0;
  StepNeeds needs{.passage = shortest_passage(system, state, 1.0 / settings.frame_rate), .oscillation = plan.resolving_step()};
  // a spring that vibrates may pass its limit and return between the ends of longer substeps
  if (may_break(plan, state)) needs.oscillation = std::min(needs.oscillation, control::max_turn / plan.spectrum.omega);
  limits_.update(plan.spectrum, needs);
  choose(plan);
}

// The method, and the substeps of the first run.
void FrameRunner::choose(Plan& plan) {
  max_cost_ = max_cost(plan);
  if (take_change()) estimate_after_edit(start_.memory);
  if (start_.memory.choice) choice_ = *start_.memory.choice;
  const auto min = start_.memory.choice ? min_automatic_substeps(limits_, *choice_.method, settings_.frame_rate) : std::nullopt;
  if (!min || needs_selection(choice_)) {
    select(plan);
  } else {
    choice_.min_substeps = *min;
  }
  const bool was_calm = choice_.until_estimate > 0;
  is_estimated_ = !was_calm || !is_calm(plan, start_, 1.0 / settings_.frame_rate);
  if (!is_estimated_) return start(plan, choice_.min_substeps);
  start_runs(plan, choice_.next_substeps);
}

void FrameRunner::select(Plan& plan) {
  const FrameTrial selected = selector_.select(plan, *system_, settings_, start_, limits_, share_, max_cost_);
  // where no method can be tried, an implicit one, as fine as it can be
  const Integrator& method = selected.method != nullptr ? *selected.method : stiff_integrator();
  const int most = max_automatic_substeps / 2;
  choice_ = {.method = &method,
             .min_substeps = min_automatic_substeps(limits_, method, settings_.frame_rate).value_or(most),
             .next_substeps = selected.method != nullptr ? selected.substeps : max_automatic_substeps};
  choice_.selected_substeps = choice_.next_substeps;
}

// [ms], that this frame may cost: by the budget of the scene, or relative to the frame before.
double FrameRunner::max_cost(const Plan& plan) const {
  if (settings_.budget_ms > 0.0) return settings_.budget_ms;
  if (!start_.memory.choice) return control::max_cost;
  const MethodChoice& last = *start_.memory.choice;
  const double before = std::max(control::short_frame, CostModel(plan).expected(*last.method, last.substeps));
  return std::min(control::max_cost, control::max_cost_factor * before);
}

// [ms], that a frame in which something touches or breaks may cost: relative to the fewest substeps, since chains of impacts amplify every
// error, and frames that follow each other would each take more than the one before.
double FrameRunner::max_cost_of_events(const Plan& plan) const {
  const double fewest = std::max(control::short_frame, CostModel(plan).expected(*choice_.method, choice_.min_substeps));
  return std::min(max_cost_, control::max_cost_factor * fewest);
}

void FrameRunner::start(Plan& plan, int substeps) {
  if (plan.execution.phases != nullptr) plan.execution.phases->move_to_auto();
  if (!plan.spring.break_length.empty()) refresh_values(plan, *system_);  // restores springs that broke in the run before
  settings_.integrator = choice_.method;
  settings_.substeps = substeps;
  frame_.begin(plan, *system_, settings_, start_);
}

// The first of the runs whose last one has at least so many substeps.
void FrameRunner::start_runs(Plan& plan, int substeps) {
  runs_.restart(plan.spectrum.omega);
  start(plan, std::max(first_substeps(substeps), choice_.min_substeps));
}

void FrameRunner::substep(Plan& plan) {
  frame_.substep(plan);
  if (is_automatic_ && frame_.done()) finish_run(plan);
}

double FrameRunner::cost(const Plan& plan) const {
  const Integrator* method = is_automatic_ ? choice_.method : frame_.method();
  return method == nullptr ? 0.0 : CostModel(plan).of(*method, frame_.motion(), frame_.substeps_done());
}

void FrameRunner::finish_run(Plan& plan) {
  const double cost_of_run = cost(plan);
  frame_cost_ += cost_of_run;
  if (!is_estimated_) {
    choice_.substeps = settings_.substeps;
    return accept(std::nullopt, 0.0, 1);
  }
  set_end(runs_.add(), frame_, plan, start_, scratch_);
  if (runs_.count() >= 2) return judge(plan);
  other_cost_ += cost_of_run;
  start(plan, 2 * settings_.substeps);
}

// At most so many, but at least twice as many as in the last run: the order may be higher than what is claimed. 0: none.
int FrameRunner::affordable_substeps(const Plan& plan, int wanted) const {
  const double max_cost = runs_.have_contacts() ? max_cost_of_events(plan) : max_cost_;
  const double cost_of_one = control::cost_of_estimate * cost(plan) / choice_.substeps;
  for (int n = wanted; n >= 2 * choice_.substeps; n /= 2)
    if (n <= max_automatic_substeps && frame_cost_ + n * cost_of_one <= max_cost) return n;
  return 0;
}

// The last run of an estimate has ended: keeps it, or starts one with more substeps.
void FrameRunner::judge(Plan& plan) {
  choice_.substeps = settings_.substeps;
  const double error = runs_.error(*system_, *choice_.method);
  const int order = order_of(*system_, *choice_.method, runs_.finest());
  // what an impact late in the frame gets wrong shows in the velocities, and in the positions only a frame later
  const double later = runs_.have_events() ? runs_.velocity_error(*system_) / settings_.frame_rate : 0.0;
  const double controlled = std::max(error, later);
  const bool is_small_enough = is_accepted(controlled, share_);
  // times of events differ at random between runs: two that agree may do so by chance, but hardly with a third, of four times the substeps
  const bool needs_third = runs_.have_jumps() && !agreed_before_;
  if (is_small_enough && !needs_third) return accept(error, controlled, order);
  agreed_before_ = is_small_enough;

  const int wanted = is_small_enough ? 4 * choice_.substeps
                                     : refined_substeps({.substeps = choice_.substeps, .error = controlled, .order = order}, share_);
  const int more = affordable_substeps(plan, wanted);
  if (more == 0) return accept(error, controlled, order);
  other_cost_ += cost(plan);
  if (!is_small_enough && ++rejections_ == control::max_rejections) {
    const Integrator* before = choice_.method;
    select(plan);
    if (choice_.method != before) return start_runs(plan, choice_.next_substeps);
  }
  if (is_small_enough || more == 2 * settings_.substeps) return start(plan, more);
  start_runs(plan, more);
}

// What the next frame needs to know of this one.
void FrameRunner::accept(std::optional<double> error, double controlled, int order) {
  is_accepted_ = true;
  choice_.error = error;
  if (!error) {
    --choice_.until_estimate;
    return;
  }
  const double ratio = ratio_to_aim(controlled, share_);
  choice_.next_substeps =
      next_substeps({.substeps = choice_.substeps, .error = controlled, .order = order, .ratio_before = choice_.ratio}, share_);
  choice_.ratio = std::isfinite(ratio) ? ratio : 0.0;
  // the error with the fewest substeps, which the next frames may have
  const double longer = std::max(1.0, static_cast<double>(choice_.substeps) / choice_.min_substeps);
  const bool is_calm_now =
      first_substeps(choice_.substeps) <= choice_.min_substeps && ratio * portable::pow(longer, order) < control::calm_ratio;
  choice_.until_estimate = is_calm_now ? control::max_unestimated : 0;
}

void FrameRunner::end(const Plan& plan, State& state) const {
  frame_.end(plan, state);
  if (is_automatic_)
    state.memory.choice = choice_;
  else
    state.memory.choice.reset();
}

}  // namespace hooke
