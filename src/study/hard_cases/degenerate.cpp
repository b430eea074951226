// Degenerate scenes: zero lengths, undefined directions, many springs on one point.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

constexpr Vec3 no_gravity{0.0};

// The error [m] that a method of order p may have on a harmonic motion of amplitude A: A omega t (h omega)^p (the constants of all methods
// are below one), plus the tolerance of an adaptive method.
double allowed_error(const Integrator& method, double amplitude, double omega, double t, double h) {
  return amplitude * omega * t * std::pow(h * omega, method.order) + 1e-5 * amplitude;
}

// x(t) = x0 cos w t + v0 / w sin w t, w = sqrt(k / m): on an ellipse, and on a line through the length zero.
Verdict judge_zero_length_spring(const Integrator& method) {
  constexpr double omega = 10.0, seconds = 2.0;
  constexpr int substeps = 40;
  std::vector<Verdict> parts;
  struct InitialState {
    Vec3 x, v;
  };
  for (const InitialState& start :
       {InitialState{{0.1, 0.0, 0.0}, {0.0, 0.5, 0.0}}, InitialState{{0.1, 0.0, 0.0}, {}}, InitialState{{}, {1.0, 0.0, 0.0}}}) {
    TestNetwork network;
    network.system.gravity = no_gravity;
    const PointId nail = network.nail(Vec3(0.0));
    network.join(nail, network.add(start.x, 1.0, start.v), omega * omega, 0.0);
    MonitoredRun run(network, {.integrator = &method, .substeps = substeps});
    run.run(seconds);
    const Vec3 exact = std::cos(omega * seconds) * start.x + std::sin(omega * seconds) / omega * start.v;
    const double error = glm::distance(run.state().position[1], exact);
    parts.push_back(
        judge(run, error <= allowed_error(method, 0.1, omega, seconds, run.settings().substep()), formatted("error %.1g m", error)));
  }
  return worst_of(parts);
}

// A star of four springs of length 0.1 m, with all five points at one position.
Verdict judge_coincident_points(const Integrator& method) {
  std::vector<Verdict> parts;
  for (const double apart : {0.0, 1e-12}) {
    TestNetwork network;
    network.system.gravity = no_gravity;
    const PointId center = network.add({0.3, -0.2, 0.1});
    for (int i = 0; i < 4; ++i) {
      const double angle = 1.5 * i;
      network.join(center, network.add(network.state.position[0] + apart * Vec3(std::cos(angle), std::sin(angle), 0.3)), 100.0, 0.1);
    }
    // drag keeps methods that require damping within their limit
    network.system.drag = 1.0;
    MonitoredRun run(network, {.integrator = &method, .substeps = 20});
    double longest = 0.0;
    for (int i = 0; i < 60 && run.frame(); ++i)
      longest = std::max(longest, glm::distance(run.state().position[0], run.state().position[1]));
    const double momentum = glm::length(compute_momentum(run.system(), run.state()).linear);
    const bool separated = longest >= 0.05;
    parts.push_back(judge(run, momentum < 1e-9 && separated == (apart > 0.0),
                          formatted("initial distance %g m: %.2g m later, momentum %.1g kg m/s", apart, longest, momentum)));
  }
  return worst_of(parts);
}

// Two springs between the same points act as one of twice the stiffness.
Verdict judge_duplicates(const Integrator& method) {
  const auto swing = [&](int springs, double k) {
    TestNetwork network;
    const PointId nail = network.nail(Vec3(0.0)), point = network.add({1.0, 0.0, 0.0});
    for (int i = 0; i < springs; ++i) network.join(nail, point, k, 1.0);
    MonitoredRun run(network, {.integrator = &method, .substeps = 40});
    run.run(1.0);
    return run;
  };
  const MonitoredRun two = swing(2, 50.0), one = swing(1, 100.0);
  const double apart = glm::distance(two.state().position[1], one.state().position[1]);
  // a method that processes the springs one by one treats them as two
  const double allowed = method.stability == Stability::EachSpring ? 0.1 : 1e-6;
  return judge(two, apart <= allowed, formatted("two springs differ by %.1g m from one of twice the stiffness", apart));
}

// A thousand springs from nails on a circle to one point at its center.
Verdict judge_hub(const Integrator& method) {
  constexpr int spokes = 1000;
  TestNetwork network;
  const PointId hub = network.add({0.3, 0.1, 0.0}, 1.0);
  for (int i = 0; i < spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / spokes;
    network.join(network.nail({std::cos(angle), std::sin(angle), 0.0}), hub, 10.0, 0.5);
  }
  // more than half of the critical damping of the hub, 2 sqrt(k spokes 0.75 / m)
  network.system.drag = 100.0;
  MonitoredRun run(network, settings_for(method, network.system, {.min = 8, .free = 8, .fraction = 0.5}), {.position = 1e-5});
  run.run(0.5);

  // at rest: k spokes (1 - l0 / (2 l)) x = m g for a small displacement x from the center, l = 1
  const double exact = -9.81 / (10.0 * spokes * 0.75);
  const double off = glm::distance(run.state().position[0], {0.0, exact, 0.0});
  return judge(run, off < 1e-5, formatted("hub of %d springs at rest with an error of %.1g m", spokes, off));
}

Verdict judge_springs_on_one_point(const Integrator& method) { return worst_of(std::array{judge_duplicates(method), judge_hub(method)}); }

}  // namespace

constinit const HardCase zero_length_spring_case{
    .number = 5,
    .name = "Zero-length spring",
    .parameters = "l0 = 0, omega = 10 /s, 40 substeps, 2 s: on an ellipse, through the nail, and starting at the nail",
    .criterion = "harmonic motion to the order of the method: A omega t (h omega)^p",
    .judge = judge_zero_length_spring,
};

constinit const HardCase coincident_points_case{
    .number = 6,
    .name = "Coincident points",
    .parameters = "five points at one position, four springs of 0.1 m",
    .criterion = "positions stay finite and momentum is conserved; points 1e-12 m apart separate",
    .judge = judge_coincident_points,
};

constinit const HardCase springs_on_one_point_case{
    .number = 25,
    .name = "Springs on one point",
    .parameters = "two springs between the same points, 1000 on one point",
    .criterion = "equal to one spring of twice the stiffness to 1e-6 m; at rest at the exact position to 1e-5 m",
    .remark = "xpbd, which processes two springs one after the other, may differ by 0.1 m from one of twice the stiffness",
    .judge = judge_springs_on_one_point,
};

}  // namespace hooke
