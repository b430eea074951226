// Interaction: driving at resonance, and sudden parameter changes.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "scene/parameters.h"
#include "sim/methods/rows.h"
#include "study/analytic_scenes.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

using std::numbers::pi;

// A mass on a spring of omega = 2 pi / s, whose other end the hand moves by A sin(omega t). Relative to the hand: z'' + 2 zeta omega z' +
// omega^2 z = A omega^2 sin(omega t), z(0) = 0, z'(0) = -A omega. (zeta = 0 as a limit.)
double driven_position(double amplitude, double omega, double zeta, double t) {
  const double drive = amplitude * std::sin(omega * t);
  if (zeta == 0.0) return 0.5 * amplitude * (std::sin(omega * t) - omega * t * std::cos(omega * t));
  const double wd = omega * std::sqrt(1.0 - zeta * zeta);
  const double free =
      std::exp(-zeta * omega * t) * (amplitude / (2.0 * zeta) * std::cos(wd * t) - amplitude * omega / (2.0 * wd) * std::sin(wd * t));
  return drive - amplitude / (2.0 * zeta) * std::cos(omega * t) + free;
}

Verdict resonate(const Integrator& method, double zeta) {
  constexpr double omega = 2.0 * pi, amplitude = 1e-3;
  TestNetwork network;
  network.system.gravity = Vec3(0.0);
  const PointId hand = network.add(Vec3(0.0)), mass = network.add({1.0, 0.0, 0.0});
  network.join(hand, mass, omega * omega, 1.0, 2.0 * zeta * omega);
  const double largest = driven_position(amplitude, omega, zeta, 20.0 - 0.25);  // [m], about the last turning point
  MonitoredRun run(network, {.integrator = &method, .substeps = is_stable_at_any_step(method) ? 1 : 20},
                   {.position = 0.02 * std::abs(largest)});
  run.lab().submit(GrabPoint{{.point = hand, .kind = GrabKind::Hold, .target = Vec3(0.0)}});

  // the largest displacement in the last period
  double reached = 0.0, exact = 0.0;
  for (int i = 1; i <= 20 * 60; ++i) {
    run.lab().submit(MoveHand{{amplitude * std::sin(omega * i / 60.0), 0.0, 0.0}});
    if (!run.frame()) break;
    if (i <= 19 * 60) continue;
    reached = std::max(reached, std::abs(run.state().position[1].x - 1.0));
    exact = std::max(exact, std::abs(driven_position(amplitude, omega, zeta, run.state().time)));
  }
  const double error = reached / exact - 1.0;
  // dissipative first-order methods cannot at one step per frame, and must report it
  const bool damps = method.order == 1 && method.energy == EnergyTrend::Falls;
  const Expectation baseline = method.order == 1 ? Expectation::HoldOrReport : expectation_of(run);
  return judge(run, damps ? Expectation::Report : baseline, std::abs(error) < 0.02,
               formatted("zeta %g: amplitude error %+.1f %%", zeta, 100.0 * error));
}

Verdict judge_resonance(const Integrator& method) { return worst_of(std::array{resonate(method, 0.0), resonate(method, 0.01)}); }

struct Sliders {
  double stiffness, damping, mass, drag;
};

// The change of energy of the current state due to new values: sum of dk (l - l0)^2 / 2 and dm (v^2 / 2 - g x).
double expected_energy_jump(const System& system, const State& state, const Sliders& to) {
  double jump = 0.0;
  for (const Spring& spring : system.springs()) {
    const double extension = strain(system, state, spring) * spring.rest_length;
    jump += 0.5 * (to.stiffness - spring.stiffness) * extension * extension;
  }
  for (Index i = 0; i < system.point_count(); ++i) {
    if (system.points()[i].nailed) continue;
    const Vec3 &x = state.position[i], &v = state.velocity[i];
    jump += (to.mass - system.points()[i].mass) * (0.5 * glm::dot(v, v) - glm::dot(system.gravity, x));
  }
  return jump;
}

// For an adaptive method: its next step size after two more frames, relative to that of a fresh run after the same two frames.
double step_ratio_to_fresh_start(MonitoredRun& run) {
  TestNetwork fresh{run.system(), run.state()};
  fresh.state.memory = {};
  MonitoredRun other(fresh, run.settings());
  for (int i = 0; i < 2; ++i) {
    run.frame();
    other.frame();
  }
  return run.state().memory.step / other.state().memory.step;
}

