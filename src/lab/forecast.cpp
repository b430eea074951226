#include "lab/forecast.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sim/errors.h"
#include "sim/gap.h"
#include "sim/motion.h"
#include "sim/rest.h"

namespace hooke {
namespace {

// A cloth of so many points is found at rest in a second or two, a larger one often not at all in ten times as long.
constexpr Index most_points = 1700;
// A product with so many springs takes tens of milliseconds.
constexpr Index most_springs = 1'000'000;
// What may be left of the forces, of what they usually are. A flat cloth's middle rises with the cube root of its load: little
// must be left. But folds are found slowly, and a sheet without weight has many ways to lie: then a hundredth is near enough.
constexpr double wished = 1e-6, near_enough = 1e-2, at_rest = 1e-4;
// Without weight a chain is taut by the square of how crooked it is, and the forces by its third power: hardly anything may be
// left, and still it swings across at the rate that its crookedness is of its length.
constexpr double wished_without_weight = 1e-12, loose_without_weight = 1e-3, loose = 5e-7;
constexpr int most_steps = 200, most_relieving_steps = 60;

// The springs and the weight of a scene; its dashpots apart.
struct Statics {
  Plan plan;
  std::vector<double> damping;
};

Statics statics_of(const System& system) {
  Statics statics{make_plan(system), {}};
  Plan& plan = statics.plan;
  std::swap(statics.damping, plan.damping);
  plan.drag = 0.0;
  plan.pull.reset();
  plan.forces.clear();
  if (plan.held) {
    const Point& point = system.points()[*plan.held];
    plan.inverse_mass[*plan.held] = point.nailed ? 0.0 : 1.0 / point.mass;
    plan.held.reset();
  }
  return statics;
}

// Whether a nail, or what hangs on one, carries each free point; how many are carried so.
Index count_carried(const Plan& plan) {
  std::vector<Index> root(plan.points);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](Index i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e)
      if (plan.stiffness[run.begin + e] > 0.0) root[find(run.first + e)] = find(run.second + e);
  std::vector<bool> holds(plan.points, false);
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] == 0.0) holds[find(i)] = true;
  Index carried = 0;
  for (Index i = 0; i < plan.points; ++i) carried += plan.inverse_mass[i] != 0.0 && holds[find(i)] ? 1 : 0;
  return carried;
}

Index count_free(const Plan& plan) {
  return static_cast<Index>(std::ranges::count_if(plan.inverse_mass, [](double w) { return w != 0.0; }));
}

// RMS of the weights [N]; without any, of what the springs would bear at double their length.
double usual_force(const Plan& plan) {
  const double pull = glm::length(plan.acceleration);
  double sum = 0.0;
  for (Index i = 0; i < plan.points; ++i)
    if (plan.inverse_mass[i] != 0.0) sum += plan.mass[i] * plan.mass[i] * pull * pull;
  if (sum > 0.0) return std::sqrt(sum / count_free(plan));
  for (Index s = 0; s < plan.springs; ++s) sum += std::pow(plan.stiffness[s] * plan.rest_length[s], 2);
  return std::sqrt(sum / plan.springs);
}

Vec3 place_in(const Plan& plan, const Field& x, Index i) {
  Vec3 place(0.0);
  for (int c = 0; c < plan.dimensions; ++c) place[c] = x[static_cast<std::size_t>(c) * plan.points + i];
  return place;
}

// Where more than springs and weight would decide.
bool touches(const Plan& plan, const System& system, double time, const Field& x) {
  for (const Collider& still : plan.colliders) {
    const Collider collider = moved_at(still, time);
    for (Index i = 0; i < plan.points; ++i)
      if (plan.inverse_mass[i] != 0.0 && gap_to(collider, system.points()[i].radius, place_in(plan, x, i)).distance < 0.0) return true;
  }
  return false;
}
bool is_overstretched(const Plan& plan, const System& system, const Field& x) {
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) {
      const Spring& spring = system.springs()[plan.spring_index[run.begin + e]];
      if (plan.stiffness[run.begin + e] == 0.0) continue;
      const double length = glm::distance(place_in(plan, x, run.first + e), place_in(plan, x, run.second + e));
      if (length >= system.break_length_of(spring)) return true;
      if (system.strain_limit > 0.0 && length > spring.rest_length * (1.0 + system.strain_limit)) return true;
    }
  return false;
}

