// Chains and ropes, which transmit a force from link to link.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/forces.h"
#include "sim/methods/rows.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

constexpr double g = 9.81;  // [m/s^2]

struct ChainShape {
  int links;
  double length;     // [m], unstretched
  double link_mass;  // [kg]
  double end_mass;   // [kg]
  double stretch;    // [1], of the last link under the end mass
  double stiffness() const { return end_mass * g / (stretch * length / links); }
  // Link r carries all masses below it: its length is l0 + T / k, T = g times their sum.
  double length_of(int link) const {
    const double carried = end_mass + (links - 1 - link) * link_mass;
    return length / links + carried * g / stiffness();
  }
  double extension() const {
    double sum = 0.0;
    for (int link = 0; link < links; ++link) sum += length_of(link) - length / links;
    return sum;
  }
};

// Hanging vertically from a nail at the origin, rotated by `angle` about it; in equilibrium, or unstretched.
TestNetwork make_hanging_chain(const ChainShape& shape, bool stretched, double angle) {
  TestNetwork network;
  const Vec3 along{std::sin(angle), -std::cos(angle), 0.0};
  PointId above = network.nail(Vec3(0.0));
  double at = 0.0;
  for (int link = 0; link < shape.links; ++link) {
    at += stretched ? shape.length_of(link) : shape.length / shape.links;
    const PointId below = network.add(at * along, link + 1 == shape.links ? shape.end_mass : shape.link_mass);
    network.join(above, below, shape.stiffness(), shape.length / shape.links);
    above = below;
  }
  return network;
}

// Methods that are stable at any step get some substeps for accuracy.
constexpr Stepping stepping{.free = 4, .max = 20000};

double extension_of(const MonitoredRun& run, const ChainShape& shape) { return glm::length(run.state().position.back()) - shape.length; }

Verdict judge_mass_ratio(const Integrator& method) {
  constexpr ChainShape shape{.links = 200, .length = 1.0, .link_mass = 1e-3, .end_mass = 1e3, .stretch = 0.05};
  TestNetwork network = make_hanging_chain(shape, false, 0.0);
  network.system.drag = 4.0;
  MonitoredRun run(network, settings_for(method, network.system, stepping), {.position = 0.01 * shape.extension()});
  run.run(5.0);
  const double error = extension_of(run, shape) / shape.extension() - 1.0;
  return judge(run, std::abs(error) < 0.01, formatted("stretch error %+.1g, %d substeps", error, run.settings().substeps));
}

constexpr ChainShape long_chain{.links = 1000, .length = 1.0, .link_mass = 1e-4, .end_mass = 1.0, .stretch = 0.05};

// Dropped unstretched, it settles at its equilibrium length.
Verdict settle(const Integrator& method) {
  TestNetwork dropped = make_hanging_chain(long_chain, false, 0.0);
  dropped.system.drag = 25.0;
  MonitoredRun run(dropped, settings_for(method, dropped.system, stepping), {.position = 1e-3 * long_chain.extension()});
  run.run(1.5);
  const double error = extension_of(run, long_chain) / long_chain.extension() - 1.0;
  return judge(run, std::abs(error) < 1e-3, formatted("elongation error %+.1g", error));
}

// Released at an angle, it swings like a rigid rod with a weight, up to terms of (rod / weight)^2 = 0.01: omega^2 = g (M L + m L / 2) / (M
// L^2 + m L^2 / 3)
Verdict swing(const Integrator& method) {
  constexpr double angle = 0.01;
  const double length = long_chain.length + long_chain.extension(), rod = (long_chain.links - 1) * long_chain.link_mass;
  const double omega = std::sqrt(g / length * (long_chain.end_mass + rod / 2.0) / (long_chain.end_mass + rod / 3.0));

  const TestNetwork tilted = make_hanging_chain(long_chain, true, angle);
  MonitoredRun run(tilted, settings_for(method, tilted.system, stepping), {.position = 0.01 * angle});
  double before = tilted.state.position.back().x, now = before;
  while (now > 0.0 && run.state().time < 1.0 && run.frame()) {
    before = now;
    now = run.state().position.back().x;
  }
  const double quarter = run.state().time - now / (now - before) / 60.0;  // [s], to the vertical
  const double error = quarter * omega / (std::numbers::pi / 2.0) - 1.0;
  return judge(run, std::abs(error) < 0.01, formatted("period error %+.1g, %d substeps", error, run.settings().substeps));
}

