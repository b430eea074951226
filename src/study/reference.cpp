#include "study/reference.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <utility>

#include "base/formatted.h"
#include "base/threads/thread_time.h"
#include "sim/control/frame_error.h"
#include "sim/forces/energy/energy.h"

namespace hooke {
namespace {

constexpr double refinement_limit = 1e-14;  // relative: further refinement has no effect
constexpr double perturbation = 1e-10;      // relative to the size of the problem
constexpr std::size_t max_candidates = 4;   // methods tried for the two solutions

Vec3 center_of_mass(const System& system, const State& state) {
  Vec3 sum(0.0);
  double mass = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) {
    sum += system.points()[i].mass * state.position[i];
    mass += system.points()[i].mass;
  }
  return sum / mass;
}

double largest_strain(const System& system, const State& state) {
  double largest = 0.0;
  for (const Spring& spring : system.springs()) largest = std::max(largest, std::abs(strain(system, state, spring)));
  return largest;
}

// The maximum kinetic energy [J] of the reference, to which energies are relative.
double energy_scale(const Problem& problem, const std::vector<State>& reference) {
  double scale = compute_energy(problem.system, problem.start).kinetic;
  for (const State& state : reference) scale = std::max(scale, compute_energy(problem.system, state).kinetic);
  return scale > 0.0 ? scale : 1.0;
}

Setting first_setting(const Benchmark& benchmark, const Integrator& method) {
  if (is_adaptive(method)) return {.tolerance = 1e-8 * benchmark.problem().size};
  const double limit = StepLimits(benchmark.spectrum()).stable_step(method);
  const double part = benchmark.problem().seconds / snapshot_count;
  // steps that do not resolve an oscillation of a collider, and halves of them, may all see it at the same phases
  constexpr double max_steps = 1e9;
  const int resolving = static_cast<int>(std::min(max_steps, std::ceil(part / benchmark.resolving_step())));
  if (!(limit > 0.0) || !std::isfinite(limit)) return {.steps = std::max(64, resolving)};
  return {.steps = std::max({4, resolving, static_cast<int>(std::ceil(2.0 * part / limit))})};
}

// Refines until the solution no longer changes, round-off dominates or the time limit is reached. A run that exceeds it is abandoned: with
// contact an adaptive method may need any number of steps.
std::optional<Refinement> refine(Benchmark& benchmark, const Integrator& method, double seconds,
                                 const std::function<bool()>& should_continue) {
  const Problem& problem = benchmark.problem();
  const double begin = thread_cpu_seconds();
  const auto within_time = [&] { return thread_cpu_seconds() - begin < 2.0 * seconds && should_continue(); };
  Setting setting = first_setting(benchmark, method);
  RunResult coarse = benchmark.run(method, setting, within_time);
  if (coarse.end == RunResult::End::Stopped || coarse.end == RunResult::End::TooLarge) return std::nullopt;
  std::optional<Refinement> best;
  for (double spent = coarse.cpu_seconds, next = 0.0; spent + next < seconds; setting = benchmark.finer(setting)) {
    const Setting finer = benchmark.finer(setting);
    RunResult fine = benchmark.run(method, finer, within_time);
    if (fine.end == RunResult::End::Stopped) break;
    spent += fine.cpu_seconds;
    next = 2.0 * fine.cpu_seconds;
    if (coarse.end == RunResult::End::Finished && fine.end == RunResult::End::Finished) {
      const double gap = judge(problem, problem.measure, fine.snapshots, coarse.snapshots).relative_error;
      const bool improves = !best || gap < best->gap;
      const bool has_stalled = best && gap > 0.5 * best->gap && gap < 1e-8;
      if (improves)
        best = Refinement{.method = &method,
                          .setting = finer,
                          .setting_name = benchmark.name(finer),
                          .gap = gap,
                          .snapshots = fine.snapshots,
                          .coarser = coarse.snapshots};
      if (gap < refinement_limit || has_stalled) break;
    }
    if (setting.tolerance && *setting.tolerance < refinement_limit * problem.size) break;
    if (best && fine.end != RunResult::End::Finished) break;
    coarse = std::move(fine);
  }
  return best;
}

// Free points displaced at random by 1e-10 of the size [RMS]; the same on every machine.
State perturb(const Problem& problem) {
  State state = problem.start;
  std::mt19937_64 random(1);
  double sum = 0.0;
  std::vector<Vec3> shift(state.position.size(), Vec3(0.0));
  for (Index i = 0; i < problem.system.point_count(); ++i) {
    if (problem.system.points()[i].nailed) continue;
    for (int c = 0; c < problem.system.dimensions; ++c) shift[i][c] = static_cast<double>(random() >> 11) * 0x1p-52 - 1.0;
    sum += glm::dot(shift[i], shift[i]);
  }
  const double scale = sum > 0.0 ? perturbation * problem.size / std::sqrt(sum / static_cast<double>(shift.size())) : 0.0;
  for (std::size_t i = 0; i < shift.size(); ++i) state.position[i] += scale * shift[i];
  return state;
}

double measure_amplification(Benchmark& benchmark, const Refinement& own, const std::function<bool()>& should_continue) {
  const State start = perturb(benchmark.problem());
  const double begin = rms_distance(benchmark.problem().system, start, benchmark.problem().start);
  const RunResult result = benchmark.run(*own.method, own.setting, start, should_continue);
  if (result.end != RunResult::End::Finished || begin == 0.0) return std::numeric_limits<double>::quiet_NaN();
  double growth = 0.0;
  for (int i = 0; i < snapshot_count; ++i)
    growth = std::max(growth, rms_distance(benchmark.problem().system, result.snapshots[i], own.snapshots[i]) / begin);
  return growth;
}

}  // namespace

