#include "study/forecast.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "base/disjoint_sets.h"
#include "sim/contact/gap.h"
#include "sim/contact/pair_solver.h"
#include "sim/contact/surface/surface_tree.h"
#include "sim/forces/motion.h"
#include "sim/methods/implicit/supernodal_factor.h"
#include "sim/statics/equilibrium.h"

namespace hooke {
namespace {

// A matrix product with this many springs takes tens of milliseconds.
constexpr Index max_forecast_springs = 1'000'000;
// Residual force accepted as equilibrium, relative to the typical force. The displacement of a flat cloth grows with the cube root of its
// load, so the residual must be small. Folds converge slowly, and a sheet without weight has many equilibria, for which 1e-2 is enough.
constexpr double target_residual = 1e-6, acceptable_residual = 1e-2, equilibrium_residual = 1e-4;
// Without weight the tension of a chain is second order in its deviation from a straight line, and the forces are third order: the residual
// must be tiny.
constexpr double weightless_residual = 1e-12, weightless_floppy_threshold = 1e-3, floppy_threshold = 5e-7;
constexpr int max_steps = 200, max_unloading_steps = 60;

// The springs and the weight of a scene, with the dashpots stored separately.
struct Statics {
  Plan plan;
  std::vector<double> damping;
};

Statics make_statics(const System& system) {
  Statics statics{make_plan(system), {}};
  Plan& plan = statics.plan;
  std::swap(statics.damping, plan.spring.damping);
  LawSprings& laws = plan.spring.laws;
  for (Index s = 0; s < plan.springs && !laws.empty() && !statics.damping.empty(); ++s)
    if (laws.of_packed[s] != no_index) statics.damping[s] = std::exchange(laws.springs[laws.of_packed[s]].damping, 0.0);
  plan.drag = 0.0;
  plan.hand.pull.reset();
  std::erase_if(plan.forces, [](const Force& force) { return force.term != &load_force && force.term != &roller_force; });
  if (plan.hand.held) {
    const Point& point = system.points()[*plan.hand.held];
    plan.inverse_mass[*plan.hand.held] = point.nailed ? 0.0 : 1.0 / point.mass;
    plan.hand.held.reset();
  }
  return statics;
}

// [N/m], of a packed spring, at its rest length if it has a law.
double stiffness_of(const Plan& plan, Index s) {
  const LawSprings& laws = plan.spring.laws;
  const bool has_law = !laws.empty() && laws.of_packed[s] != no_index;
  return has_law ? laws.springs[laws.of_packed[s]].stiffness : plan.spring.stiffness[s];
}

// The number of free points connected to a nail.
Index count_supported(const Plan& plan) {
  DisjointSets sets(static_cast<std::size_t>(plan.points));
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    if (stiffness_of(plan, s) > 0.0) sets.join(i, j);
  });
  std::vector<bool> holds(plan.points, false);
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] == 0.0) holds[sets.root(i)] = true;
  Index supported = 0;
  for (Index i = 0; i < plan.points; ++i) supported += plan.inverse_mass[i] != 0.0 && holds[sets.root(i)] ? 1 : 0;
  return supported;
}

Index count_free(const Plan& plan) {
  return static_cast<Index>(std::ranges::count_if(plan.inverse_mass, [](double w) { return w != 0.0; }));
}

// RMS of the weights and loads [N]; without weight, of the spring forces at twice the rest length.
double compute_force_scale(const Plan& plan) {
  const double pull = glm::length(plan.acceleration);
  double sum = 0.0;
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] != 0.0) sum += plan.mass[i] * plan.mass[i] * pull * pull;
  for (const auto& [i, load] : plan.force_data.load) sum += plan.inverse_mass[i] != 0.0 ? glm::dot(load, load) : 0.0;
  if (sum > 0.0) return std::sqrt(sum / count_free(plan));
  for (Index s = 0; s < plan.springs; ++s) sum += std::pow(stiffness_of(plan, s) * plan.spring.rest_length[s], 2);
  return std::sqrt(sum / plan.springs);
}

