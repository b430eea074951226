#include "lab/accuracy/accuracy_meter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lab/accuracy/accuracy_text.h"
#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "sim/forces/energy/energy.h"
#include "sim/model/bounding_box.h"

namespace hooke {
namespace {

// One frame in this many is repeated, at twice its cost: 5 % of the run.
constexpr int repetition_period = 40;
// [s], of simulated time: where the cost of the second runs is accepted anyway, the next one follows in less, so that no older value is
// shown.
constexpr double max_age = 0.16;

int repetition_period_of(double frame_rate, bool is_short) {
  return is_short ? static_cast<int>(std::clamp(max_age * frame_rate, 1.0, static_cast<double>(repetition_period))) : repetition_period;
}
// Where things touch, impacts, friction and points that stick decide how fast the error falls with the step: every fourth repeated frame
// is also computed with a quarter of the step, at four times its cost.
constexpr int order_period = 4;
// Springs that pass through zero length between two steps turn by as much as chance has it: as wrong as with half the step, and the
// distance between the two says nothing. It shows where a quarter of the step is farther from half of it than half of it from the step.
// Frames whose errors are smaller than this, relative to the size, are accurate enough.
constexpr double min_unresolved = 1e-5;
// A distance of more than this part of the motion is an error nevertheless.
constexpr double min_certain = 0.05;
constexpr std::string_view passes_through_zero = "springs pass through zero length faster than the steps resolve";
// Where steps and halves of them end at the same phases of an oscillation, nothing shows how wrong both are.
constexpr std::string_view oscillates_too_fast = "a collider or muscle oscillates faster than the steps resolve";
// Below this order, half the error costs more than four times the time, if it can be had at all.
constexpr double min_order = 0.5;
// Errors of this fraction of the scene's size are no longer small: beyond it the trajectory is not predictable.
constexpr double max_error = 0.1;
// A method that dissipated more than this part of the highest kinetic energy, and more than the scene did, has changed the motion so much
// that it does with half the step, too: their distance says no more how far both are from the exact motion. Up to it, it says so within a
// factor of 3 for motion that decays exponentially, which with half the step of a method of first order lasts twice as long.
constexpr double max_dissipated_part = 0.9;
// Rounding errors, relative to the size.
constexpr double round_off = 1e-15;

// Largest extent of the scene [m]; of a single point 1 m.
double size_of(const State& state) {
  const double largest = bounding_box(state.position).longest_side();
  return largest > 0.0 ? largest : 1.0;
}

}  // namespace

void AccuracyMeter::set_mode(AccuracyMode mode) {
  if (mode == mode_) return;
  mode_ = mode;
  restart();
}

void AccuracyMeter::restart() {
  is_started_ = false;
  repetition_.reset();
  second_runs_.restart(size_);
}

void AccuracyMeter::note_edit() {
  is_edited_ = true;
  repetition_.reset();
  second_runs_.note_edit();
}

void AccuracyMeter::add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                              const Motion& motion, double energy_before, double energy) {
  if (mode_ == AccuracyMode::Off || system.point_count() == 0) return;
  const bool is_started_now = !is_started_;
  if (is_started_now) {
    is_started_ = true;
    is_edited_ = false;
    size_ = size_of(before);
    energy_.start(before, energy_before);
    past_ = {.max_kinetic = kinetic_energy(system, before)};
    start_.clear();
    motion_ = 0.0;
    second_runs_.restart(size_);
  }
  // the order depends on every spring: determined again only when it may have changed
  if (is_started_now || is_edited_ || method_ != settings.integrator) {
    order_ = effective_order(system, *settings.integrator);
    const bool adapts = settings.integrator->stability == Stability::Adaptive;
    const bool is_corrected = has_contact(system) || system.contact.any() || system.strain_limit > 0.0;
    touches_ = is_corrected && !adapts;
    ignores_tolerance_ = is_corrected && adapts;
    refinement_.reset();
    repetitions_ = 0;
  }
  method_ = settings.integrator;
  past_.has_broken = past_.has_broken || motion.counts.breaks > 0;
  past_.is_smooth = past_.is_smooth && !touches_ && !ignores_tolerance_ && !past_.has_broken && !plan.hand.held && !plan.hand.pull;
  past_.is_aliased = past_.is_aliased || !resolves_oscillations(plan, settings_used(settings, after));
  energy_.add_frame(plan, before, after, motion, energy);
  past_.supplied = after.supply.scale;
  past_.max_kinetic = std::max(past_.max_kinetic, kinetic_energy(system, after));

  ++frames_since_repetition_;
  const bool is_first = !repetition_.result() && !repetition_.has_failed();
  // the first frame in which something touches may be a thousand times as wrong as those before it
  const bool is_touching = motion.energy[EnergyCause::Contact] != 0.0 || motion.counts.contact_impulses > 0;
  const bool is_impact = !std::exchange(was_touching_, is_touching) && is_touching;
  const bool is_due = is_first || is_impact || is_edited_ ||
                      frames_since_repetition_ >= repetition_period_of(settings.frame_rate, mode_ == AccuracyMode::Full);
  // what a method gains where a spring breaks says nothing of the frames that follow
  if (is_due && motion.counts.breaks == 0 && (is_impact || !repetition_.is_in_progress())) {
    const bool collapses = settings.integrator->stability != Stability::Adaptive && !is_automatic(settings) && can_collapse(system, before);
    collapses_ = collapses && !touches_;
    repetition_.begin(plan, system, settings, before, after, motion.counts.force_evaluations,
                      (touches_ || collapses_) && repetitions_++ % order_period == 0);
    frames_since_repetition_ = 0;
    is_urgent_ = is_first || is_impact || is_edited_;
    is_edited_ = false;
  }
  if (mode_ != AccuracyMode::Full) return;
  if (start_.empty()) start_ = before.position;
  motion_ = std::max(motion_, weighted_distance(system, after.position, start_, 1.0).rms);
  second_runs_.add_frame(plan, system, settings, before, after, motion.counts.force_evaluations);
}

