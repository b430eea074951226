#include "sim/methods/step_limits.h"

#include <algorithm>
#include <cmath>

#include "base/file_limits.h"
#include "base/number_text.h"

namespace hooke {
namespace {

std::optional<int> substeps_of(double step, double frame_rate, double rounding) {
  const double substeps = std::ceil(1.0 / (frame_rate * step) * rounding);
  if (!(substeps <= max_substeps)) return std::nullopt;
  return std::max(1, static_cast<int>(substeps));
}

}  // namespace

Oscillation fastest_oscillation(const System& system) {
  Oscillation fastest;
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    ColliderPath path = system.colliders[c].path;
    if (system.dimensions == 2) path.amplitude.z = 0.0;
    if (system.colliders[c].solid && path.resolving_step() < fastest.resolving_step) fastest = {false, c, path.resolving_step()};
  }
  for (std::size_t s = 0; system.springs().have_laws() && s < system.springs().size(); ++s)
    if (const auto& law = system.springs()[s].law; law && law->resolving_step(system.muscles.rate()) < fastest.resolving_step)
      fastest = {true, s, law->resolving_step(system.muscles.rate())};
  return fastest;
}

StepNeeds step_needs(const System& system, const State& state) {
  return {recommended_margin(system, state), shortest_passage(system, state), fastest_oscillation(system).resolving_step};
}

void StepLimits::update(const Spectrum& spectrum, const StepNeeds& needs) {
  if (spectrum != spectrum_) stable_steps_.clear();
  spectrum_ = spectrum;
  needs_ = needs;
}

double StepLimits::stable_step(const Integrator& method) const {
  for (const auto& [known, step] : stable_steps_)
    if (known == &method) return step;
  return stable_steps_.emplace_back(&method, largest_stable_step(method, spectrum_)).second;
}

bool StepLimits::is_set_by_contact(const Integrator& method) const {
  Spectrum spectrum = spectrum_;
  spectrum.contact = spectrum.points_touch = false;
  return stable_step(method) < largest_stable_step(method, spectrum);
}

std::string StepLimits::limit_text(const Integrator& method, double frame_rate) const {
  const auto substeps = stable_substeps(method, frame_rate);
  if (!substeps || std::isinf(stable_step(method))) return {};
  // the bound of a listed force is that of its strongest point, which the scene may never reach
  const bool is_of_forces = spectrum_.force_omega * spectrum_.force_omega + spectrum_.estimated_omega * spectrum_.estimated_omega >
                            0.25 * spectrum_.omega * spectrum_.omega;
  return (is_set_by_contact(method) ? "contact may cause growth with fewer than " : "its linear stability limit is ") +
         number_text(*substeps) + (*substeps == 1 ? " substep" : " substeps") + " per frame" +
         (is_of_forces ? " where the listed forces are strongest" : "");
}

std::optional<int> StepLimits::stable_substeps(const Integrator& method, double frame_rate) const {
  const double step = stable_step(method);
  if (step == 0.0) return std::nullopt;
  return substeps_of(step, frame_rate, 1.0 + 1e-9);
}

std::optional<int> StepLimits::resolving_substeps(const Integrator& method, double frame_rate) const {
  double step = longest_step(needs_.passage, method);
  if (method.stability != Stability::Adaptive) step = std::min(step, needs_.oscillation);
  return substeps_of(step, frame_rate, 1.0 - 1e-9);
}

std::optional<int> StepLimits::min_substeps(const Integrator& method, double frame_rate) const {
  const auto stable = stable_substeps(method, frame_rate), resolving = resolving_substeps(method, frame_rate);
  if (!stable || !resolving) return std::nullopt;
  return std::max(*stable, *resolving);
}

std::optional<int> StepLimits::recommended_substeps(const Integrator& method, double frame_rate) const {
  const auto stable = stable_substeps(method, frame_rate), resolving = resolving_substeps(method, frame_rate);
  if (!stable || !resolving) return std::nullopt;
  const long with_margin = std::min<long>(max_substeps, static_cast<long>(needs_.margin) * *stable);
  return std::max(static_cast<int>(with_margin), *resolving);
}

}  // namespace hooke
