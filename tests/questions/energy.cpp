// A mass on a spring, h omega = 0.1, no damping: its energy over 20 periods.
#include <cmath>

#include "question.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/integrator.h"
#include "support/test_sim.h"

namespace hooke {

Answer why_explicit_euler_gains_energy() {
  constexpr double h_omega = 0.1, stiffness = 1.0;
  Answer answer{{.title = "Energy of a mass on a spring, undamped, 63 steps per period",
                 .x = "periods",
                 .y = "energy / energy at the start",
                 .log_y = true,
                 .series = {}},
                {}};
  for (const char* id : {"explicit_euler", "symplectic_euler", "velocity_verlet", "runge_kutta4", "implicit_midpoint", "implicit_euler"}) {
    TestSim sim;
    sim.system.gravity = Vec3(0.0);
    const PointId nail = sim.nail({0.0, 0.0, 0.0}), mass = sim.add({0.1, 0.0, 0.0});
    sim.join(nail, mass, stiffness, 0.0);
    const double start = compute_energy(sim.system, sim.state).total();
    Series series{id, {{0.0, 1.0}}};
    for (double t = h_omega; t < 20.0 * 2.0 * M_PI; t += h_omega) {
      sim.run(*find_integrator(id), h_omega, 1);
      series.points.push_back({t / (2.0 * M_PI), compute_energy(sim.system, sim.state).total() / start});
    }
    answer.chart.series.push_back(std::move(series));
  }
  const auto last = [&](int s) { return answer.chart.series[s].points.back().second; };
  const double steps = static_cast<double>(answer.chart.series[0].points.size() - 1);
  answer.expect(std::abs(last(0) / std::pow(1.0 + h_omega * h_omega, steps) - 1.0) < 1e-9,
                "explicit Euler multiplies the energy by 1 + (h omega)^2 per step");
  double worst = 0.0;
  for (const auto& [t, e] : answer.chart.series[1].points) worst = std::max(worst, std::abs(e - 1.0));
  answer.expect(worst < 0.06, "the energy of symplectic Euler stays within h omega / 2 at all times");
  answer.expect(last(5) < 1e-3, "implicit Euler loses it as fast as explicit Euler gains it");
  return answer;
}

}  // namespace hooke
