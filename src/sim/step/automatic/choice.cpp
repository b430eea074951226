#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "sim/contact/contact.h"
#include "sim/methods/passage_step.h"
#include "sim/model/portable_math.h"
#include "sim/step/automatic/automatic.h"
#include "sim/step/automatic/breaking.h"
#include "sim/step/automatic/leapfrog.h"
#include "sim/step/automatic/rates.h"
#include "sim/step/automatic/resonance.h"
#include "sim/step/automatic/selection.h"
#include "sim/step/automatic/turning.h"
#include "sim/step/frame_error.h"

namespace hooke {
namespace {

// The estimate of a frame is not exact, and frames between two estimates differ: aim at this part of the tolerance.
constexpr double aimed_part = 0.3;
// Frames between two estimates, also where the error is far below the tolerance; and between two comparisons of methods.
constexpr int min_period = 3, max_period = 32, max_easy_period = 192, min_interval = 10, max_interval = 1280;
// A speed larger by this factor than in the last frame and at the recent maximum is an event: a jump of the hand, a release, an
// instability. So is one larger by these factors than at the recent maximum; the larger factors where the error is far below the tolerance.
constexpr double event_factor = 1.3, easy_event_factor = 2.1, drift_factor = 2.0, easy_drift_factor = 4.0;
constexpr double drop_factor = 1.5;  // within a frame: it turns into strain
constexpr double fade = 0.99;        // of the recent maximum, per frame
// The part of the target below which an error is far below the tolerance.
constexpr double easy_ratio = 0.05, very_easy_ratio = 0.01;

// Whether springs turn so much faster than at recent estimates that the error may have become unacceptable: at the end of the fall of a
// cloth and of a rope, whose errors grow a hundredfold within ten frames, it is proportional to the third power or less.
bool is_whipping(const MethodChoice& choice, double turning) {
  if (!(turning > choice.recent_turning) || choice.recent_turning <= 0.0) return false;
  const double factor = turning / choice.recent_turning;
  return choice.ratio * factor * factor * factor > acceptable_ratio;
}

// [m/s], a measure of how fast the scene and the hand move.
double speed_of(const Plan& plan, const State& state, double frame) {
  double sum = 0.0;
  for (const Vec3& v : state.velocity) sum += glm::dot(v, v);
  const double rms = state.velocity.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(state.velocity.size()));
  double hand = 0.0;
  if (plan.hand.pull) hand = glm::length(plan.hand.pull->velocity);
  if (plan.collider_paths.grabbed) hand = std::max(hand, glm::length(plan.collider_paths.grabbed->velocity));
  if (plan.hand.held) hand = std::max(hand, glm::length(state.hand.target - state.hand.position) / frame);
  return rms + hand + frame * glm::length(plan.gravity) + 1e-9;
}

// [ms], of a frame in which springs break.
double max_cost_with_breaks(const MethodChoice& choice, const Goal& goal) {
  constexpr double max_cost_factor = 8.0, max_cost_ms = 50.0;
  return std::min(goal.max_cost, std::max(max_cost_ms, max_cost_factor * choice.cost));
}

// Springs break in the coming frame, whose error is known: shorter steps for this frame alone. The error is of first order, and another
// method would not help.
void refine_breaks(MethodChoice& choice, Trials& trials, const Settings& trial, const Goal& goal) {
  constexpr int max_attempts = 4;
  constexpr double max_factor = 64.0;
  const double max_cost = max_cost_with_breaks(choice, goal);
  for (int attempt = 0; attempt < max_attempts && choice.ratio > 1.0 && std::isfinite(choice.cost); ++attempt) {
    const int needed = substeps_for(choice.substeps, choice.ratio * goal.target, goal.target, 1, max_factor);
    const double affordable = std::min<double>(max_automatic_substeps, choice.substeps * max_cost / choice.cost);
    const int more = static_cast<int>(std::min<double>(needed, affordable));
    if (more <= choice.substeps) break;
    Settings finer = trial;
    finer.substeps = more;
    const Trials::Result result = trials.measure(finer, 1.25 * max_cost, goal.target);
    const double ratio = result.error / goal.target;
    if (!(ratio < choice.ratio)) break;
    const bool has_stalled = ratio > 0.7 * choice.ratio;
    choice.substeps = more;
    choice.ratio = ratio;
    choice.cost = result.cost;
    trials.keep();
    if (has_stalled) break;
  }
}

// Estimates the error of the coming frame with the present method, and adapts the substeps. False if so many more are needed that another
// method may be cheaper: then `choice` has that number. `is_breaking`: springs may break in this frame.
bool follow(MethodChoice& choice, Trials& trials, const Plan& plan, const System& system, const Settings& settings, const Goal& goal,
            bool is_sudden, bool is_breaking, double max_increase) {
  constexpr int max_attempts = 6;
  constexpr double max_comparison = 3.0;
  const double before = choice.ratio;
  const int substeps_before = choice.substeps;
  Settings trial = settings;
  trial.tolerance.reset();
  trial.integrator = choice.method;
  trial.substeps = choice.substeps;
  const bool is_saturated = is_splitting_saturated(*choice.method, plan.spectrum, trial.substep());
  const int order = is_saturated                 ? 1
                    : choice.method == &leapfrog ? optimistic_order(plan, system, leapfrog, trial.substep())
                                                 : effective_order(system, *choice.method);
  const bool has_stable_half = choice.substeps / 2 >= choice.min_substeps && choice.method->implicit_solve == ImplicitSolve::None;
  const bool is_by_coarser =
      has_stable_half && order > 1 && before > easy_ratio && !is_sudden && plan.spring.break_length.empty() && !plan.surface.on;
  bool breaks = false;
  Trials::Result result;
  const auto measure = [&](int substeps, bool by_coarser) {
    trial.substeps = substeps;
    const double max_cost = 1.25 * goal.max_cost, limit = is_sudden ? 0.0 : acceptable_ratio * goal.target;
    result = by_coarser ? trials.measure_by_coarser(trial, max_cost) : trials.measure(trial, max_cost, limit);
    if (is_sudden && std::isfinite(result.error)) result.error = std::max(result.error, trials.unresolved(trial));
    breaks = result.breaks;
    return std::pair(result.error / goal.target, result.cost);
  };
  std::tie(choice.ratio, choice.cost) = measure(choice.substeps, is_by_coarser);
  trials.keep();
  if (is_breaking && !breaks) {
    // between the ends of long substeps a spring that vibrates may pass its limit and return
    const int substeps = trials.resolving_substeps(settings.frame_rate);
    if (substeps > choice.substeps && trials.breaks_if_resolved(settings, substeps, max_cost_with_breaks(choice, goal))) {
      choice.substeps = substeps;
      std::tie(choice.ratio, choice.cost) = measure(substeps, false);
      trials.keep();
      breaks = true;
    }
  }
  choice.breaks = breaks;
  if (breaks) {
    refine_breaks(choice, trials, trial, goal);
    choice.next_substeps = substeps_before;
    choice.until_estimate = choice.period = min_period;
    return true;
  }
  const bool is_missed = choice.ratio > 1.0;
  // while the motion grows, such a method soon needs many more substeps than one of higher order
  constexpr int expected_growth = 3;
  const bool is_of_first_order = choice.method->order == 1 && choice.method->stability != Stability::EachSpring && !has_contact(system);
  // a frame slightly beyond the target is within the tolerance: only the next ones need more
  if (is_missed && choice.ratio <= acceptable_ratio && (order > 1 || is_saturated)) {
    trial.substeps = choice.substeps;
    const int more = raised_substeps(plan, system, trial, choice.ratio, choice.interval < min_interval);
    const bool is_affordable = more * choice.cost <= goal.max_cost * choice.substeps;
    const bool is_small = choice.selected_substeps == 0 || more <= max_increase * choice.selected_substeps;
    if (is_affordable && is_small && more <= max_automatic_substeps) {
      choice.period = choice.until_estimate = min_period;
      choice.next_substeps = more;
      return true;
    }
  }
  const bool is_edited = choice.selected_substeps == 0;
  const bool is_resonant = max_frames_in_resonance(*choice.method, plan.spectrum, settings.frame_rate, goal.frequency, choice.substeps) <
                           std::numeric_limits<int>::max();
  const bool has_jumped = is_edited || (is_sudden && is_resonant);
  const bool is_smooth = !has_jumped && !plan.hand.held && !plan.has_contact() && plan.spring.break_length.empty();
  const double max_spent = trials.total_cost() + max_comparison * goal.max_cost;
  for (int attempt = 0; choice.ratio > 1.0 && choice.substeps < max_automatic_substeps && attempt < max_attempts; ++attempt) {
    if (trials.total_cost() > max_spent) break;
    const int needed = std::min(max_automatic_substeps, substeps_for(choice.substeps, choice.ratio * goal.target, goal.target, order, 4.0));
    const double affordable = std::isfinite(choice.cost) ? choice.substeps * goal.max_cost / choice.cost : needed;
    const int more = static_cast<int>(std::min<double>(needed, affordable));
    if (more <= choice.substeps) break;
    // the repetition is the frame, if that is accurate enough: its error follows from the order where the motion is smooth
    const bool is_new_comparison = result.fine_substeps > max_increase * choice.selected_substeps;
    const bool is_accurate = result.fine_error <= acceptable_ratio * goal.target && result.fine_cost <= goal.max_cost;
    if (order > 1 && is_smooth && !is_new_comparison && is_accurate) {
      choice.substeps = result.fine_substeps;
      choice.ratio = result.fine_error / goal.target;
      choice.cost = result.fine_cost;
      trials.keep_repetition(*choice.method, result);
      if (choice.ratio <= 1.0) break;
      choice.period = choice.until_estimate = min_period;
      choice.next_substeps = substeps_for(choice.substeps, choice.ratio, raised_ratio, order, 4.0);
      return true;
    }
    if (is_of_first_order && choice.selected_substeps > 0) {
      choice.substeps = std::min(max_automatic_substeps, expected_growth * more);
      return false;
    }
    if (choice.selected_substeps > 0 && more > max_increase * choice.selected_substeps) {
      choice.substeps = more;
      return false;
    }
    // a little more follows from the order
    const double factor = static_cast<double>(more) / choice.substeps;
    if (factor < 1.5 && more == needed && order > 1) {
      choice.substeps = more;
      choice.ratio *= portable::pow(factor, -order);
      choice.cost *= factor;
      break;
    }
    const auto [ratio, cost] = measure(more, false);
    if (!(ratio < choice.ratio)) break;  // rounding errors, or too expensive
    const bool has_stalled = ratio > 0.7 * choice.ratio;
    choice.substeps = more;
    choice.ratio = ratio;
    choice.cost = cost;
    trials.keep();
    if (has_stalled) break;
  }
  const bool is_easy = choice.ratio < easy_ratio && before < easy_ratio;
  const bool is_regular = is_easy || choice.ratio < std::max(2.0 * before, 0.2);
  if (choice.ratio > 1.0)  // it cannot be met now: do not try in every frame
    choice.period = std::min(max_period, 2 * choice.period);
  else if (is_missed)
    choice.period = has_contact(system) ? 1 : 2;
  else
    choice.period = is_regular && !is_sudden ? std::min(is_easy ? max_easy_period : max_period, 2 * choice.period) : min_period;
  choice.until_estimate = choice.period;
  choice.next_substeps = choice.substeps;
  if (choice.ratio <= 1.0 && choice.substeps > choice.min_substeps) {
    // PI control (Gustafsson 1991), which lowers the number slowly
    const double p = order;
    const double factor =
        portable::pow(std::max(choice.ratio, 1e-12) / 0.9, 0.7 / p) * portable::pow(std::clamp(before, 1e-12, 1e12), -0.4 / p);
    const int fewer = static_cast<int>(std::ceil(choice.substeps * std::clamp(factor, 0.4, 1.0)));
    choice.next_substeps = std::max(choice.min_substeps, fewer);
  }
  return true;
}

// Adapts the substeps to the fewest stable ones: at least these, and no more if only stability required more before.
void limit_to_stable(MethodChoice& choice, int min_before, int order) {
  if (choice.substeps == min_before && choice.min_substeps < min_before) {
    const double ratio = choice.ratio * portable::pow(static_cast<double>(min_before) / choice.min_substeps, order);
    constexpr double max_ratio = 0.5;
    if (ratio < max_ratio) {
      choice.substeps = choice.min_substeps;
      choice.ratio = ratio;
    }
  }
  choice.next_substeps = choice.substeps = std::max(choice.substeps, choice.min_substeps);
}

// The substeps that resolve the passage of a point through the core of a force within the frame, as far as they are affordable; those of
// the choice without one.
int substeps_of_passage(const Passage& passage, const MethodChoice& choice, const Settings& settings, const Goal& goal) {
  const double affordable = std::min<double>(max_automatic_substeps, choice.substeps * goal.max_cost / choice.cost);
  const double resolving = std::ceil(1.0 / (settings.frame_rate * longest_step(passage, *choice.method)));
  return std::max(choice.substeps, static_cast<int>(std::min(resolving, affordable)));
}

// Whether something strikes something else or springs break in the coming frame, which is computed for that and kept.
bool strikes(Trials& trials, const MethodChoice& choice, const Settings& settings, double max_error) {
  Settings trial = settings;
  trial.tolerance.reset();
  trial.integrator = choice.method;
  trial.substeps = choice.substeps;
  double cost = 0.0;
  if (trials.compute_frame(trial, std::numeric_limits<double>::infinity(), &cost) != Trials::End::Finished) return true;
  const bool has_impact = trials.has_broken() || trials.has_impact(max_error);
  if (!has_impact) trials.keep();
  return has_impact;
}

}  // namespace

