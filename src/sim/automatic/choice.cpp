#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "sim/automatic/automatic.h"
#include "sim/automatic/selection.h"
#include "sim/frame_error.h"
#include "sim/portable_math.h"

namespace hooke {
namespace {

// The estimate of a frame is not exact, and frames between two estimates differ: aim at this part of the tolerance.
constexpr double aimed_part = 0.3;
// Frames between two estimates, also where the error is far below the tolerance; and between two comparisons of methods.
constexpr int min_period = 3, max_period = 32, max_easy_period = 96, min_interval = 10, max_interval = 1280;
// A change of speed by this factor within a frame is an event: an impact, a jump of the hand, a release. So is one by these factors since
// the last estimate; the larger ones where the error is far below the tolerance.
constexpr double event_factor = 1.3, easy_event_factor = 2.1, drift_factor = 2.0, easy_drift_factor = 4.0;
// The part of the target below which an error is far below the tolerance.
constexpr double easy_ratio = 0.05;

// What the motion and the stability of the methods depend on, as one number, to notice edits: 53 bits of a hash (FNV-1a, by words).
// Without what moves by itself: the hand and colliders.
double rates_of(const Plan& plan) {
  std::uint64_t hash = 0xcbf29ce484222325;
  const auto add = [&](double value) { hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3; };
  const auto add_vector = [&](const Vec3& value) { add(value.x), add(value.y), add(value.z); };
  const Spectrum& s = plan.spectrum;
  for (const double value : {s.omega, s.dashpot_rate, s.force_omega, s.force_rate, s.drag_rate}) add(value);
  for (const auto* values : {&plan.mass, &plan.inverse_mass, &plan.radius, &plan.stiffness, &plan.rest_length, &plan.damping,
                             &plan.max_length, &plan.break_length})
    for (const double value : *values) add(value);
  for (const Force& force : plan.forces)
    for (const double value : force.values) add(value);
  for (const Collider& collider : plan.colliders) add(collider.restitution), add(collider.friction);
  if (plan.pairs.on) add(plan.pairs.thickness), add(plan.pairs.restitution), add(plan.pairs.friction);
  add(plan.held ? 1.0 : plan.grabbed_collider ? 2.0 : 0.0);
  if (plan.pull) add(plan.pull->stiffness);
  add_vector(plan.acceleration);
  // the high bits depend on all others
  hash ^= hash >> 32;
  hash *= 0xd6e8feb86659fd93;
  return static_cast<double>(hash >> 11);
}

// [m/s], a measure of how fast the scene and the hand move.
double speed_of(const Plan& plan, const State& state, double frame) {
  double sum = 0.0;
  for (const Vec3& v : state.velocity) sum += glm::dot(v, v);
  const double rms = state.velocity.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(state.velocity.size()));
  double hand = 0.0;
  if (plan.pull) hand = glm::length(plan.pull->velocity);
  if (plan.grabbed_collider) hand = std::max(hand, glm::length(plan.grabbed_collider->velocity));
  if (plan.held) hand = std::max(hand, glm::length(state.hand.target - state.hand.position) / frame);
  return rms + hand + frame * glm::length(plan.gravity) + 1e-9;
}

bool differ(double a, double b, double factor) { return a > factor * b || b > factor * a; }

// Estimates the error of the coming frame with the present method, and adapts the substeps. False if so many more are needed that another
// method may be cheaper: then `choice` has that number.
bool follow(MethodChoice& choice, Trials& trials, const System& system, const Settings& settings, const Goal& goal, bool is_sudden,
            double max_increase) {
  constexpr int max_attempts = 6;
  const double before = choice.ratio;
  const int order = effective_order(system, *choice.method);
  Settings trial = settings;
  trial.tolerance.reset();
  trial.integrator = choice.method;
  const bool has_stable_half = choice.substeps / 2 >= choice.min_substeps && choice.method->implicit_solve == ImplicitSolve::None;
  const bool is_by_coarser = has_stable_half && order > 1 && before > easy_ratio && !is_sudden;
  const auto measure = [&](int substeps, bool by_coarser) {
    trial.substeps = substeps;
    const double max_cost = 1.25 * goal.max_cost;
    const Trials::Result result = by_coarser ? trials.measure_by_coarser(trial, max_cost) : trials.measure(trial, max_cost);
    return std::pair(result.error / goal.target, result.cost);
  };
  std::tie(choice.ratio, choice.cost) = measure(choice.substeps, is_by_coarser);
  const bool is_missed = choice.ratio > 1.0;
  for (int attempt = 0; choice.ratio > 1.0 && choice.substeps < max_automatic_substeps && attempt < max_attempts; ++attempt) {
    const int needed = std::min(max_automatic_substeps, substeps_for(choice.substeps, choice.ratio * goal.target, goal.target, order, 4.0));
    const double affordable = std::isfinite(choice.cost) ? choice.substeps * goal.max_cost / choice.cost : needed;
    const int more = static_cast<int>(std::min<double>(needed, affordable));
    if (more <= choice.substeps) break;
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
    if (has_stalled) break;
  }
  const bool is_easy = choice.ratio < easy_ratio && before < easy_ratio, is_regular = is_easy || !differ(choice.ratio, before, 2.0);
  if (choice.ratio > 1.0)  // it cannot be met now: do not try in every frame
    choice.period = std::min(max_period, 2 * choice.period);
  else if (is_missed)
    choice.period = 1;
  else
    choice.period = is_regular && !is_sudden ? std::min(is_easy ? max_easy_period : max_period, 2 * choice.period) : min_period;
  choice.until_estimate = choice.period;
  if (choice.ratio <= 1.0 && choice.substeps > choice.min_substeps) {
    // PI control (Gustafsson 1991), which lowers the number slowly
    const double p = order;
    const double factor =
        portable::pow(std::max(choice.ratio, 1e-12) / 0.9, 0.7 / p) * portable::pow(std::clamp(before, 1e-12, 1e12), -0.4 / p);
    const int fewer = std::max(choice.min_substeps, static_cast<int>(std::ceil(choice.substeps * std::clamp(factor, 0.4, 1.0))));
    const double part = static_cast<double>(fewer) / choice.substeps;
    choice.substeps = fewer;
    choice.ratio *= portable::pow(part, -p);
    choice.cost *= part;
  }
  return true;
}

}  // namespace