// Whether a collider affects the equilibrium.
bool touches(const Plan& plan, const System& system, double time, const Field& x) {
  const auto is_touched = [&](const Collider& still) {
    const Collider collider = collider_at_time(still, time);
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0 && gap_to(collider, system.points()[i].radius, vector_at(plan, x, i)).distance < 0.0) return true;
    return false;
  };
  return std::ranges::any_of(plan.colliders, is_touched) || std::ranges::any_of(plan.one_way, is_touched);
}
// Whether faces or springs that touch each other do.
bool surface_touches_itself(const Plan& plan, const Field& x) {
  std::vector<Vec3> place;
  for (const Index i : plan.surface.points) place.push_back(vector_at(plan, x, i));
  SurfaceTree tree;
  tree.build(plan.surface, place);
  SurfacePairs pairs;
  const bool is_complete = tree.find_pairs(plan.surface, place, plan.surface.max_thickness, {}, PairSolver::max_pairs, pairs);
  return !is_complete || !pairs[0].empty() || !pairs[1].empty();
}
// Whether points, faces or springs that touch each other do.
bool touches_itself(const Plan& plan, const Field& x) {
  if (plan.surface.on && surface_touches_itself(plan, x)) return true;
  if (!plan.pairs.on) return false;
  constexpr double round_off = 1e-9;
  std::vector<double> extent;
  for (const double radius : plan.radius) extent.push_back((1.0 - round_off) * (radius + 0.5 * plan.pairs.thickness));
  std::vector<PointPair> pairs;
  return !PairSearch().find(plan, x, extent, pairs, PairSolver::max_pairs) || !pairs.empty();
}
bool is_overstretched(const Plan& plan, const System& system, const Field& x) {
  return any_spring(plan, [&](Index i, Index j, Index s) {
    if (stiffness_of(plan, s) == 0.0) return false;
    const Spring spring = system.springs()[plan.spring.index[s]];
    const double length = glm::distance(vector_at(plan, x, i), vector_at(plan, x, j));
    return length >= system.break_length_of(spring) ||
           (system.strain_limit > 0.0 && length > spring.rest_length * (1.0 + system.strain_limit));
  });
}

double sag_between(const Plan& plan, const Field& above, const Field& below) {
  const Vec3 down = glm::normalize(plan.gravity);
  double max = 0.0;
  for (Index i = 0; i < plan.points; ++i) max = std::max(max, glm::dot(down, vector_at(plan, below, i) - vector_at(plan, above, i)));
  return max;
}

// Free points start from their previous equilibrium if they are still the same.
Field initial_guess(const Plan& plan, const System& system, const State& state, const Forecast& before) {
  Motion motion;
  pack(plan, state, motion);
  const bool is_known = before.system && before.rest.size() == system.points().size() &&
                        std::ranges::equal(before.system->points(), system.points(), {}, &Point::id, &Point::id);
  for (Index i = 0; is_known && i < plan.points; ++i)
    for (int c = 0; c < plan.dimensions && plan.inverse_mass[i] != 0.0; ++c)
      if (fixed_mass(plan, i, c) == 0.0) motion.x[static_cast<std::size_t>(c) * plan.points + i] = before.rest[i][c];
  return motion.x;
}

// Springs that deviate from their rest length only by round-off would appear to be under tension: their current length becomes the rest
// length.
void snap_rest_lengths(Plan& plan, const Field& x) {
  constexpr double round_off = 1e-4;
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    double& rest_length = plan.spring.rest_length[s];
    const double length = glm::distance(vector_at(plan, x, i), vector_at(plan, x, j));
    if (std::abs(length - rest_length) < round_off * rest_length) rest_length = length;
  });
}