AutomaticChoice::AutomaticChoice() = default;
AutomaticChoice::~AutomaticChoice() = default;
AutomaticChoice::AutomaticChoice(AutomaticChoice&& other) noexcept = default;
AutomaticChoice& AutomaticChoice::operator=(AutomaticChoice&& other) noexcept = default;

double AutomaticChoice::trial_cost() const { return trials_ ? trials_->total_cost() : 0.0; }

Frame* AutomaticChoice::computed_frame(const MethodChoice& choice) { return trials_->kept(*choice.method, choice.substeps); }

MethodChoice AutomaticChoice::choose(const Plan& plan, const System& system, const Settings& settings, const State& state) {
  const double frame = 1.0 / settings.frame_rate;
  const double target = aimed_part * automatic_tolerance(settings) * frame;
  const double rates = rates_of(plan), speed = speed_of(plan, state, frame);
  if (!trials_) trials_ = std::make_unique<Trials>();
  const double recent_speed = state.memory.choice ? std::max(speed, state.memory.choice->recent_speed) : speed;
  trials_->forget(may_step_beyond_resonance(plan, target, recent_speed));
  double frequency = 1.0, turning = 0.0;
  int until_bound = 0;
  const auto bound = [&](double frame_cost) {
    frequency = trials_->bound_frequency(plan, state, settings.frame_rate, frame_cost);
    constexpr double much_lower = 0.95;
    if (frequency > much_lower) frequency = 1.0;
    until_bound = frequency < 1.0 ? frames_per_bound : frames_without_bound;
  };
  bool has_begun = false;
  const auto begin = [&]() -> Goal {
    if (!std::exchange(has_begun, true)) trials_->begin(plan, system, state);
    return {target, max_cost_of_frame(*trials_, plan, settings), frequency};
  };
  MethodChoice choice;
  const auto select = [&](const MethodChoice* last, Present knowledge, bool is_sudden) {
    const MethodChoice selected = select_method(*trials_, plan, system, settings, begin(), last, knowledge);
    const bool is_confirmed = last != nullptr && last->method == selected.method && last->selected_substeps > 0;
    int interval = is_confirmed ? std::min(max_interval, 4 * last->interval) : min_interval;
    // soon, as long as what is cheaper comes closer to the goal
    const bool is_closer = !is_confirmed || (last->interval < min_interval && selected.until_selection < last->interval);
    if (selected.until_selection > 0 && is_closer) interval = std::min(min_interval, selected.until_selection);
    if (knowledge == Present::ToBeMeasured || !is_confirmed) {
      choice = selected;
      const int factor = is_sudden || choice.ratio > easy_ratio ? 1 : choice.ratio > very_easy_ratio ? 4 : 8;
      choice.until_estimate = choice.period = factor * min_period;
    }
    choice.until_selection = choice.interval = interval;
  };

  if (!state.memory.choice) {
    const int substeps = trials_->stable_substeps(default_integrator(), plan, settings.frame_rate, 1.0);
    bound(CostModel(plan).expected(default_integrator(), substeps));
    select(nullptr, Present::ToBeMeasured, false);
    choice.until_estimate = 1;  // the start may be at rest or in equilibrium: its error says little about the next frames
  } else {
    const MethodChoice last = *state.memory.choice;
    choice = last;
    choice.breaks = false;
    if (last.next_substeps != last.substeps) {
      const double part = static_cast<double>(last.next_substeps) / last.substeps;
      choice.substeps = last.next_substeps;
      choice.ratio *= portable::pow(part, -effective_order(system, *choice.method));
      choice.cost *= part;
    }
    --choice.until_estimate;
    --choice.until_selection;
    const bool is_edited = choice.rates != rates || choice.target != target || choice.budget != settings.budget_ms;
    const bool is_easy = choice.ratio < easy_ratio;
    bool is_event = speed > (is_easy ? easy_event_factor : event_factor) * std::max(last.speed, last.recent_speed) ||
                    speed > (is_easy ? easy_drift_factor : drift_factor) * last.recent_speed ||
                    last.speed > (is_easy ? easy_drift_factor : drop_factor) * speed;
    turning = turning_of(plan, state, choice.cost);
    frequency = last.frequency;
    until_bound = last.until_bound - 1;
    if (until_bound <= 0 || is_edited || is_event) bound(last.cost);
    choice.min_substeps = trials_->stable_substeps(*choice.method, plan, settings.frame_rate, frequency);
    limit_to_stable(choice, last.min_substeps, effective_order(system, *choice.method));
    bool must_select = false;
    if (is_edited) {
      must_select = choice.min_substeps > std::min(max_automatic_substeps, 4 * last.substeps) || choice.target != target ||
                    choice.budget != settings.budget_ms;
      // while a slider moves, only the substeps follow, unless they become far too many
      choice.selected_substeps = 0;
      choice.interval = min_interval;
      choice.until_selection = std::clamp(choice.until_selection, 1, 10);
    }
    const bool has_hand = plan.hand.held || plan.hand.pull || plan.collider_paths.grabbed;
    const bool is_beyond = !is_tolerance_met(choice, settings);  // which is reported: try again when the next estimate is due
    const bool is_breaking = is_about_to_break(plan, state, frame);
    // the frames before do not show what happens in it, nor do those after: their substeps are for it alone
    const Passage passage = shortest_passage(system, state, frame);
    const bool passes = passage.speed > 0.0;
    const int substeps_before = choice.substeps;
    if (passes) choice.substeps = substeps_of_passage(passage, choice, settings, begin());
    is_event = !is_beyond && (is_event || is_breaking);
    const bool whips = !is_beyond && is_whipping(choice, turning);
    const bool is_due = is_edited || is_event || choice.until_estimate <= 0 || whips || passes;
    if (!is_due && (plan.has_contact() || !plan.spring.break_length.empty()) && !is_beyond) {
      begin();
      is_event = strikes(*trials_, choice, settings, target);
    }

    const bool is_sudden = is_event || is_edited;
    // without another comparison where the error grows for every method, and none has a higher order
    constexpr int max_order = 4;
    const double max_increase = passes ? std::numeric_limits<double>::infinity()
                                : has_hand || (whips && effective_order(system, *choice.method) >= max_order) ? 5.0
                                                                                                              : 2.0;
    if (choice.until_selection <= 0 && !is_sudden && !has_hand && !is_beyond && !passes) {
      // cheaper methods are tried now and then: what ruled them out may have been the start of the motion
      const MethodChoice present = choice;
      select(&present, Present::Known, false);
    }
    if (choice.method != last.method || (!is_due && !is_event)) {
      // another method was selected, or nothing has to be estimated
    } else if (must_select) {
      select(&last, Present::ToBeMeasured, is_sudden);
    } else if (!follow(choice, *trials_, plan, system, settings, begin(), is_sudden, is_breaking, max_increase)) {
      const MethodChoice present = choice;
      select(&present, Present::ToBeMeasured, is_sudden);
    }
    if (passes && choice.method == last.method) {
      choice.next_substeps = substeps_before;
      choice.until_estimate = choice.period = 1;
    }
    choice.breaks = choice.breaks || (is_beyond && is_breaking);
    const bool is_estimated = is_due || is_event;
    choice.recent_speed = is_estimated ? std::max(speed, fade * last.recent_speed) : fade * last.recent_speed;
    choice.recent_turning = is_estimated ? std::max(turning, fade * last.recent_turning) : fade * last.recent_turning;
  }
  choice.period =
      std::min(choice.period, max_frames_in_resonance(*choice.method, plan.spectrum, settings.frame_rate, frequency, choice.substeps));
  choice.until_estimate = std::min(choice.until_estimate, choice.period);
  choice.resolves_collider = choice.min_substeps > 1 && choice.min_substeps == collider_substeps(plan, settings.frame_rate);
  choice.rates = rates;
  choice.target = target;
  choice.budget = settings.budget_ms;
  choice.speed = speed;
  choice.frequency = frequency;
  choice.until_bound = until_bound;
  if (!state.memory.choice) {
    choice.recent_speed = speed;
    choice.recent_turning = turning_of(plan, state, choice.cost);
  }
  return choice;
}

}  // namespace hooke
