#include "sim/step/automatic/selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/contact/contact.h"
#include "sim/methods/rows.h"
#include "sim/model/portable_math.h"
#include "sim/step/automatic/leapfrog.h"
#include "sim/step/frame_error.h"

namespace hooke {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Another method takes the place of the present one only if it is cheaper by this factor; the smaller one if it is of higher order, because
// methods are compared where the error has grown.
constexpr double hysteresis = 1.3, hysteresis_of_higher_order = 1.1, hysteresis_if_known = 2.0;
// Without a budget: a frame may cost this much, or this multiple of the cheapest stable one, to meet the tolerance; and a comparison of
// methods that many times as much.
constexpr double max_cost_ms = 400.0, max_cost_factor = 8.0, max_comparison = 5.0;
// The same multiples where already these would take seconds; and a comparison where nothing could be measured so far.
constexpr double slow_cost_factor = 1.5, slow_comparison = 2.0, max_fruitless_comparison = 8.0;
// With contact or a strain limit, where all methods are of first order and shorter steps may not help at all: chains of impacts amplify any
// error.
constexpr double max_cost_with_contact_ms = 3.0;
// The same where springs are too fast for explicit methods.
constexpr double max_implicit_cost_with_contact_ms = 60.0;
constexpr int max_attempts = 8;
// An unexpected cost, relative to the expected one.
constexpr double max_cost_ratio = 4.0;

// Whether dashpots damp the fastest modes more than critically.
bool is_overdamped(const Plan& plan) { return plan.spectrum.dashpot_rate > plan.spectrum.omega; }

struct Candidate {
  const Integrator* method = nullptr;
  int min_substeps = 1, substeps = 1;  // next to try
  double expected_cost = 0.0;          // [ms], at these substeps
  double ratio = infinity;             // of the last attempt
  double first_ratio = infinity;       // of that with the fewest stable substeps
  double first_cost = 0.0;             // [ms], of that attempt, with the repetition of the frame
  int attempts = 0, stalls = 0;
  bool is_open = true;
  double weight = 1.0;  // of its costs in comparisons
};

// Steps as short as the stability of explicit methods requires are far more accurate than long ones that just meet the goal, and their cost
// is certain: worth these factors.
double weight_of(const Integrator& method) {
  constexpr double implicit = 1.5, each_spring = 1.25;
  return method.implicit_solve != ImplicitSolve::None ? implicit : method.stability == Stability::EachSpring ? each_spring : 1.0;
}

std::vector<Candidate> candidates_for(Trials& trials, const Plan& plan, const Settings& settings, const Goal& goal,
                                      const MethodChoice* present) {
  const CostModel model(plan);
  std::vector<Candidate> list;
  const std::vector<int>& stable = trials.stable_substeps(plan, settings.frame_rate, goal.frequency);
  std::size_t row = 0;
  for (const Integrator* each : compared_methods()) {
    const Integrator& method = *each;
    const int stable_at = stable[row++];
    // explicit Euler grows, and what chooses its own steps has no number of them
    if (!method.for_production || method.stability == Stability::Adaptive) continue;
    if (&method == &leapfrog && !is_leapfrog_useful(plan)) continue;
    // what leaves a collider has its velocity of half a substep before, with which a frame of another method would go on
    if (method.velocity_lag != 0.0 && !plan.colliders.empty()) continue;
    if (stable_at > max_automatic_substeps) continue;
    const bool is_present = present != nullptr && &method == present->method;
    const int substeps = is_present ? std::max(present->substeps, stable_at) : stable_at;
    list.push_back({.method = &method,
                    .min_substeps = stable_at,
                    .substeps = substeps,
                    .expected_cost = model.expected(method, substeps),
                    .weight = weight_of(method)});
  }
  return list;
}

// The next number of substeps to try, or closes the candidate.
void refine(Candidate& candidate, const Trials::Result& result, double ratio, const Plan& plan, const System& system,
            const Settings& settings, const Goal& goal) {
  constexpr double max_increase = 1e4, on_divergence = 4.0;
  const bool has_stalled = candidate.attempts > 0 && ratio > 0.7 * candidate.ratio;
  candidate.stalls = has_stalled ? candidate.stalls + 1 : 0;
  candidate.ratio = ratio;
  ++candidate.attempts;
  const double cost_per_substep =
      std::isfinite(result.cost) ? result.cost / candidate.substeps : candidate.expected_cost / candidate.substeps;
  const double step = 1.0 / (settings.frame_rate * candidate.substeps);
  const int order = result.breaks ? 1 : optimistic_order(plan, system, *candidate.method, step);
  const double max_factor = std::isfinite(ratio) ? max_increase : on_divergence;
  int next = substeps_for(candidate.substeps, ratio * goal.target, goal.target, order, max_factor);
  // the most accurate attempt that the goal allows
  if (next * cost_per_substep > goal.max_cost) next = static_cast<int>(goal.max_cost / cost_per_substep);
  if (candidate.stalls > 1 || candidate.attempts >= max_attempts || next > max_automatic_substeps || next <= candidate.substeps)
    candidate.is_open = false;
  candidate.substeps = next;
  candidate.expected_cost = next * cost_per_substep;
}

// Where fast modes are overdamped, nothing vibrates within a frame, whose error with implicit Euler in n substeps of T / n is
//   e = T / (2 n) |v(T) - v(0)|,
// the sum of h^2 a / 2 over the substeps, without a trial. The velocities are those of the frame that was computed last.
void predict_implicit_euler(std::vector<Candidate>& list, const Trials& trials, const CostModel& model, const Settings& settings,
                            const Goal& goal) {
  constexpr double margin = 0.5;  // it may be half as large
  const double error = 0.5 / settings.frame_rate * trials.velocity_change();
  for (Candidate& candidate : list) {
    if (candidate.method != &implicit_euler || candidate.attempts > 0) continue;
    const double substeps = std::ceil(margin * error / goal.target);
    if (substeps <= candidate.substeps) continue;
    candidate.is_open = substeps <= max_automatic_substeps;
    candidate.substeps = candidate.is_open ? static_cast<int>(substeps) : candidate.substeps;
    candidate.expected_cost = model.expected(implicit_euler, candidate.substeps);
  }
}

// Frames until the methods should be compared again because one that would be much cheaper almost met the goal; 0: there is none. The
// closer it was, the larger the part of the cost of the frames in between that another attempt may have: a tenth at a fifth of the
// accuracy.
int frames_to_near_miss(const std::vector<Candidate>& list, const MethodChoice& best, const CostModel& model) {
  constexpr double max_ratio = 5.0 * acceptable_ratio, part_at_goal = 0.65;
  constexpr int min_frames = 2;
  double frames = infinity;
  for (const Candidate& candidate : list) {
    const bool is_much_cheaper = hysteresis_if_known * candidate.weight * model.expected(*candidate.method, candidate.min_substeps) <
                                 weight_of(*best.method) * best.cost;
    const bool is_near = candidate.first_ratio > acceptable_ratio && candidate.first_ratio <= max_ratio;
    const double part = part_at_goal * acceptable_ratio / candidate.first_ratio;
    if (candidate.method != best.method && is_much_cheaper && is_near)
      frames = std::min(frames, std::ceil(candidate.first_cost / (part * best.cost)));
  }
  return std::isfinite(frames) ? std::max(min_frames, static_cast<int>(frames)) : 0;
}

}  // namespace