// Equilibrium with and without weight. Leaves it in x; returns the threshold below which modes count as unconstrained, or none if no
// equilibrium is found.
std::optional<double> find_equilibrium(Plan& plan, const System& system, double time, Field& x, Forecast& forecast, StiffnessMatrix& matrix,
                                       const std::atomic<bool>& stop) {
  const double force_scale = compute_force_scale(plan);
  const auto finds_equilibrium = [&](double small, double enough) {
    return find_equilibrium(plan, matrix, small * force_scale, max_steps, x, stop) <= enough * force_scale &&
           !touches(plan, system, time, x) && !touches_itself(plan, x) && !is_overstretched(plan, system, x);
  };
  const Index supported = count_supported(plan);
  const bool has_weight = plan.acceleration != Vec3(0.0) || !plan.force_data.load.empty();
  forecast.why_no_sag = !has_weight ? "no weight" : count_free(plan) == plan.points ? "no point is nailed" : "a part hangs on no nail";
  if (has_weight && supported > 0) {
    if (supported < count_free(plan)) return std::nullopt;
    if (!finds_equilibrium(target_residual, equilibrium_residual)) {
      forecast.why_no_sag = touches(plan, system, time, x) ? "it rests on a collider"
                            : touches_itself(plan, x)      ? "parts of it touch each other"
                                                           : "no equilibrium found";
      return std::nullopt;
    }
    forecast.why_no_sag = plan.gravity == Vec3(0.0) ? "no weight" : "no unloaded shape found";
    for (Index i = 0; i < plan.points; ++i) forecast.rest.push_back(vector_at(plan, x, i));
    if (plan.gravity == Vec3(0.0)) return floppy_threshold;
    Field unloaded = x;
    Plan weightless = plan;
    weightless.acceleration = Vec3(0.0);
    const double left = find_equilibrium(weightless, matrix, target_residual * force_scale, max_unloading_steps, unloaded, stop);
    if (left <= acceptable_residual * force_scale) {
      forecast.sag = sag_between(plan, unloaded, x);
      for (Index i = 0; i < plan.points; ++i) forecast.unloaded.push_back(vector_at(plan, unloaded, i));
      forecast.why_no_sag.clear();
    }
    return floppy_threshold;
  }
  // a floating or freely falling scene vibrates as if weightless
  if (has_weight && (!plan.colliders.empty() || !plan.one_way.empty() || !plan.forces.empty())) return std::nullopt;
  plan.acceleration = Vec3(0.0);
  if (!finds_equilibrium(weightless_residual, weightless_residual)) return std::nullopt;
  if (!has_weight)
    for (Index i = 0; i < plan.points; ++i) forecast.rest.push_back(vector_at(plan, x, i));
  snap_rest_lengths(plan, x);
  return weightless_floppy_threshold;
}

}  // namespace

Forecast make_forecast(const std::shared_ptr<const System>& system, const State& state, const Forecast& before,
                       const std::atomic<bool>& stop, Index max_points) {
  Forecast forecast{.drag = system->drag_rate(), .system = system};
  if (system->spring_count() == 0 || system->spring_count() > max_forecast_springs) return forecast;
  const bool has_external_forces = std::ranges::any_of(system->forces, &Force::on);
  Statics statics = make_statics(*system);
  // muscles and winches stay where they are now
  MuscleClock& muscles = statics.plan.spring.laws.clock;
  muscles = {.on = false, .offset = muscles.at(state.time)};
  if (!(statics.plan.spectrum.omega > 0.0)) return forecast;

  Field x = initial_guess(statics.plan, *system, state, before);
  std::unique_ptr<StiffnessMatrix> matrix;
  try {
    if (!has_external_forces && system->point_count() <= max_points) matrix = std::make_unique<StiffnessMatrix>(statics.plan);
  } catch (const MatrixTooLarge&) {
    // without an equilibrium
  }
  if (!matrix) forecast.why_no_sag = has_external_forces ? "other forces act" : "too many points";
  if (matrix)
    if (const auto floppy_threshold = find_equilibrium(statics.plan, *system, state.time, x, forecast, *matrix, stop);
        floppy_threshold && !stop)
      forecast.slowest = slowest_mode(statics.plan, statics.damping, x, *floppy_threshold, *matrix);
  if (!stop) forecast.fastest = fastest_mode(statics.plan, statics.damping, x);
  return forecast;
}

}  // namespace hooke