AutomaticChoice::AutomaticChoice() = default;
AutomaticChoice::~AutomaticChoice() = default;
AutomaticChoice::AutomaticChoice(AutomaticChoice&& other) noexcept = default;
AutomaticChoice& AutomaticChoice::operator=(AutomaticChoice&& other) noexcept = default;

double AutomaticChoice::trial_cost() const { return trials_ ? trials_->total_cost() : 0.0; }

MethodChoice AutomaticChoice::choose(const Plan& plan, const System& system, const Settings& settings, const State& state) {
  const double frame = 1.0 / settings.frame_rate;
  const double target = aimed_part * automatic_tolerance(settings) * frame;
  const double rates = rates_of(plan), speed = speed_of(plan, state, frame);
  if (!trials_) trials_ = std::make_unique<Trials>();
  const auto begin = [&]() -> Goal {
    trials_->begin(plan, system, state);
    return {target, max_cost_of_frame(*trials_, plan, settings)};
  };
  MethodChoice choice;
  const auto select = [&](const MethodChoice* last, bool is_sudden) {
    choice = select_method(*trials_, plan, system, settings, begin(), last);
    const bool is_confirmed = last != nullptr && last->method == choice.method && last->selected_substeps > 0;
    choice.interval = is_confirmed ? std::min(max_interval, 2 * last->interval) : min_interval;
    choice.until_selection = choice.interval;
    choice.until_estimate = choice.period = choice.ratio < easy_ratio && !is_sudden ? 4 * min_period : min_period;
  };

  if (!state.memory.choice) {
    select(nullptr, false);
  } else {
    const MethodChoice last = *state.memory.choice;
    choice = last;
    --choice.until_estimate;
    --choice.until_selection;
    const bool is_edited = choice.rates != rates || choice.target != target || choice.budget != settings.budget_ms;
    const bool is_easy = choice.ratio < easy_ratio;
    const bool is_event = differ(speed, choice.speed, is_easy ? easy_event_factor : event_factor) ||
                          differ(speed, choice.estimated_speed, is_easy ? easy_drift_factor : drift_factor);
    choice.speed = speed;
    bool must_select = false;
    if (is_edited) {
      choice.min_substeps = stable_substeps(*choice.method, plan.spectrum, settings.frame_rate);
      must_select = choice.min_substeps > std::min(max_automatic_substeps, 4 * last.substeps) || choice.target != target ||
                    choice.budget != settings.budget_ms;
      choice.substeps = std::max(choice.substeps, choice.min_substeps);
      // while a slider moves, only the substeps follow, unless they become far too many
      choice.selected_substeps = 0;
      choice.interval = min_interval;
      choice.until_selection = std::clamp(choice.until_selection, 1, 10);
    }
    if (!is_edited && !is_event && choice.until_estimate > 0) return choice;

    // comparing methods costs as much as some tens of frames
    const bool has_hand = plan.held || plan.pull || plan.grabbed_collider;
    const bool has_changed = choice.selected_substeps == 0 || differ(choice.substeps, choice.selected_substeps, 2.0) ||
                             (differ(choice.ratio, choice.selected_ratio, 8.0) && choice.ratio < 0.1);
    if (must_select || (choice.until_selection <= 0 && has_changed && !has_hand)) {
      select(&last, is_event || is_edited);
    } else if (!follow(choice, *trials_, system, settings, begin(), is_event || is_edited, has_hand ? 5.0 : 2.0)) {
      const MethodChoice present = choice;
      select(&present, is_event || is_edited);
    }
  }
  choice.rates = rates;
  choice.target = target;
  choice.budget = settings.budget_ms;
  choice.speed = choice.estimated_speed = speed;
  return choice;
}

}  // namespace hooke