Verdict judge_long_chain(const Integrator& method) { return worst_of(std::array{settle(method), swing(method)}); }

// The largest force on a free point [N].
double largest_residual(const System& system, const State& state) {
  const Plan plan = make_plan(system);
  Motion motion;
  pack(plan, state, motion);
  compute_position_forces(plan, state.time, motion.x, motion.v, motion.a);
  double largest = 0.0;
  for (Index i = 0; i < plan.points; ++i)
    for (int c = 0; c < plan.dimensions && plan.inverse_mass[i] > 0.0; ++c)
      largest = std::max(largest, std::abs(motion.a[static_cast<std::size_t>(c) * plan.points + i]));
  return largest;
}

Verdict relax(const Integrator& method, TestNetwork network, const char* name) {
  // displaced by a tenth of the rest length, l0 = 1 m
  Random random(13);
  for (Index i = 0; i < network.system.point_count(); ++i)
    if (!network.system.points()[i].nailed) network.state.position[i] += random.vector(0.1);
  network.system.gravity = Vec3(0.0);
  network.system.drag = 1.0;

  // well within the limit, otherwise explicit Euler does not damp the fastest modes
  MonitoredRun run(network, settings_for(method, network.system, {.fraction = 0.25}), {.position = 1e-8});
  run.run(60.0);
  const double residual = largest_residual(run.system(), run.state()) / run.system().springs()[0].stiffness;
  double off = 0.0;
  for (const Spring& spring : run.system().springs()) off = std::max(off, std::abs(strain(run.system(), run.state(), spring) - 2.0));
  return judge(run, residual < 1e-8 && off < 1e-8, std::string(name) + formatted(": residual %.1g k l0, strain error %.1g", residual, off));
}

Verdict judge_over_constrained(const Integrator& method) {
  constexpr double rest_length = 1.0, apart = 3.0 * rest_length, k = 100.0;
  TestNetwork rope;
  PointId last = rope.nail(Vec3(0.0));
  for (int i = 1; i < 50; ++i) {
    const Vec3 at{i * apart, 0.0, 0.0};
    const PointId next = i == 49 ? rope.nail(at) : rope.add(at);
    rope.join(last, next, k, rest_length);
    last = next;
  }

  TestNetwork sheet = make_sheet({.rows = 12, .columns = 12, .across = {apart, 0.0, 0.0}, .down = {0.0, -apart, 0.0}, .stiffness = k});
  for (Index i = 0; i < 144; ++i) sheet.system.point(i).nailed = i < 12 || i >= 132 || i % 12 == 0 || i % 12 == 11;
  for (Index s = 0; s < sheet.system.spring_count(); ++s) sheet.system.spring(s)->rest_length = rest_length;

  return worst_of(std::array{relax(method, rope, "rope"), relax(method, sheet, "sheet")});
}

}  // namespace

constinit const HardCase mass_ratio_case{
    .number = 3,
    .name = "Mass ratio 1e6",
    .parameters = "chain of 200 links of 1 g with 1000 kg at its end, 5 % stretch, drag 4 /s, 5 s",
    .criterion = "static stretch within 1 %",
    .slow_under = method_list<symplectic_euler, velocity_verlet, blanes_moan4, runge_kutta4, dop853, esdirk4>,
    .judge = judge_mass_ratio,
};

constinit const HardCase long_chain_case{
    .number = 4,
    .name = "Long chain with a heavy end",
    .parameters = "1000 links of 0.1 g, 1 m, 1 kg at the end, 5 % stretch; dropped unstretched under drag 25 /s, and swinging freely",
    .criterion = "elongation within 1e-3, swing period within 1 %",
    .slow_under = method_list<symplectic_euler, blanes_moan4, runge_kutta4, dop853, implicit_euler, implicit_midpoint, esdirk4>,
    .judge = judge_long_chain,
};

constinit const HardCase over_constrained_case{
    .number = 13,
    .name = "Over-constrained",
    .parameters = "rope of 50 and sheet of 12 x 12, nailed all around at 3 times the rest length, displaced by 0.1 l0, drag 1 /s, 60 s",
    .criterion = "static residual < 1e-8 k l0, strain 2 to 1e-8",
    .slow_under = method_list<baraff_witkin, implicit_midpoint, tr_bdf2, esdirk4>,
    .judge = judge_over_constrained,
};

}  // namespace hooke
