#include "sim/step/automatic/trials.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "sim/contact/gap.h"
#include "sim/methods/rows.h"
#include "sim/model/portable_math.h"
#include "sim/step/automatic/breaking.h"
#include "sim/step/automatic/leapfrog.h"
#include "sim/step/automatic/resonance.h"
#include "sim/step/divergence.h"
#include "sim/step/frame_error.h"

namespace hooke {
namespace {

// Where dashpots decay within a part of a step, splitting them off is of an order below the declared one, and the distance to half the step
// is only a part of the error: up to an eighth, measured on nets with d = 9 and 1e3 N s/m.
double order_reduction(const Settings& settings, const Spectrum& spectrum) {
  if (is_splitting_saturated(*settings.integrator, spectrum, settings.substep())) return 8.0;
  return !splits_dashpots(*settings.integrator) || spectrum.dashpot_rate * settings.substep() < 1.0 ? 1.0 : 2.0;
}

// Of the repetition that an error is estimated from: half the step, or for explicit methods, which converge as declared, two thirds of it,
// which costs less.
int refined_substeps(const Settings& settings) {
  const Integrator& method = *settings.integrator;
  const bool is_regular = method.implicit_solve == ImplicitSolve::None && method.stability != Stability::EachSpring;
  return is_regular ? settings.substeps + (settings.substeps + 1) / 2 : 2 * settings.substeps;
}

// Contact limits the step of every method, also of those that damp fast modes at once. Where nothing within these limits takes less than
// `slow` [ms] a frame, the latter may take any step: their error with contact is measured like any other, and a frame of seconds is of no
// use.
void free_from_contact(const Plan& plan, std::vector<int>& substeps) {
  constexpr double slow = 400.0;
  const CostModel model(plan);
  const std::span<const Integrator* const> methods = compared_methods();
  for (std::size_t row = 0; row < methods.size(); ++row) {
    const bool is_usable = methods[row]->for_production && methods[row]->stability != Stability::Adaptive;
    if (is_usable && substeps[row] <= max_automatic_substeps && model.expected(*methods[row], substeps[row]) <= slow) return;
  }
  for (std::size_t row = 0; row < methods.size(); ++row)
    if (methods[row]->stability == Stability::LStable && methods[row]->implicit_force_terms) substeps[row] = 1;
}

}  // namespace

bool is_splitting_saturated(const Integrator& method, const Spectrum& spectrum, double step) {
  return splits_dashpots(method) && spectrum.dashpot_rate * step >= 4.0;
}

std::span<const Integrator* const> compared_methods() {
#define ROW(name) &(name),
  static constexpr const Integrator* methods[] = {
#include "sim/methods/list.inc"
      &leapfrog,
  };
#undef ROW
  return methods;
}

int stable_substeps(const Integrator& method, const Spectrum& spectrum, double frame_rate) {
  const double step = largest_stable_step(method, spectrum);
  if (!std::isfinite(step)) return 1;
  const double substeps = std::ceil(1.0 / (frame_rate * step));
  return !(substeps <= max_automatic_substeps) ? max_automatic_substeps + 1 : std::max(1, static_cast<int>(substeps));
}

int collider_substeps(const Plan& plan, double frame_rate) {
  const double substeps = std::ceil(1.0 / (frame_rate * plan.collider_paths.resolving_step) * (1.0 - 1e-9));
  return static_cast<int>(std::clamp(substeps, 1.0, max_automatic_substeps + 1.0));
}

const std::vector<int>& Trials::stable_substeps(const Plan& plan, double frame_rate, double frequency) {
  const bool is_new = stable_for_any_.empty() || spectrum_ != plan.spectrum || frame_rate_ != frame_rate;
  if (is_new) {
    stable_for_any_.clear();
    for (const Integrator* method : compared_methods())
      stable_for_any_.push_back(hooke::stable_substeps(*method, plan.spectrum, frame_rate));
    spectrum_ = plan.spectrum;
    frame_rate_ = frame_rate;
  }
  if (is_new || resolving_step_ != plan.collider_paths.resolving_step || frequency_ != frequency ||
      is_beyond_resonance_ != beyond_resonance_) {
    stable_substeps_ = stable_for_any_;
    for (std::size_t row = 0; row < stable_substeps_.size(); ++row) {
      int& substeps = stable_substeps_[row];
      if (substeps > max_automatic_substeps) continue;
      substeps = std::max(1, static_cast<int>(std::ceil(frequency * substeps)));
      if (beyond_resonance_) substeps = substeps_beyond_resonance(*compared_methods()[row], spectrum_, frame_rate, frequency, substeps);
    }
    if (plan.spectrum.contact) free_from_contact(plan, stable_substeps_);
    const int resolving = collider_substeps(plan, frame_rate);
    for (int& substeps : stable_substeps_) substeps = std::max(substeps, resolving);
    resolving_step_ = plan.collider_paths.resolving_step;
    frequency_ = frequency;
    is_beyond_resonance_ = beyond_resonance_;
  }
  return stable_substeps_;
}

int Trials::stable_substeps(const Integrator& method, const Plan& plan, double frame_rate, double frequency) {
  const std::vector<int>& list = stable_substeps(plan, frame_rate, frequency);
  const std::span<const Integrator* const> methods = compared_methods();
  const auto row = std::ranges::find(methods, &method) - methods.begin();
  return row < std::ssize(list) ? list[static_cast<std::size_t>(row)] : 1;
}

double Trials::bound_frequency(const Plan& plan, const State& state, double frame_rate, double frame_cost) {
  // it saves at most a third
  constexpr double saved = 0.3;
  if (bound_.cost(plan) > saved * frames_per_bound * frame_cost) return 1.0;
  const double frequency = bound_.relative(plan, state, frames_per_bound / frame_rate);
  total_cost_ += bound_.cost(plan);
  return frequency;
}

void Trials::begin(const Plan& plan, const System& system, const State& start) {
  plan_ = plan;
  system_ = &system;
  start_ = &start;
  resolved_positions_.clear();
}

void Trials::forget(bool beyond_resonance) {
  last_.method = kept_.method = nullptr;
  beyond_resonance_ = beyond_resonance;
}

// A frame that ends early has diverged.
Trials::End Trials::compute(const Settings& settings, const CostModel& model, double max_cost, double* cost) {
  if (!plan_.spring.break_length.empty()) refresh_values(plan_, *system_);  // restores springs that broke in the previous trial
  const auto cost_so_far = [&] { return model.of(*settings.integrator, frame_.motion(), frame_.substeps_done()); };
  bool is_cheap = true;
  frame_.begin(plan_, *system_, settings, *start_);
  while (!frame_.done() && is_cheap) {
    frame_.substep(plan_);
    is_cheap = cost_so_far() <= max_cost;
  }
  if (frame_.failure() == StepFailure::MatrixTooLarge) return End::Diverged;
  *cost = cost_so_far();
  total_cost_ += *cost;
  if (!is_cheap) return End::TooExpensive;
  end_ = *start_;
  frame_.end(plan_, end_);
  return frame_.failure() == StepFailure::None && is_finite(end_) ? End::Finished : End::Diverged;
}

Trials::End Trials::compute_frame(const Settings& settings, double max_cost, double* cost) {
  if (last_.method == settings.integrator && last_.substeps == settings.substeps) {
    *cost = last_.cost;
    return last_.cost <= max_cost ? End::Finished : End::TooExpensive;
  }
  last_.method = nullptr;
  if (const End end = compute(settings, CostModel(plan_), max_cost, cost); end != End::Finished) return end;
  std::swap(frame_, last_.frame);
  last_.method = settings.integrator;
  last_.substeps = settings.substeps;
  last_.cost = *cost;
  last_positions_ = end_.position;
  last_velocities_ = end_.velocity;
  return End::Finished;
}

// Whether the point is on a collider at the start of the frame, or as close [m] as `max_error`.
bool Trials::starts_on_collider(std::size_t point, double max_error) const {
  for (std::size_t c = 0; c < plan_.colliders.size(); ++c) {
    const Vec3 x = start_->position[point] - plan_.offset_of(c, start_->time);
    if (gap_to(plan_.colliders[c], plan_.radius[point], x).distance <= max_error) return true;
  }
  return false;
}

// [m], RMS over the points, of what would be an impact a substep too late in the frame that was computed last; 0: there is none. What is
// closer to a collider than `resolution` [m] is on it.
double Trials::impact_error(double resolution) const {
  if (last_.method == nullptr) return 0.0;
  // by a method of first order, the error is half of this under any change of the velocity, as of what has just left the ground
  const bool is_of_first_order = last_.method->order == 1;
  if (!is_of_first_order && !last_.frame.has_touched()) return 0.0;
  const Vec3 fall = last_.frame.duration() * plan_.gravity;
  double sum = 0.0;  // of the squared changes of velocity that are neither rest nor free fall, unless it begins in this frame
  for (std::size_t i = 0; i < last_velocities_.size(); ++i) {
    const Vec3 change = last_velocities_[i] - start_->velocity[i];
    const double square = glm::dot(change, change), from_fall = glm::dot(change - fall, change - fall);
    const bool falls = from_fall < square && !is_of_first_order && !starts_on_collider(i, resolution);
    sum += falls ? from_fall : square;
  }
  const double rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, last_velocities_.size())));
  const double part = is_of_first_order && !last_.frame.has_touched() ? 0.5 : 1.0;
  return part * rms * last_.frame.duration() / last_.substeps;
}

