#include "lab/scene_nets.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "lab/generators.h"

namespace hooke {
namespace {

constexpr double gravity = 9.81;  // [m/s^2]

Start start_of(Network network) {
  Start start;
  start.system.gravity = {0.0, -gravity, 0.0};
  start.system.set_points(std::move(network.points));
  start.system.set_springs(std::move(network.springs));
  start.state.position = std::move(network.position);
  start.state.velocity = std::move(network.velocity);
  return start;
}

// n x n points on 1 m x 1 m, 1 kg, the top row nailed, swinging out of its plane with v_z = push s (1 + cos(pi u)) / 2.
Start make_sheet(int n, double k, double k_diagonal, double d, double push) {
  Cloth cloth{.columns = n,
              .rows = n,
              .fabric = {.mass_model = MassModel::Equal, .mass = 1.0, .stiffness = k, .damping = d, .nails = std::vector<Index>(n)},
              .shear_stiffness = k_diagonal};
  std::iota(cloth.fabric.nails.begin(), cloth.fabric.nails.end(), 0);
  Network network;
  generate(cloth, network);

  for (std::size_t i = 0; i < network.points.size(); ++i) {
    const double u = network.position[i].x, s = -network.position[i].y;
    network.velocity[i].z = 0.5 * push * s * (1.0 + std::cos(std::numbers::pi * u));
  }
  return start_of(std::move(network));
}

}  // namespace

Start make_net(int n, double k, double d) {
  Start start = make_sheet(n, k, 0.0, d, 0.5);

  // the springs down to row r carry the n - r rows below
  const double weight = gravity / (n * n);
  double lowered = 0.0;
  for (int row = 1; row < n; ++row) {
    lowered += (n - row) * weight / k;
    for (int column = 0; column < n; ++column) start.state.position[row * n + column].y -= lowered;
  }
  return start;
}

Start make_curtain(int n, double k, double d) { return make_sheet(n, k, k, d, 1.0); }

Start make_chain(int links, double mass_ratio) {
  constexpr double m = 1e-3, stretch = 0.05, spin = 1.0;  // [kg], [1], [rad/s]
  const double a = 1.0 / links, end_mass = m * mass_ratio;
  const double k = end_mass * gravity / (stretch * a);

  Network network;
  generate(Rope{.to = {0.0, -1.0, 0.0}, .points = links + 1, .fabric = {.mass = m * (links + 1), .stiffness = k, .nails = {0}}}, network);
  network.points.back().mass = end_mass;

  // a link carries the points below it
  double y = 0.0;
  for (int link = 0; link < links; ++link) {
    const double carried = (links - 1 - link) * m + end_mass;
    y -= a + carried * gravity / k;
    network.position[link + 1].y = y;
    network.velocity[link + 1].x = -spin * y;
  }
  return start_of(std::move(network));
}

}  // namespace hooke
