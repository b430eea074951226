#include "sim/automatic/trials.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "sim/divergence.h"
#include "sim/frame_error.h"
#include "sim/portable_math.h"

namespace hooke {

int stable_substeps(const Integrator& method, const Spectrum& spectrum, double frame_rate) {
  const double step = largest_stable_step(method, spectrum);
  if (!std::isfinite(step)) return 1;
  const double substeps = std::ceil(1.0 / (frame_rate * step));
  return !(substeps <= max_automatic_substeps) ? max_automatic_substeps + 1 : std::max(1, static_cast<int>(substeps));
}

const std::vector<int>& Trials::stable_substeps(const Plan& plan, double frame_rate) {
  if (stable_substeps_.empty() || spectrum_ != plan.spectrum || frame_rate_ != frame_rate) {
    stable_substeps_.clear();
    for (const Integrator& method : integrators()) stable_substeps_.push_back(hooke::stable_substeps(method, plan.spectrum, frame_rate));
    spectrum_ = plan.spectrum;
    frame_rate_ = frame_rate;
  }
  return stable_substeps_;
}

void Trials::begin(const Plan& plan, const System& system, const State& start) {
  plan_ = plan;
  system_ = &system;
  start_ = &start;
}

// A frame that ends early has diverged.
Trials::End Trials::compute(const Settings& settings, const CostModel& model, double max_cost, double* cost) {
  if (!plan_.break_length.empty()) refresh_values(plan_, *system_);  // restores springs that broke in the previous trial
  bool is_cheap = true;
  try {
    frame_.begin(plan_, *system_, settings, *start_);
    while (!frame_.done() && is_cheap) {
      frame_.substep(plan_);
      is_cheap = model.of(*settings.integrator, frame_.motion()) <= max_cost;
    }
  } catch (const InputError&) {  // the factorization of an implicit method would need too much memory
    return End::Diverged;
  }
  *cost = model.of(*settings.integrator, frame_.motion());
  total_cost_ += *cost;
  if (!is_cheap) return End::TooExpensive;
  end_ = *start_;
  frame_.end(plan_, end_);
  return frame_.failure() == StepFailure::None && is_finite(end_) ? End::Finished : End::Diverged;
}

Trials::Result Trials::measure_by_coarser(const Settings& settings, double max_cost) {
  const CostModel model(plan_);
  Result result;
  Settings coarse = settings;
  coarse.substeps = settings.substeps / 2;
  double coarse_cost = 0.0;
  const End coarse_end = compute(coarse, model, max_cost, &coarse_cost);
  if (coarse_end != End::Finished) return {.is_too_expensive = coarse_end == End::TooExpensive};
  coarse_ = end_.position;
  const End end = compute(settings, model, max_cost, &result.cost);
  if (end == End::TooExpensive) return {.is_too_expensive = true};
  if (end == End::Diverged) return result;
  const double ratio = static_cast<double>(settings.substeps) / coarse.substeps;
  const double order = effective_order(*system_, *settings.integrator);
  result.error = weighted_distance(coarse_, end_.position, 1.0 / (portable::pow(ratio, order) - 1.0)).rms;
  return result;
}

Trials::Result Trials::measure(const Settings& settings, double max_cost) {
  const CostModel model(plan_);
  Result result;
  Settings fine = settings;
  fine.substeps *= 2;
  double fine_cost = 0.0;
  const End end = compute(settings, model, max_cost, &result.cost);
  if (end == End::TooExpensive) return {.is_too_expensive = true};
  if (end == End::Diverged) return result;
  coarse_ = end_.position;
  // a method that iterates less in shorter steps costs less than twice as much, but not much more
  const End fine_end = compute(fine, model, 4.0 * max_cost, &fine_cost);
  if (fine_end == End::TooExpensive) return {.is_too_expensive = true};
  if (fine_end == End::Diverged) return result;
  result.error = weighted_distance(coarse_, end_.position, refinement_weight(*system_, settings)).rms;
  return result;
}

}  // namespace hooke
