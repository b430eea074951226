#include "lab/accuracy/second_runs.h"

#include <cstdint>

#include "sim/step/divergence.h"

namespace hooke {
namespace {

// Relative to the size of the scene: the perturbation, and the distance up to which differences count as small.
constexpr double perturbation = 1e-7, max_small = 1e-3;
// Likewise: a run with half the step that is farther away has diverged.
constexpr double max_distance = 1e4;
// A measurement of growth is followed by a pause of this many times its length.
constexpr int pause_factor = 3;
// Frames that may wait, in number and in memory [bytes].
constexpr std::size_t max_waiting = 600, max_waiting_bytes = std::size_t{1} << 26;

// In [-1, 1], the same for the same number: the finalizer of SplitMix64 (Steele, Lea, Flood 2014).
double random_at(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

}  // namespace

void SecondRuns::restart(double size) {
  size_ = size;
  is_new_ = true;
  inputs_.clear();
  refined_.is_on = perturbed_.is_on = diverged_ = failed_ = false;
  is_full_ = false;
  error_.reset();
  max_error_.reset();
  growth_.result.reset();
  growth_.pause = 0;
}

// Waiting frames belong to the scene before the edit.
void SecondRuns::note_edit() {
  is_edited_ = true;
  if (!inputs_.empty()) restart(size_);
}

void SecondRuns::start(SecondRun& run, const Plan& plan, const State& state) {
  run.shadow.set_plan(plan);
  run.shadow.start(state);
  run.is_on = true;
  run.next = first_ + static_cast<long>(inputs_.size());
}

// Displaces the free points of the run that was just started at `state`.
void SecondRuns::perturb(const System& system, const State& state, double frame) {
  State displaced = state;
  for (Index i = 0; i < system.point_count(); ++i) {
    if (system.points()[i].nailed) continue;
    for (int c = 0; c < system.dimensions; ++c)
      displaced.position[i][c] += perturbation * size_ * random_at(3 * static_cast<std::uint64_t>(i) + static_cast<std::uint64_t>(c));
  }
  perturbed_.shadow.start(displaced);
  growth_.measurement.start(weighted_distance(system, displaced.position, state.position, 1.0).rms, frame);
  growth_.frames = 0;
}

void SecondRuns::add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after,
                           long evaluations) {
  const std::size_t bytes = inputs_.size() * after.position.size() * sizeof(Vec3);
  is_full_ = inputs_.size() >= max_waiting || bytes >= max_waiting_bytes || (is_full_ && !inputs_.empty());
  if (is_full_) {
    is_new_ = true;
    return;
  }
  if (is_new_) {
    restart(size_);
    start(refined_, plan, before);
    since_ = before.time;
    is_new_ = false;
  } else if (is_edited_ && refined_.is_on) {
    refined_.shadow.set_plan(plan);
  }
  if (is_edited_) {
    perturbed_.is_on = false;
    growth_.result.reset();
    growth_.pause = 0;
  }
  if (!perturbed_.is_on && --growth_.pause < 0) {
    start(perturbed_, plan, before);
    perturb(system, before, 1.0 / settings.frame_rate);
  }
  is_edited_ = false;
  if (refined_.is_on || perturbed_.is_on)
    inputs_.push_back({.time = before.time,
                       .hand = before.hand,
                       .settings = settings,
                       .end = after.position,
                       .end_time = after.time,
                       .evaluations = evaluations});
}

void SecondRuns::substep(const System& system) {
  // the one that is behind
  const bool is_refined = waits(refined_) && (!waits(perturbed_) || refined_.next <= perturbed_.next);
  SecondRun& run = is_refined ? refined_ : perturbed_;
  if (!run.shadow.is_in_frame()) {
    const SecondRunInput& input = input_of(run);
    Repetition frame{.settings = input.settings};
    if (is_refined) frame = repetition_of(run.shadow.plan(), system, input.settings);
    run.shadow.limit_cost(input.evaluations);
    run.shadow.begin_frame(system, frame.settings, input.time, input.hand);
    if (is_refined) repetition_ = frame;
  }
  run.shadow.substep();
  if (!run.shadow.is_in_frame()) finish_frame(system, run);
}

void SecondRuns::finish_frame(const System& system, SecondRun& run) {
  const SecondRunInput& input = input_of(run);
  const State& state = run.shadow.state();
  if (&run == &refined_) {
    const Error error{weighted_distance(system, input.end, state.position, repetition_.weight).rms, input.end_time};
    failed_ = run.shadow.failed();
    diverged_ = !is_finite(state) || !(error.rms <= max_distance * size_);
    if (failed_ || diverged_) run.is_on = false;
    if (!diverged_ || !error_) error_ = error;
    if (!max_error_ || error_->rms > max_error_->rms) max_error_ = error_;
  } else {
    ++growth_.frames;
    growth_.measurement.add(weighted_distance(system, input.end, state.position, 1.0).rms, max_small * size_);
    if (growth_.measurement.result()) growth_.result = growth_.measurement.result();
    if (growth_.measurement.is_finished() || run.shadow.failed()) {
      run.is_on = false;
      growth_.pause = pause_factor * growth_.frames;
    }
  }
  ++run.next;
  while (!inputs_.empty() && (!refined_.is_on || refined_.next > first_) && (!perturbed_.is_on || perturbed_.next > first_)) {
    inputs_.pop_front();
    ++first_;
  }
}

}  // namespace hooke
