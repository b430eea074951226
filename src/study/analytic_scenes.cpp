#include "study/analytic_scenes.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "scene/shapes/cloth.h"
#include "scene/shapes/rope.h"

namespace hooke {
namespace {

constexpr double gravity = 9.81;  // [m/s^2]

InitialState initial_state_of(Network network) {
  InitialState start;
  start.system.gravity = {0.0, -gravity, 0.0};
  start.system.set_points(std::move(network.points));
  start.system.set_springs(std::move(network.springs));
  start.state.position = std::move(network.position);
  start.state.velocity = std::move(network.velocity);
  return start;
}

// n x n points on 1 m x 1 m, 1 kg, the top row nailed, swinging out of its plane with v_z = push s (1 + cos(pi u)) / 2.
InitialState make_analytic_sheet(int n, double k, double k_diagonal, double d, double initial_speed) {
  Cloth cloth{.columns = n,
              .rows = n,
              .fabric = {.mass_model = MassModel::Equal, .mass = 1.0, .stiffness = k, .damping = d, .nails = std::vector<Index>(n)},
              .shear_stiffness = k_diagonal};
  std::iota(cloth.fabric.nails.begin(), cloth.fabric.nails.end(), 0);
  Network network;
  generate(cloth, network);

  for (std::size_t i = 0; i < network.points.size(); ++i) {
    const double u = network.position[i].x, s = -network.position[i].y;
    network.velocity[i].z = 0.5 * initial_speed * s * (1.0 + std::cos(std::numbers::pi * u));
  }
  return initial_state_of(std::move(network));
}

}  // namespace

InitialState make_net(int n, double k, double d) {
  InitialState start = make_analytic_sheet(n, k, 0.0, d, 0.5);

  // the springs down to row r carry the n - r rows below it
  const double weight = gravity / (n * n);
  double sag = 0.0;
  for (int row = 1; row < n; ++row) {
    sag += (n - row) * weight / k;
    for (int column = 0; column < n; ++column) start.state.position[row * n + column].y -= sag;
  }
  return start;
}

InitialState make_curtain(int n, double k, double d) { return make_analytic_sheet(n, k, k, d, 1.0); }

InitialState make_chain(int links, double mass_ratio) {
  constexpr double m = 1e-3, stretch = 0.05, spin = 1.0;  // [kg], [1], [rad/s]
  const double a = 1.0 / links, end_mass = m * mass_ratio;
  const double k = end_mass * gravity / (stretch * a);

  Network network;
  generate(Rope{.to = {0.0, -1.0, 0.0}, .points = links + 1, .fabric = {.mass = m * (links + 1), .stiffness = k, .nails = {0}}}, network);
  network.points.back().mass = end_mass;

  // a link carries the points below it
  double y = 0.0;
  for (int link = 0; link < links; ++link) {
    const double suspended_mass = (links - 1 - link) * m + end_mass;
    y -= a + suspended_mass * gravity / k;
    network.position[link + 1].y = y;
    network.velocity[link + 1].x = -spin * y;
  }
  return initial_state_of(std::move(network));
}

}  // namespace hooke
