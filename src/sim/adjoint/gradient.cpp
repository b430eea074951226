#include "sim/adjoint/gradient.h"

#include <string>

#include "base/errors.h"
#include "base/number_text.h"
#include "sim/adjoint/step_adjoint.h"
#include "sim/model/hash.h"
#include "sim/step/step.h"

namespace hooke {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw InputError(what + ": gradients are of springs, dashpots, gravity, loads, drag and nails only");
}

// What acts in the scene and has no derivative here, as scene files call it.
void check_forces(const Plan& plan, const System& system) {
  for (const Force& force : plan.forces)
    if (force.term != &load_force) refuse((force.term == &roller_force ? "points: " : "forces: ") + std::string(force.term->id));
  if (!plan.spring.laws.empty()) refuse("laws of springs");
  if (!plan.spring.max_length.empty()) refuse("strain_limit");
  if (system.grab || system.scripted_hand) refuse("hand");
}

struct Place {
  Field x, v;
};

// At the start of every frame.
std::vector<Place> run_frames(Plan& plan, const System& system, const Settings& settings, long frames, State& state,
                              const std::function<void(long, long)>& progress) {
  std::vector<Place> starts;
  Frame frame;
  Motion motion;
  for (long n = 0; n < frames; ++n) {
    pack(plan, state, motion);
    starts.push_back({motion.x, motion.v});
    frame.begin(plan, system, settings, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
    const std::string when = " before " + quantity_text(state.time, "s");
    if (frame.has_touched()) refuse("contact: something touches" + when);
    if (!frame.broken().empty()) refuse("break_strain: a spring breaks" + when);
    progress(n + 1, 2 * frames);
  }
  return starts;
}

void add_weights(const Plan& plan, const SampleWeights& weights, std::size_t sample, Adjoint& to) {
  for (Index i = 0; i < plan.points; ++i) {
    const std::size_t at = sample * static_cast<std::size_t>(plan.points) + static_cast<std::size_t>(i);
    if (!weights.position.empty()) add_vector(plan, to.x, i, weights.position[at]);
    if (!weights.velocity.empty()) add_vector(plan, to.v, i, weights.velocity[at]);
  }
}

Gradient gradient_of(const Plan& plan, const System& system, const Adjoint& to) {
  const std::vector<double> zeros(static_cast<std::size_t>(system.spring_count()), 0.0);
  Gradient all{.stiffness = zeros, .rest_length = zeros, .damping = zeros, .mass = {}, .position = {}, .velocity = {}};
  for (std::size_t s = 0; s < plan.spring.index.size(); ++s) {
    const auto in_system = static_cast<std::size_t>(plan.spring.index[s]);
    const bool is_on = system.is_on(system.springs()[in_system]);
    all.rest_length[in_system] = to.rest_length[s];
    all.stiffness[in_system] = is_on ? to.stiffness[s] : 0.0;
    all.damping[in_system] = is_on && system.switches.dashpots ? to.damping[s] : 0.0;
  }
  for (Index i = 0; i < plan.points; ++i) {
    all.mass.push_back(-to.inverse_mass[i] * plan.inverse_mass[i] * plan.inverse_mass[i]);
    all.position.push_back(vector_at(plan, to.x, i));
    all.velocity.push_back(plan.inverse_mass[i] == 0.0 ? Vec3(0.0) : vector_at(plan, to.v, i));
  }
  return all;
}

}  // namespace

Gradient compute_gradient(const System& system, const Settings& settings, const State& start, long frames, const SampleWeights& weights,
                          const std::function<void(long, long)>& progress) {
  const Integrator& method = *settings.integrator;
  if (StepAdjoint::find(method) == nullptr)
    throw InputError("integrator: " + std::string(method.id) + ": gradients are of velocity_verlet and runge_kutta4 only");
  Plan plan = make_plan(system);
  check_forces(plan, system);
  State state = start;
  const std::vector<Place> starts = run_frames(plan, system, settings, frames, state, progress);

  Motion motion;
  pack(plan, start, motion);
  Workspace work;
  const double h = settings.substep();
  if (method.prepare != nullptr) method.prepare(plan, h, motion, work);
  Adjoint to(plan);
  StepAdjoint adjoint(plan, method, h);
  const auto count = static_cast<std::size_t>(settings.substeps);
  std::vector<Place> steps(count + 1);
  std::size_t samples = weights.frames.size();
  for (long n = frames; n >= 0; --n) {
    for (; samples > 0 && weights.frames[samples - 1] == n; --samples) add_weights(plan, weights, samples - 1, to);
    if (n == 0) break;

    // the substeps of the frame, and back through them
    steps[0] = starts[static_cast<std::size_t>(n - 1)];
    motion.x = steps[0].x;
    motion.v = steps[0].v;
    motion.acceleration_is_current = false;
    for (std::size_t k = 1; k <= count; ++k) {
      method.step(plan, motion, work, h);
      steps[k] = {motion.x, motion.v};
    }
    for (std::size_t k = count; k-- > 0;) adjoint.pass(steps[k].x, steps[k].v, steps[k + 1].x, to);
    progress(2 * frames - n + 1, 2 * frames);
  }
  adjoint.finish(to);
  Gradient gradient = gradient_of(plan, system, to);
  gradient.hash = hash_state(state);
  return gradient;
}

}  // namespace hooke