void AccuracyMeter::repeat(const System& system) {
  repetition_.substep(system);
  if (repetition_.is_in_progress() || !repetition_.result()) return;
  if (const auto& refinement = repetition_.result()->refinement) {
    constexpr double kept = 0.5;
    if (!refinement_) refinement_.emplace();
    refinement_->by_half = kept * refinement_->by_half + refinement->by_half;
    refinement_->by_quarter = kept * refinement_->by_quarter + refinement->by_quarter;
    if (collapses_ && refinement->by_quarter > std::max(refinement->by_half, min_unresolved * size_)) past_.is_unresolved = true;
  }
}

void AccuracyMeter::measure_frame(Accuracy& accuracy) const {
  const auto& result = repetition_.result();
  std::string_view reason;
  if (is_started_ && !is_edited_ && repetition_.has_failed())
    reason = "with half the step, or a smaller tolerance, this frame fails or takes too long";
  else if (is_started_ && is_edited_)
    reason = "not yet measured since the last edit";
  else if (!is_started_ || !result)
    reason = "not measured yet";
  else if (!std::isfinite(result->error.rms))
    reason = "with half the step this frame diverges";
  else if (past_.is_aliased)
    reason = oscillates_too_fast;
  if (!reason.empty()) {
    accuracy.frame.reason = accuracy.frame_max.reason = reason;
    return;
  }
  accuracy.frame.value = result->error.rms;
  accuracy.frame_max.value = result->error.max;
  accuracy.frame_time = result->time;
}

bool AccuracyMeter::is_damped_by_method() const {
  const EnergyBalance& balance = energy_.balance();
  using enum EnergyCause;
  const EnergyLedger& ledger = balance.ledger;
  const double by_scene = -(ledger[Drag] + ledger[Dashpots] + ledger[Contact] + std::min(0.0, ledger.forces()));
  return -balance.method() > std::max(max_dissipated_part * past_.max_kinetic, by_scene);
}

