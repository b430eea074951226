#include "sim/control/frame_error.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "sim/contact/contact.h"
#include "sim/control/automatic.h"
#include "sim/control/constants.h"
#include "sim/control/cost_model.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/rows.h"
#include "sim/methods/step_limits.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

bool has_surface_contact(const System& system) { return system.contact.faces || system.contact.springs; }

// Whether something is done once per substep, whatever the tolerance of a method that adapts its step.
bool acts_once_per_substep(const System& system) { return has_surface_contact(system) || system.strain_limit > 0.0; }

}  // namespace

int free_order(const System& system, const Integrator& method) {
  int order = method.order;
  if (system.drag_rate() > 0.0) order = std::min(order, method.order_with.drag);
  if (std::ranges::any_of(system.springs(), [&](const Spring& spring) { return system.damping_of(spring) > 0.0; }))
    order = std::min(order, method.order_with.damped);
  if (std::ranges::any_of(system.forces, &Force::on)) order = std::min(order, method.order_with.force_terms);
  return order;
}

int effective_order(const System& system, const Integrator& method) {
  int order = free_order(system, method);
  if (has_contact(system)) order = std::min(order, method.order_with.contact);
  if (has_surface_contact(system)) order = std::min(order, surface_contact_order);
  return order;
}

Settings refined(const System& system, const Settings& settings) {
  Settings fine = settings;
  fine.locates_breaks = true;
  if (is_automatic(settings)) {
    fine.tolerance = 0.1 * automatic_tolerance(settings);
    return fine;
  }
  if (settings.integrator->stability != Stability::Adaptive) {
    fine.substeps *= 2;
    return fine;
  }
  // a tolerance that is set applies to contact too, where a tighter one is expensive: friction is of first order. Contact of faces and
  // springs is resolved once per step, which has to be halved: by its upper limit, or by this tolerance for a method of order 8; the strain
  // limit is imposed once per substep
  const bool halves = acts_once_per_substep(system);
  if (halves) fine.substeps *= 2;
  const double factor = halves ? control::tighter_as_half_step : has_contact(system) ? control::tighter_with_contact : control::tighter;
  fine.tolerance = std::max(control::min_tolerance, factor * settings.tolerance.value_or(default_tolerance));
  return fine;
}

double refinement_weight(const System& system, const Settings& settings) {
  const bool adapts = settings.integrator->stability == Stability::Adaptive;
  if (adapts && !acts_once_per_substep(system)) return 1.0;
  constexpr int limit_order = 1;
  int order = effective_order(system, *settings.integrator);
  if (adapts && system.strain_limit > 0.0) order = limit_order;
  const double factor = std::ldexp(1.0, order);
  return factor / (factor - 1.0);
}

namespace {

// Explicit steps that resolve every vibration, and every dashpot where the method splits them off; none where they are not needed or cost
// more than `max_ratio` times the frame.
std::optional<Settings> resolving(const Plan& plan, const Settings& settings, double max_ratio) {
  const Integrator& method = *settings.integrator;
  const bool dissipates = method.energy == EnergyTrend::Falls && method.stability != Stability::Adaptive;
  if (!dissipates) return std::nullopt;
  const double h_omega = plan.spectrum.omega * settings.substep();
  const Amplification fastest = method.amplification({.h_omega_squared = h_omega * h_omega});
  if (portable::pow(std::max(fastest.determinant, 1e-300), settings.substeps) > control::kept_vibration) return std::nullopt;
  const CostModel model(plan);
  const double max_cost = std::max(control::cheap_run, max_ratio * model.expected(method, settings.substeps));
  for (const Integrator* each : {&blanes_moan4, &velocity_verlet}) {
    const auto stable = StepLimits(plan.spectrum).stable_substeps(*each, settings.frame_rate);
    const double substeps = stable ? control::resolving_margin * *stable : max_automatic_substeps + 1.0;
    if (!(substeps <= max_automatic_substeps)) continue;
    Settings fine = settings;
    fine.integrator = each;
    fine.locates_breaks = true;
    fine.substeps = std::max(settings.substeps, static_cast<int>(substeps));
    if (plan.spectrum.dashpot_rate * fine.substep() > 1.0) {
      const double resolved = plan.spectrum.dashpot_rate / (control::resolving_decay * settings.frame_rate);
      if (!(resolved <= max_automatic_substeps)) continue;
      fine.substeps = static_cast<int>(resolved);
    }
    if (model.expected(*each, fine.substeps) <= max_cost) return fine;
  }
  return std::nullopt;
}

}  // namespace

Repetition repetition_of(const Plan& plan, const System& system, const Settings& settings) {
  if (const auto fine = resolving(plan, settings, control::cost_of_half_step)) return {*fine, 1.0, true};
  return {refined(system, settings), refinement_weight(system, settings)};
}

bool resolves_colliders(const Plan& plan, const Settings& used) {
  constexpr double rounding = 1e-9;
  const double max_step = plan.collider_paths.resolving_step * (1.0 + rounding);
  return used.integrator->stability == Stability::Adaptive || used.substep() <= max_step;
}

FrameError weighted_distance(const System& system, const std::vector<Vec3>& first, const std::vector<Vec3>& second, double weight) {
  double sum = 0.0, max = 0.0;
  Index count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (system.points()[i].nailed) continue;
    const Vec3 difference = first[i] - second[i];
    const double square = glm::dot(difference, difference);
    sum += square;
    max = std::max(max, square);
    ++count;
  }
  if (count == 0) return {};
  return {weight * std::sqrt(sum / count), weight * std::sqrt(max)};
}

double estimate_frame_error(const System& system, const Settings& settings, const State& state) {
  if (system.point_count() == 0) return 0.0;
  bool failed = false;
  const auto step = [&](const Settings& with) {
    Plan plan = make_plan(system);
    FrameRunner frame;
    State to = state;
    frame.begin(plan, system, with, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, to);
    failed = failed || frame.failure() != StepFailure::None;
    return to;
  };
  const State coarse = step(settings);
  const Settings used = settings_used(settings, coarse);
  const Repetition repetition = repetition_of(make_plan(system), system, used);
  const State fine = step(repetition.settings);
  if (failed) return std::numeric_limits<double>::infinity();
  return weighted_distance(system, coarse.position, fine.position, repetition.weight).rms;
}

}  // namespace hooke
