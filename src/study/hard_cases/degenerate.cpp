// Degenerate scenes: zero lengths, undefined directions.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

}  // namespace hooke
