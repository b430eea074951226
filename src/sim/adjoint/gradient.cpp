#include "sim/adjoint/gradient.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/errors.h"
#include "base/number_text.h"
#include "sim/adjoint/step_adjoint.h"
#include "sim/model/hash.h"
#include "sim/step/step.h"

namespace hooke {
namespace {

// What acts in the scene and has no derivative here, as scene files call it.
std::optional<std::string> excluded_part(const Plan& plan, const System& system) {
  if (!plan.forces.empty()) return "forces: " + std::string(plan.forces.front().term->id);
  if (!plan.spring.laws.empty()) return "laws of springs";
  if (!plan.spring.max_length.empty()) return "strain_limit";
  if (system.grab || system.scripted_hand) return "hand";
  return std::nullopt;
}

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(what + ": gradients are of springs, dashpots, gravity, drag and nails only");
}

struct Place {
  Field x, v;
};

class GradientRun {
 public:
  GradientRun(const System& system, const Settings& settings, const State& start, long frames)
      : system_(system), settings_(settings), state_(start), plan_(make_plan(system)), frames_(frames) {
    if (StepAdjoint::find(*settings.integrator) == nullptr)
      throw InputError("integrator: " + std::string(settings.integrator->id) + ": gradients are of velocity_verlet and runge_kutta4 only");
    if (const auto part = excluded_part(plan_, system)) refuse(*part);
  }

  void run(const std::function<void(long, long)>& progress) {
    keep_start();
    Frame frame;
    for (long n = 0; n < frames_; ++n) {
      frame.begin(plan_, system_, settings_, state_);
      while (!frame.done()) frame.substep(plan_);
      frame.end(plan_, state_);
      const std::string when = " before " + quantity_text(state_.time, "s");
      if (frame.has_touched()) refuse("contact: something touches" + when);
      if (!frame.broken().empty()) refuse("break_strain: a spring breaks" + when);
      keep_start();
      progress(n + 1, 2 * frames_);
    }
  }

  Gradient pass_back(const SampleWeights& weights, const std::function<void(long, long)>& progress) {
    const std::size_t springs = plan_.spring.stiffness.size(), points = static_cast<std::size_t>(plan_.points);
    const Field zero(motion_.x.size(), 0.0);
    const std::vector<double> of_springs(springs, 0.0);
    Adjoint to{zero, zero, of_springs, of_springs, of_springs, of_springs, std::vector<double>(points, 0.0)};
    StepAdjoint adjoint(plan_, *settings_.integrator, settings_.substep());
    std::size_t sample = weights.frames.size();
    for (long n = frames_; n >= 0; --n) {
      for (; sample > 0 && weights.frames[sample - 1] == n; --sample) add_weights(weights, sample - 1, to);
      if (n == 0) break;
      pass_frame(n - 1, adjoint, to);
      progress(2 * frames_ - n + 1, 2 * frames_);
    }
    adjoint.finish(to);
    return gradient_of(to);
  }

 private:
  void keep_start() {
    pack(plan_, state_, motion_);
    starts_.push_back({motion_.x, motion_.v});
  }

  void add_weights(const SampleWeights& weights, std::size_t sample, Adjoint& to) const {
    for (Index i = 0; i < plan_.points; ++i) {
      const std::size_t at = sample * static_cast<std::size_t>(plan_.points) + static_cast<std::size_t>(i);
      if (!weights.position.empty()) add_vector(plan_, to.x, i, weights.position[at]);
      if (!weights.velocity.empty() && plan_.inverse_mass[i] != 0.0) add_vector(plan_, to.v, i, weights.velocity[at]);
    }
  }

  void pass_frame(long number, StepAdjoint& adjoint, Adjoint& to) {
    const double h = settings_.substep();
    const auto count = static_cast<std::size_t>(settings_.substeps);
    motion_.x = starts_[static_cast<std::size_t>(number)].x;
    motion_.v = starts_[static_cast<std::size_t>(number)].v;
    motion_.acceleration_is_current = false;
    if (settings_.integrator->prepare != nullptr) settings_.integrator->prepare(plan_, h, motion_, work_);
    steps_.resize(count + 1);
    for (std::size_t k = 0; k <= count; ++k) {
      steps_[k] = {motion_.x, motion_.v};
      if (k < count) settings_.integrator->step(plan_, motion_, work_, h);
    }
    for (std::size_t k = count; k-- > 0;) adjoint.pass(steps_[k].x, steps_[k].v, steps_[k + 1].x, to);
  }

  Gradient gradient_of(const Adjoint& to) const {
    const auto springs = static_cast<std::size_t>(system_.spring_count()), points = static_cast<std::size_t>(plan_.points);
    const std::vector<double> zeros(springs, 0.0);
    Gradient all{
        zeros, zeros, zeros, std::vector<double>(points), std::vector<Vec3>(points), std::vector<Vec3>(points), hash_state(state_)};
    for (std::size_t s = 0; s < plan_.spring.index.size(); ++s) {
      const auto in_system = static_cast<std::size_t>(plan_.spring.index[s]);
      const Spring spring = system_.springs()[in_system];
      all.rest_length[in_system] = to.rest_length[s];
      if (system_.is_on(spring)) all.stiffness[in_system] = to.stiffness[s];
      if (system_.is_on(spring) && system_.dashpots_on) all.damping[in_system] = to.damping[s];
    }
    for (Index i = 0; i < plan_.points; ++i) {
      all.mass[i] = -to.inverse_mass[i] * plan_.inverse_mass[i] * plan_.inverse_mass[i];
      all.position[i] = vector_at(plan_, to.x, i);
      if (plan_.inverse_mass[i] != 0.0) all.velocity[i] = vector_at(plan_, to.v, i);
    }
    return all;
  }

  const System& system_;
  const Settings& settings_;
  State state_;
  Plan plan_;
  long frames_;
  Motion motion_;
  Workspace work_;
  std::vector<Place> starts_, steps_;
};

}  // namespace

Gradient compute_gradient(const System& system, const Settings& settings, const State& start, long frames, const SampleWeights& weights,
                          const std::function<void(long, long)>& progress) {
  GradientRun run(system, settings, start, frames);
  run.run(progress);
  return run.pass_back(weights, progress);
}

}  // namespace hooke