void AccuracyMeter::measure_run(Accuracy& accuracy) const {
  const auto& error = second_runs_.error();
  const auto& growth = second_runs_.growth();
  accuracy.since = second_runs_.since();
  accuracy.motion = motion_;
  accuracy.is_smooth = past_.is_smooth;
  const bool is_chaotic = growth && growth->rate > 0.0;
  if (mode_ != AccuracyMode::Full) {
    accuracy.accumulated.reason = accuracy.amplification.reason = "the second runs are switched off";
  } else {
    const auto lose = [&](Loss loss, std::string_view reason) {
      accuracy.loss = loss;
      accuracy.accumulated.reason = reason;
    };
    if (!is_started_ || !error)
      accuracy.accumulated.reason = "not measured yet";
    else if (second_runs_.failed())
      lose(Loss::NoSecondRun, "the run with half the step, or a smaller tolerance, failed or took too long");
    else if (second_runs_.diverged())
      lose(Loss::HalfStepDiverged, "the run with half the step diverged");
    else if (is_chaotic && error->rms > max_error * size_)
      lose(Loss::Unpredictable, "beyond the time for which the motion can be predicted");
    else if (past_.is_unresolved && error->rms < min_certain * motion_)
      lose(Loss::Unresolved, passes_through_zero);
    else if (past_.is_aliased)
      lose(Loss::Unresolved, oscillates_too_fast);
    else if (!second_runs_.is_resolving() && is_damped_by_method())
      lose(Loss::Dissipated, "the method dissipated the motion, and would with half the step");
    else
      accuracy.accumulated.value = error->rms;
    if (error) accuracy.accumulated_time = error->time;
    if (const auto& max = second_runs_.max_error(); max && !past_.is_aliased) {
      accuracy.max_accumulated.error = max->rms;
      accuracy.max_accumulated.time = max->time;
    }
    if (!growth) accuracy.amplification.reason = "measured after a second without edits";
  }
  if (growth && accuracy.amplification.reason.empty()) {
    accuracy.amplification.value = growth->amplification;
    accuracy.growth_rate.value = growth->rate;
  }
  accuracy.growth_rate.reason = accuracy.predictable.reason = accuracy.amplification.reason;
  if (!growth || !accuracy.amplification.value) return;
  if (!is_chaotic)
    accuracy.predictable.value = std::numeric_limits<double>::infinity();
  else if (error)
    accuracy.predictable.value = std::max(0.0, std::log(max_error * size_ / std::max(error->rms, round_off * size_)) / growth->rate);
  else
    accuracy.predictable.reason = accuracy.accumulated.reason;
}

Accuracy AccuracyMeter::accuracy(const Settings& settings) const {
  Accuracy accuracy{.is_on = mode_ != AccuracyMode::Off, .size = size_};
  if (is_started_) {
    accuracy.energy = energy_.balance();
    accuracy.energy.scale = past_.supplied;
  }
  if (!accuracy.is_on) {
    for (Measured* each : {&accuracy.frame, &accuracy.frame_max, &accuracy.accumulated, &accuracy.amplification, &accuracy.growth_rate,
                           &accuracy.predictable})
      each->reason = "switched off";
    return accuracy;
  }
  measure_frame(accuracy);
  measure_run(accuracy);
  measure_half_error(settings, accuracy);
  return accuracy;
}

void AccuracyMeter::measure_half_error(const Settings& settings, Accuracy& accuracy) const {
  accuracy.half_error.reason = "no frame yet";
  if (!is_started_) return;
  // springs break at the ends of substeps, whatever the method
  double order = past_.has_broken ? 1 : order_;
  const bool adapts = settings.integrator->stability == Stability::Adaptive;
  if (ignores_tolerance_ || (past_.has_broken && adapts && !is_automatic(settings))) {
    accuracy.half_error.reason = ignores_tolerance_ ? "contact and the strain limit hardly depend on the tolerance"
                                                    : "the time at which springs break does not depend on the tolerance";
    return;
  }
  if (past_.is_unresolved || past_.is_aliased) {
    accuracy.half_error.reason = past_.is_unresolved ? passes_through_zero : oscillates_too_fast;
    return;
  }
  if (touches_) {
    accuracy.half_error.reason = "not measured yet";
    if (!refinement_) return;
    accuracy.half_error.reason = half_step_does_not_help;
    if (!(refinement_->by_half >= std::exp2(min_order) * refinement_->by_quarter)) return;
    if (refinement_->by_quarter > 0.0) order = std::min(order, std::log2(refinement_->by_half / refinement_->by_quarter));
  }
  accuracy.half_error.reason = {};
  // the error of order p falls by 2^p when the step is halved
  const double factor = std::exp2(1.0 / order);
  accuracy.half_error.substeps = static_cast<int>(std::ceil(factor * settings.substeps));
  accuracy.half_error.cost = static_cast<double>(accuracy.half_error.substeps) / settings.substeps;
  if (settings.integrator->stability != Stability::Adaptive) return;
  accuracy.half_error.tolerance = 0.5 * settings.tolerance.value_or(default_tolerance);
  accuracy.half_error.cost = factor;
}

}  // namespace hooke