Score judge(const Problem& problem, Measure measure, const std::vector<State>& reference, const std::vector<State>& measured) {
  const System& system = problem.system;
  const double scale = energy_scale(problem, reference);
  Score score;
  double strain_error = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const double drift = (compute_energy(system, measured[i]).total() - compute_energy(system, reference[i]).total()) / scale;
    if (std::abs(drift) > std::abs(score.energy_drift)) score.energy_drift = drift;
    const double error = measure == Measure::Trajectory
                             ? rms_distance(system, measured[i], reference[i])
                             : glm::distance(center_of_mass(system, measured[i]), center_of_mass(system, reference[i]));
    score.error = std::max(score.error, error);
    strain_error = std::max(strain_error, std::abs(largest_strain(system, measured[i]) - largest_strain(system, reference[i])));
  }
  score.relative_error = score.error / problem.size;
  if (measure == Measure::Observables) {
    score.strain_error = strain_error;
    score.relative_error = std::max({score.relative_error, strain_error, std::abs(score.energy_drift)});
  }
  return score;
}

std::vector<const Integrator*> most_accurate_methods(const Problem& problem) {
  std::vector<const Integrator*> methods;
  for (const Integrator& method : integrators()) methods.push_back(&method);
  // with contacts and, to choose between equals, without them, since they may never occur
  const auto orders = [&](const Integrator* method) {
    return std::pair(effective_order(problem.system, *method), free_order(problem.system, *method));
  };
  std::ranges::stable_sort(methods, std::greater(), orders);
  return methods;
}

namespace {

std::string describe_disagreement(const Reference& reference) {
  const auto refinement = [](const Refinement& one) {
    return std::string(one.method->id) + " at " + one.setting_name + formatted(" (half the precision changes it by %.0e)", one.gap);
  };
  return refinement(reference.own) + " and " + refinement(reference.other) +
         formatted(" differ by %.0e, relative to the scene; at most %.0e is accepted", reference.other_gap, max_observables_gap);
}

// Compares the two solutions by observables instead of the trajectory.
void use_observables(const Problem& problem, Reference& reference) {
  reference.measure = Measure::Observables;
  reference.other_gap = judge(problem, reference.measure, reference.own.snapshots, reference.other.snapshots).relative_error;
  for (Refinement* refinement : {&reference.own, &reference.other})
    refinement->gap = judge(problem, reference.measure, refinement->snapshots, refinement->coarser).relative_error;
}

// The largest of the gaps: between the methods, and within each.
double largest_gap(const Reference& reference) { return std::max({reference.own.gap, reference.other.gap, reference.other_gap}); }

}  // namespace

ReferenceResult compute_reference(Benchmark& benchmark, double seconds, const std::function<bool()>& should_continue) {
  using enum ReferenceResult::Failure;
  const Problem& problem = benchmark.problem();
  const std::vector<const Integrator*> methods = most_accurate_methods(problem);
  std::vector<Refinement> refinements;
  std::string failed;  // ids of methods
  for (std::size_t i = 0; i < std::min(max_candidates, methods.size()) && refinements.size() < 2; ++i) {
    std::optional<Refinement> refinement = refine(benchmark, *methods[i], seconds, should_continue);
    if (!should_continue()) return {.failure = Interrupted};
    if (refinement)
      refinements.push_back(*std::move(refinement));
    else
      failed += (failed.empty() ? "" : ", ") + std::string(methods[i]->id);
  }
  if (refinements.size() < 2) {
    return {.failure = NotFinished, .reason = formatted("no two successive settings reached the end within %.3g s: ", seconds) + failed};
  }

  Reference reference{.own = std::move(refinements[0]), .other = std::move(refinements[1]), .measure = problem.measure};
  reference.other_gap = judge(problem, reference.measure, reference.own.snapshots, reference.other.snapshots).relative_error;
  if (reference.measure == Measure::Trajectory && !(largest_gap(reference) <= max_trajectory_gap)) use_observables(problem, reference);
  const double max_gap = reference.measure == Measure::Trajectory ? max_trajectory_gap : max_observables_gap;
  if (!(largest_gap(reference) <= max_gap)) return {.failure = Disagreement, .reason = describe_disagreement(reference)};

  reference.amplification = measure_amplification(benchmark, reference.own, should_continue);
  if (!should_continue()) return {.failure = Interrupted};
  return {.reference = std::move(reference)};
}

}  // namespace hooke