double sag_between(const Plan& plan, const Field& above, const Field& below) {
  const Vec3 down = glm::normalize(plan.gravity);
  double most = 0.0;
  for (Index i = 0; i < plan.points; ++i) most = std::max(most, glm::dot(down, place_in(plan, below, i) - place_in(plan, above, i)));
  return most;
}

// Free points from where they were at rest before, where they are still the same ones.
Field start_of(const Plan& plan, const System& system, const State& state, const Forecast& before) {
  Motion motion;
  pack(plan, state, motion);
  const bool is_known = before.system && before.rest.size() == system.points().size() &&
                        std::ranges::equal(before.system->points(), system.points(), {}, &Point::id, &Point::id);
  for (Index i = 0; is_known && i < plan.points; ++i)
    for (int c = 0; c < plan.dimensions && plan.inverse_mass[i] != 0.0; ++c)
      motion.x[static_cast<std::size_t>(c) * plan.points + i] = before.rest[i][c];
  return motion.x;
}

// Springs at their rest length but for round-off, which would swing across as if they were taut, get the length that they have.
void relax(Plan& plan, const Field& x) {
  constexpr double round_off = 1e-4;
  for (const SpringRun& run : plan.runs)
    for (Index e = 0; e < run.count; ++e) {
      double& rest_length = plan.rest_length[run.begin + e];
      const double length = glm::distance(place_in(plan, x, run.first + e), place_in(plan, x, run.second + e));
      if (std::abs(length - rest_length) < round_off * rest_length) rest_length = length;
    }
}

// Rest under the weight, and without it. Leaves x where the scene is at rest; returns what counts as loose there, none where it
// is not found.
std::optional<double> find_rest(Plan& plan, const System& system, double time, Field& x, Forecast& forecast, StiffnessMatrix& matrix,
                                const std::atomic<bool>& stop) {
  const double usual = usual_force(plan);
  const auto rests = [&](double small, double enough) {
    return come_to_rest(plan, matrix, small * usual, most_steps, x, stop) <= enough * usual && !touches(plan, system, time, x) &&
           !is_overstretched(plan, system, x);
  };
  const Index carried = count_carried(plan);
  const bool has_weight = plan.acceleration != Vec3(0.0);
  if (has_weight && carried > 0) {
    if (carried < count_free(plan) || !rests(wished, at_rest)) return std::nullopt;
    for (Index i = 0; i < plan.points; ++i) forecast.rest.push_back(place_in(plan, x, i));
    if (plan.gravity == Vec3(0.0)) return loose;
    Field relieved = x;
    Plan weightless = plan;
    weightless.acceleration = Vec3(0.0);
    const double left = come_to_rest(weightless, matrix, wished * usual, most_relieving_steps, relieved, stop);
    if (left <= near_enough * usual) forecast.sag = sag_between(plan, relieved, x);
    return loose;
  }
  // what floats, or falls freely, swings as if there were no weight
  if (has_weight && !plan.colliders.empty()) return std::nullopt;
  plan.acceleration = Vec3(0.0);
  if (!rests(wished_without_weight, wished_without_weight)) return std::nullopt;
  relax(plan, x);
  return loose_without_weight;
}

}  // namespace

Forecast make_forecast(std::shared_ptr<const System> system, const State& state, const Forecast& before, const std::atomic<bool>& stop) {
  Forecast forecast{.drag = system->drag_rate(), .system = system};
  if (system->spring_count() == 0 || system->spring_count() > most_springs) return forecast;
  const bool forces_decide = std::ranges::any_of(system->forces, &Force::on);
  Statics statics = statics_of(*system);
  if (!(statics.plan.spectrum.omega > 0.0)) return forecast;

  Field x = start_of(statics.plan, *system, state, before);
  std::unique_ptr<StiffnessMatrix> matrix;
  try {
    if (!forces_decide && system->point_count() <= most_points) matrix = std::make_unique<StiffnessMatrix>(statics.plan);
  } catch (const Refused&) {
    // a factor too large for the memory
  }
  if (matrix)
    if (const auto loose = find_rest(statics.plan, *system, state.time, x, forecast, *matrix, stop); loose && !stop)
      forecast.slowest = slowest_mode(statics.plan, statics.damping, x, *loose, *matrix);
  if (!stop) forecast.fastest = fastest_mode(statics.plan, statics.damping, x);
  return forecast;
}

}  // namespace hooke