double max_cost_of_frame(Trials& trials, const Plan& plan, const Settings& settings) {
  double cheapest = infinity;
  double explicit_one = 0.0;  // of the default method
  for (const Candidate& candidate : candidates_for(trials, plan, settings, {}, nullptr)) {
    cheapest = std::min(cheapest, candidate.expected_cost);
    if (candidate.method == &default_integrator()) explicit_one = candidate.expected_cost;
  }
  if (!std::isfinite(cheapest)) return infinity;
  if (settings.budget_ms > 0.0) return std::max(settings.budget_ms, cheapest);
  const double min_with_contact = explicit_one > 0.0 ? max_cost_with_contact_ms : max_implicit_cost_with_contact_ms;
  // the strain limit, too, is imposed once per substep, and may dissipate a part of the energy in each
  const bool is_of_first_order = plan.has_contact() || !plan.spring.max_length.empty();
  const double max_cost = is_of_first_order ? std::max({min_with_contact, max_cost_factor * cheapest, 4.0 * explicit_one})
                                            : std::max(max_cost_ms, max_cost_factor * cheapest);
  return std::min(max_cost, std::max(max_cost_ms, slow_cost_factor * cheapest));
}

// Convergence in position of XPBD is better than its declared order on many nets, unless they are overdamped, and that of the leapfrog
// where dashpots are weak: worth an attempt.
int optimistic_order(const Plan& plan, const System& system, const Integrator& method, double step) {
  if (is_splitting_saturated(method, plan.spectrum, step)) return 1;
  const int order = effective_order(system, method);
  const bool is_better = method.stability == Stability::EachSpring ? !is_overdamped(plan) : &method == &leapfrog && !has_contact(system);
  return is_better ? std::max(order, 2) : order;
}