void set_sliders(MonitoredRun& run, const Sliders& to) {
  SetSpringProperty stiffness{SpringProperty::Stiffness, {}}, damping{SpringProperty::Damping, {}};
  for (const Spring& spring : run.system().springs()) {
    stiffness.values.emplace_back(spring.id, to.stiffness);
    damping.values.emplace_back(spring.id, to.damping);
  }
  SetPointProperty mass{PointProperty::Mass, {}};
  for (const Point& point : run.system().points()) mass.values.emplace_back(point.id, to.mass);
  run.lab().submit(stiffness);
  run.lab().submit(damping);
  run.lab().submit(mass);
  run.lab().submit(SetParameter{&drag_parameter, to.drag});
  run.lab().advance(0.0, [] { return true; });
}

Verdict judge_slider_jumps(const Integrator& method) {
  constexpr double m = 1.0 / 64.0;
  constexpr Sliders baseline{1e2, 0.0, m, 0.0};
  constexpr Sliders jumps[] = {{1e6, 0.0, m, 0.0},  {1e2, 1e3, m, 0.0},        {1e2, 0.0, 1e3 * m, 0.0},
                               {1e2, 0.0, m, 50.0}, {1e6, 1e3, 1e3 * m, 50.0}, {1e-2, 0.0, m, 0.0}};
  const InitialState net = make_net(8, baseline.stiffness, baseline.damping);
  const auto settings_of = [&](const System& system) { return settings_for(method, system, {.min = 4, .free = 4}); };
  MonitoredRun run({net.system, net.state}, settings_of(net.system));

  // every 0.1 s another setting and back, with the substeps it requires
  double worst = 0.0, max_step_ratio = 1.0;
  bool moved = false;
  Expectation expected = Expectation::Hold;
  for (int i = 0; i < 24 && !run.stopped(); ++i) {
    const Sliders& to = i % 2 == 0 ? jumps[i / 2 % std::size(jumps)] : baseline;
    const State before = run.state();
    const double energy = compute_energy(run.system(), before).total(), jump = expected_energy_jump(run.system(), before, to);
    set_sliders(run, to);
    run.lab().submit(RestoreParameter{&substeps_parameter, static_cast<double>(settings_of(run.system()).substeps)});

    moved = moved || before.position != run.state().position || before.velocity != run.state().velocity;
    const double change = compute_energy(run.system(), run.state()).total() - energy;
    worst = std::max(worst, std::abs(change - jump) / (std::abs(jump) + std::abs(energy)));
    if (is_adaptive(method)) {
      const double ratio = step_ratio_to_fresh_start(run);
      max_step_ratio = std::max({max_step_ratio, ratio, 1.0 / ratio});
    }
    run.run(is_adaptive(method) ? 0.1 - 2.0 / 60.0 : 0.1);
    if (expectation_of(run) != Expectation::Hold) expected = Expectation::HoldOrReport;
  }
  std::string measured = formatted("energy changes as expected to %.1g", worst);
  if (is_adaptive(method)) measured += formatted(", step sizes after two frames within %.2g times those of a fresh run", max_step_ratio);
  return judge(run, expected, !moved && worst < 1e-9 && max_step_ratio < 2.0, std::move(measured));
}

}  // namespace

constinit const HardCase resonance_case{
    .number = 9,
    .name = "Resonance",
    .parameters =
        "a mass on a spring whose end is driven at omega0 = 2 pi /s for 20 s, zeta = 0 and 0.01; one substep for methods stable at any "
        "step, else 20",
    .criterion =
        "amplitude within 2 % of the exact one; first-order methods whose energy falls must fail openly, other first-order methods may",
    .judge = judge_resonance,
};

constinit const HardCase slider_jumps_case{
    .number = 12,
    .name = "Parameter jumps",
    .parameters =
        "net of 8 x 8: k x 1e4 and / 1e4, d to 1e3, m x 1e3, drag to 50, one at a time and all at once, together with the substeps, every "
        "0.1 s",
    .criterion =
        "finite; the edit itself moves nothing, and the energy changes exactly by what the new values imply; an adaptive method recovers "
        "its step size within two frames",
    .slow_under = method_list<dop853, esdirk4>,
    .judge = judge_slider_jumps,
};

}  // namespace hooke