int Trials::resolving_substeps(double frame_rate) {
  constexpr int margin = 4;
  return margin * stable_substeps(default_integrator(), plan_, frame_rate, frequency_);
}

bool Trials::breaks_if_resolved(const Settings& settings, int substeps, double max_cost) {
  if (substeps > max_automatic_substeps) return false;
  Settings fine = settings;
  fine.tolerance.reset();
  fine.integrator = &default_integrator();
  fine.substeps = substeps;
  double cost = 0.0;
  return compute(fine, CostModel(plan_), max_cost, &cost) == End::Finished && !frame_.broken().empty();
}

Trials::Result Trials::measure_by_coarser(const Settings& settings, double max_cost) {
  const CostModel model(plan_);
  Result result;
  Settings coarse = settings;
  coarse.substeps = settings.substeps / 2;
  double coarse_cost = 0.0;
  const End end = compute_frame(settings, max_cost, &result.cost);
  if (end == End::TooExpensive) return {.is_too_expensive = true};
  if (end == End::Diverged) return result;
  const End coarse_end = compute(coarse, model, max_cost, &coarse_cost);
  if (coarse_end == End::TooExpensive) return {.is_too_expensive = true};
  if (coarse_end == End::Diverged) return result;
  const double ratio = static_cast<double>(settings.substeps) / coarse.substeps;
  const double order = effective_order(*system_, *settings.integrator);
  const double weight = order_reduction(settings, plan_.spectrum) / (portable::pow(ratio, order) - 1.0);
  result.error = weighted_distance(end_.position, last_positions_, weight).rms;
  return result;
}

