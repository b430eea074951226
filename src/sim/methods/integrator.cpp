#include "sim/methods/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/forces/energy/energy.h"
#include "sim/methods/automatic_method.h"
#include "sim/methods/rows.h"
#include "sim/model/settings.h"

namespace hooke {

Table<Integrator> integrators() {
#define ROW(name) &(name),
  static constexpr const Integrator* rows[] = {
#include "sim/methods/list.inc"
  };
#undef ROW
  return Table<Integrator>(rows);
}

const Integrator* find_integrator(std::string_view id) {
  for (const Integrator& row : integrators())
    if (row.id == id) return &row;
  return id == automatic_method().id ? &automatic_method() : nullptr;
}

std::string_view describe(Stability stability) {
  switch (stability) {
    case Stability::None:
      return "unstable at every step";
    case Stability::Conditional:
      return "stable up to a maximum step";
    case Stability::Adaptive:
      return "chooses its own steps";
    case Stability::EachSpring:
      return "small vibrations of each spring alone are stable at any step";
    case Stability::AStable:
      return "small vibrations are stable at any step";
    case Stability::LStable:
      return "small vibrations are stable at any step, fast modes are damped";
  }
  return {};
}

std::string_view describe(EnergyTrend energy) {
  switch (energy) {
    case EnergyTrend::Grows:
      return "grows";
    case EnergyTrend::Drifts:
      return "drifts slowly";
    case EnergyTrend::Bounded:
      return "stays bounded";
    case EnergyTrend::Falls:
      return "falls";
  }
  return {};
}

const Integrator& default_integrator() { return velocity_verlet; }

const Integrator& stiff_integrator() { return tr_bdf2; }

const Integrator& adaptive_integrator() { return dop853; }

Amplification amplification_from(std::complex<double> (*r)(std::complex<double>), const Oscillator& oscillator) {
  const double damping = oscillator.h_lambda + oscillator.h_drag + oscillator.h_rate;
  const double discriminant = 0.25 * damping * damping - oscillator.h_omega_squared, size = std::sqrt(std::abs(discriminant));
  const std::complex<double> root = discriminant >= 0.0 ? std::complex(size, 0.0) : std::complex(0.0, size);
  const std::complex<double> r1 = r(-0.5 * damping + root), r2 = r(-0.5 * damping - root);
  return {(r1 + r2).real(), (r1 * r2).real()};
}

namespace {

// Jury's conditions for all roots of z^3 - trace z^2 + determinant z - third to lie in the closed unit disc.
bool is_stable(const Amplification& amplification) {
  const auto& [trace, determinant, third] = amplification;
  return std::abs(trace + third) <= 1.0 + determinant + eigenvalue_round_off && std::abs(third) <= 1.0 + eigenvalue_round_off &&
         std::abs(determinant - trace * third) <= 1.0 - third * third + eigenvalue_round_off;
}

// of the one mode with these rates [1/s]
double largest_stable_step(const Integrator& integrator, double omega, double lambda, double drag, double force_rate) {
  const auto amplification_at = [&](double h) {
    // h may be so long that its square overflows
    return integrator.amplification({.h_omega_squared = omega == 0.0 ? 0.0 : h * h * omega * omega,
                                     .h_lambda = h * lambda,
                                     .h_drag = h * drag,
                                     .h_rate = h * force_rate});
  };
  const double rate = std::max({omega, lambda, drag, force_rate});
  if (rate == 0.0) return std::numeric_limits<double>::infinity();

  // increase from a thousandth of the fastest rate until a step is unstable, then bisect
  double stable = 1e-3 / rate, unstable = stable;
  Amplification step = amplification_at(stable);
  if (!is_stable(step)) return 0.0;
  while (true) {
    // where an eigenvalue approaches -1, the higher-order splitting methods are unstable in a band of steps less than a hundredth wide
    const bool is_near_minus_one = 1.0 + step.determinant + step.trace + step.third < 0.02;
    unstable = stable * (is_near_minus_one ? 1.0005 : 1.02);
    step = amplification_at(unstable);
    if (!is_stable(step)) break;
    stable = unstable;
    if (stable * rate > 1e6) return std::numeric_limits<double>::infinity();
  }
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (is_stable(amplification_at(middle)) ? stable : unstable) = middle;
  }
  return stable;
}

}  // namespace

int recommended_margin(const System& system, const State& state) { return can_collapse(system, state) ? collapse_margin : default_margin; }

namespace {

// over the corners of the region (omega, lambda) that contains the modes of the scene
double conditional_step(const Integrator& integrator, const Spectrum& spectrum, double force_rate) {
  const double omega = spectrum.omega, drag = spectrum.drag_rate;
  const double min = std::min(spectrum.min_dashpot_ratio * omega * omega, spectrum.dashpot_rate);
  if (spectrum.dashpot_rate == 0.0)
    return std::min(largest_stable_step(integrator, omega, 0.0, drag, force_rate),
                    largest_stable_step(integrator, 0.0, 0.0, drag, force_rate));
  const double along_spring = std::min({largest_stable_step(integrator, omega, min, drag, force_rate),
                                        largest_stable_step(integrator, omega, spectrum.dashpot_rate, drag, force_rate),
                                        largest_stable_step(integrator, 0.0, spectrum.dashpot_rate, drag, force_rate)});
  // in the transverse direction of a stretched spring its dashpot does nothing; if no step is stable without dashpots, their stabilizing
  // effect counts
  return integrator.stability == Stability::None ? along_spring
                                                 : std::min(along_spring, largest_stable_step(integrator, omega, 0.0, drag, force_rate));
}

// [s], up to which contacts cause no growth.
double longest_step_with_contact(const Spectrum& spectrum) {
  if (!spectrum.contact || spectrum.omega == 0.0) return std::numeric_limits<double>::infinity();
  return (spectrum.points_touch ? max_angle_of_touching_points : max_angle_in_contact) / spectrum.omega;
}

}  // namespace

double largest_stable_step(const Integrator& integrator, const Spectrum& bounds) {
  if (&integrator == &automatic_method()) return std::numeric_limits<double>::infinity();
  Spectrum spectrum = bounds;
  const double estimated_squared = bounds.estimated_omega * bounds.estimated_omega;
  spectrum.omega = std::sqrt(bounds.omega * bounds.omega + estimated_squared);
  spectrum.force_omega = std::sqrt(bounds.force_omega * bounds.force_omega + estimated_squared);
  spectrum.force_rate += bounds.estimated_rate;
  const double contact_step = longest_step_with_contact(bounds);
  if (integrator.stability == Stability::None || integrator.stability == Stability::Conditional) {
    const double step = conditional_step(integrator, spectrum, 0.0);
    const double with_forces =
        spectrum.force_rate > 0.0 ? std::min(step, conditional_step(integrator, spectrum, spectrum.force_rate)) : step;
    return spectrum.points_touch ? std::min(with_forces, contact_step) : with_forces;
  }

  double step = contact_step;
  if (integrator.is_implicit() && spectrum.omitted_omega > 0.0) step = std::min(step, max_omitted_angle / spectrum.omitted_omega);
  // the other methods add these forces once a step, as symplectic Euler does
  if (!integrator.is_implicit() && integrator.stability != Stability::Adaptive && (spectrum.force_omega > 0.0 || spectrum.force_rate > 0.0))
    step =
        std::min(step, conditional_step(symplectic_euler,
                                        {.omega = spectrum.force_omega, .force_rate = spectrum.force_rate, .drag_rate = spectrum.drag_rate},
                                        spectrum.force_rate));
  return step;
}

}  // namespace hooke