int raised_substeps(const Plan& plan, const System& system, const Settings& settings, double ratio, bool is_temporary) {
  // one more of one or two costs half as much again or more
  constexpr int few = 2;
  if (is_temporary && settings.substeps <= few) return settings.substeps;
  // of which more would help little
  if (is_splitting_saturated(*settings.integrator, plan.spectrum, settings.substep())) return settings.substeps;
  const int order = effective_order(system, *settings.integrator);
  return substeps_for(settings.substeps, ratio, raised_ratio, order, acceptable_ratio * 2.0);
}

int substeps_for(int substeps, double error, double target, int order, double max_factor) {
  constexpr double margin = 1.05;
  const double factor = std::isfinite(error) ? margin * portable::pow(error / target, 1.0 / order) : max_factor;
  const double needed = std::ceil(substeps * std::min(factor, max_factor));
  return static_cast<int>(std::clamp(needed, substeps + 1.0, max_automatic_substeps + 1.0));
}

MethodChoice select_method(Trials& trials, const Plan& plan, const System& system, const Settings& settings, const Goal& goal,
                           const MethodChoice* present, Present knowledge) {
  MethodChoice best{.ratio = infinity};
  double best_cost = infinity, spent = 0.0;
  // an error beyond the target that is acceptable counts as meeting it at a higher cost: that of the next frames
  const auto counted_cost = [&](const Integrator& method, double ratio, double cost) {
    return ratio > 1.0 ? cost * portable::pow(ratio, 1.0 / optimistic_order(plan, system, method, 0.0)) : cost;
  };
  Settings trial = settings;
  trial.tolerance.reset();
  const CostModel model(plan);
  std::vector<Candidate> list = candidates_for(trials, plan, settings, goal, present);
  if (present != nullptr && knowledge == Present::Known) {
    best = *present;
    best_cost = counted_cost(*present->method, present->ratio, present->cost) / hysteresis_if_known;
    for (Candidate& candidate : list) candidate.is_open = candidate.method != present->method;
  } else if (present != nullptr) {
    const int order = effective_order(system, *present->method);
    for (Candidate& candidate : list) {
      const bool is_higher = effective_order(system, *candidate.method) > order;
      if (candidate.method != present->method) candidate.weight *= is_higher ? hysteresis_of_higher_order : hysteresis;
    }
  }
  const double max_spent = std::max(slow_comparison * goal.max_cost, max_comparison * std::min(goal.max_cost, max_cost_ms));
  while (spent <= max_spent * (std::isfinite(best.ratio) ? 1.0 : max_fruitless_comparison / max_comparison)) {
    // the one that would be the cheapest if it met the goal
    Candidate* next = nullptr;
    for (Candidate& candidate : list)
      if (candidate.is_open && (next == nullptr || candidate.weight * candidate.expected_cost < next->weight * next->expected_cost))
        next = &candidate;
    if (next == nullptr || (best.ratio <= acceptable_ratio && next->weight * next->expected_cost >= best_cost)) break;

    trial.integrator = next->method;
    trial.substeps = next->substeps;
    // one that turns out to be far more expensive than expected has to wait for the others
    const double cost_limit = max_cost_ratio * next->expected_cost;
    const double max_cost = std::min(cost_limit, best.ratio <= acceptable_ratio ? best_cost / next->weight : 1.25 * goal.max_cost);
    const double before = trials.total_cost();
    Trials::Result result = trials.measure(trial, max_cost, acceptable_ratio * goal.target);
    if (result.error <= acceptable_ratio * goal.target) result.error = std::max(result.error, trials.unresolved(trial));
    spent += trials.total_cost() - before;
    if (result.is_too_expensive && max_cost == cost_limit) {
      next->expected_cost = cost_limit;
      next->is_open = ++next->attempts < max_attempts;
      continue;
    }
    const double ratio = result.error / goal.target, cost = next->weight * counted_cost(*next->method, ratio, result.cost);
    const bool is_met = ratio <= acceptable_ratio, was_met = best.ratio <= acceptable_ratio;
    if (is_met ? !was_met || cost < best_cost : !was_met && ratio < best.ratio) {
      best = {.method = next->method,
              .substeps = next->substeps,
              .min_substeps = next->min_substeps,
              .ratio = ratio,
              .breaks = result.breaks,
              .cost = result.cost};
      best_cost = cost;
      trials.keep();
    }
    if (next->substeps == next->min_substeps) {
      next->first_ratio = ratio;
      next->first_cost = trials.total_cost() - before;
    }
    if (is_overdamped(plan) && !plan.has_contact() && next->method == &default_integrator())
      predict_implicit_euler(list, trials, model, settings, goal);
    if (is_met) {
      next->is_open = false;
      continue;
    }
    if (is_splitting_saturated(*next->method, plan.spectrum, trial.substep()))
      for (Candidate& other : list)
        if (&other != next && other.is_open && other.attempts == 0 && splits_dashpots(*other.method))
          refine(other, {.cost = other.expected_cost}, ratio, plan, system, settings, goal);
    refine(*next, result, ratio, plan, system, settings, goal);
  }
  // nothing could be measured: the candidate that needs the fewest substeps; without candidates an implicit method, as fine as it can be
  if (!std::isfinite(best.ratio) && list.empty()) {
    best = {.method = &stiff_integrator(), .substeps = max_automatic_substeps, .min_substeps = max_automatic_substeps, .ratio = infinity};
  } else if (!std::isfinite(best.ratio)) {
    const auto cheapest = std::ranges::min_element(list, {}, [](const Candidate& c) { return c.min_substeps; });
    best = {.method = cheapest->method, .substeps = cheapest->min_substeps, .min_substeps = cheapest->min_substeps, .ratio = infinity};
  }
  best.next_substeps = best.selected_substeps = best.substeps;
  best.until_selection = frames_to_near_miss(list, best, model);
  // more, where the error is acceptable for this frame alone
  if (best.ratio > 1.0 && best.ratio <= acceptable_ratio && goal.target > 0.0) {
    trial.integrator = best.method;
    trial.substeps = best.substeps;
    const int more = raised_substeps(plan, system, trial, best.ratio, best.until_selection > 0);
    if (more * best.cost <= goal.max_cost * best.substeps && more <= max_automatic_substeps) best.next_substeps = more;
  }
  // fewer, where the last attempt turned out to be more accurate than necessary
  constexpr double expected_ratio = 0.6;
  if (best.ratio < expected_ratio && best.method->stability != Stability::EachSpring) {
    const double factor = portable::pow(std::max(best.ratio, 1e-12) / expected_ratio, 1.0 / effective_order(system, *best.method));
    best.next_substeps = std::max(best.min_substeps, static_cast<int>(std::ceil(best.substeps * std::max(0.4, factor))));
  }
  return best;
}

}  // namespace hooke