// Within a factor of 3.5 upwards and 2 downwards in nine of ten frames of nets and chains, and close to 1 where dashpots are strong.
std::optional<double> Trials::embedded_error(const Integrator& method) const {
  const bool is_usable = &method == &tr_bdf2 && !plan_.has_contact() && plan_.spring.break_length.empty();
  if (!is_usable || last_.method != &method || last_.frame.motion().counts.unconverged_solves > 0) return std::nullopt;
  return last_.frame.motion().local_error;
}

// An embedded estimate does not see the rounding of positions, once per substep.
double Trials::round_off(int substeps) const {
  double max = 0.0;
  for (const Vec3& x : start_->position) max = std::max({max, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return 0x1p-53 * max * substeps;
}

double Trials::velocity_change() const {
  if (last_.method == nullptr) return std::numeric_limits<double>::infinity();
  return weighted_distance(last_velocities_, start_->velocity, 1.0).rms;
}

Trials::Result Trials::measure(const Settings& settings, double max_cost, double limit) {
  constexpr double max_underestimate = 1.5, max_overestimate = 4.0;
  const CostModel model(plan_);
  Result result;
  Settings fine = settings;
  fine.substeps = refined_substeps(settings);
  double fine_cost = 0.0;
  const End end = compute_frame(settings, max_cost, &result.cost);
  if (end == End::TooExpensive) return {.is_too_expensive = true};
  if (end == End::Diverged) return result;
  if (const auto embedded = embedded_error(*settings.integrator); embedded && limit > 10.0 * round_off(settings.substeps)) {
    if (max_underestimate * *embedded <= limit || *embedded > max_overestimate * limit) {
      result.error = *embedded;
      return result;
    }
  }
  // a method that iterates less in shorter steps costs less than in proportion, but not much more
  const End fine_end = compute(fine, model, 4.0 * max_cost, &fine_cost);
  if (fine_end == End::TooExpensive) return {.is_too_expensive = true};
  if (fine_end == End::Diverged) return result;
  const double ratio = static_cast<double>(fine.substeps) / settings.substeps;
  result.breaks = has_broken() || !frame_.broken().empty();
  const double converged = portable::pow(ratio, result.breaks ? -1.0 : -effective_order(*system_, *settings.integrator));
  const double weight = order_reduction(settings, plan_.spectrum) / (1.0 - converged);
  result.error = weighted_distance(last_positions_, end_.position, weight).rms;
  // Impulses of faces and springs may change velocities at the end of a frame, which moves nothing in it and everything afterwards. A
  // rebound starts at the end of a substep, by half of one too late: both runs may end that substep at the same time.
  if (plan_.surface.on && has_impact(limit)) {
    const double velocity_error = weighted_distance(last_velocities_, end_.velocity, weight).rms;
    result.error = std::max(result.error, last_.frame.duration() * velocity_error);
    if (plan_.surface.restitution > 0.0) result.error = std::max(result.error, 0.5 * impact_error(limit));
  }
  if (fine.substeps < 2 * settings.substeps && !result.breaks) {
    result.fine_substeps = fine.substeps;
    result.fine_error = converged * result.error;
    result.fine_cost = fine_cost;
  }
  // both may break a spring at the same time by chance
  if (has_broken())
    result.error =
        std::max(result.error, breaking_error(plan_, *system_, last_.frame.broken(), last_.frame.duration(), settings.substep()));
  return result;
}

double Trials::unresolved(const Settings& settings) {
  constexpr double max_ratio = 10.0;  // of its cost to that of the frame
  const auto fine = resolving(plan_, settings, max_ratio);
  if (!fine) return 0.0;
  if (resolved_positions_.empty()) {
    double cost = 0.0;
    const CostModel model(plan_);
    const End end = compute(*fine, model, 4.0 * model.expected(*fine->integrator, fine->substeps), &cost);
    if (end != End::Finished) return 0.0;
    resolved_positions_ = end_.position;
  }
  return weighted_distance(last_positions_, resolved_positions_, 1.0).rms;
}

void Trials::keep() {
  if (last_.method == nullptr) return;
  std::swap(last_, kept_);
  last_.method = nullptr;
}

void Trials::keep_repetition(const Integrator& method, const Result& result) {
  std::swap(frame_, kept_.frame);
  kept_.method = &method;
  kept_.substeps = result.fine_substeps;
  kept_.cost = result.fine_cost;
}

Frame* Trials::kept(const Integrator& method, int substeps) {
  // springs that broke are missing in its plan alone
  if (kept_.method != &method || kept_.substeps != substeps || !kept_.frame.broken().empty()) return nullptr;
  total_cost_ -= kept_.cost;
  kept_.method = nullptr;
  return &kept_.frame;
}

}  // namespace hooke
