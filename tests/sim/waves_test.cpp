// Waves: on a ring of springs, where the solution is exact, and through a square lattice, where long waves are those of an elastic sheet.
// Symbols: m mass, k stiffness, a spacing, q wave number, w angular frequency.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/convergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

using std::numbers::pi;

class Ring : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Ring, testing::ValuesIn(every_method()), method_name);

// Springs without rest length are linear: x_j = R (cos(q j - w t), sin(q j - w t)) travels around a ring of them at any R, with w = 2
// sqrt(k / m) sin(q / 2).
TEST_P(Ring, WavesFollowTheDispersionRelation) {
  constexpr int masses = 12;
  const double m = 0.2, k = 300.0, radius = 0.4;
  for (int n = 1; n <= masses / 2; ++n) {
    const double q = 2.0 * pi * n / masses, w = 2.0 * std::sqrt(k / m) * std::sin(0.5 * q), seconds = 2.5 / w;
    const auto error = [&](int steps) {
      TestSim sim;
      sim.system.gravity = Vec3(0.0);
      for (int j = 0; j < masses; ++j)
        sim.add(radius * Vec3(std::cos(q * j), std::sin(q * j), 0.0), m, w * radius * Vec3(std::sin(q * j), -std::cos(q * j), 0.0));
      for (int j = 0; j < masses; ++j) sim.join(sim.system.points()[j].id, sim.system.points()[(j + 1) % masses].id, k, 0.0);
      sim.run(method(), seconds, steps);
      double worst = 0.0;
      for (int j = 0; j < masses; ++j) {
        const double phase = q * j - w * seconds;
        worst = std::max(worst, glm::distance(sim.state.position[j], radius * Vec3(std::cos(phase), std::sin(phase), 0.0)));
      }
      return worst;
    };
    SCOPED_TRACE(testing::Message() << "wave " << n);
    // errors that one sweep over the springs leaves initially fall faster than the order
    if (method().stability == Stability::EachSpring) {
      EXPECT_LT(error(16000), 1e-3 * radius);
    } else {
      expect_order(error, asymptotic_steps(method().order) / (method().order == 1 ? 10 : 2), method().order);
    }
  }
}

// A square lattice in its plane with structural springs k1, both diagonals k2 and one point per cell: density m / a^2 and C11 = k1 + k2,
// C12 = C44 = k2, isotropic if k1 = 2 k2.
struct Lattice {
  double k1, k2;
  static constexpr double m = 0.01, a = 0.05;

  double along() const { return a * std::sqrt((k1 + k2) / m); }                       // c_L along the rows
  double across() const { return a * std::sqrt(k2 / m); }                             // c_T
  double along_diagonal() const { return a * std::sqrt((0.5 * k1 + 2.0 * k2) / m); }  // (C11 + C12 + 2 C44) / 2
  double across_diagonal() const { return a * std::sqrt(0.5 * k1 / m); }              // (C11 - C12) / 2

  // The speed [m/s] of a plane wave of `cells` spacings wavelength propagating at `angle` to the rows, longitudinal or transverse. A
  // standing wave u cos(w t) is released; the displacement at the center after the expected quarter period gives w. By then, waves from the
  // edges of the sample have not reached the center.
  double measured_speed(double angle, bool shakes_along, int cells, double expected) const {
    const double q = 2.0 * pi / (cells * a), amplitude = 1e-6 * a, quarter = 0.25 * cells * a / expected;
    const Vec3 direction(std::cos(angle), std::sin(angle), 0.0), shake = shakes_along ? direction : Vec3(-direction.y, direction.x, 0.0);
    const int reach = static_cast<int>(1.2 * quarter * std::max(along(), along_diagonal()) / a) + 4, side = 2 * reach + 1;

    TestSim sim;
    sim.system.dimensions = 2;
    sim.system.gravity = Vec3(0.0);
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const Vec3 x = a * Vec3(column - reach, row - reach, 0.0);
        sim.add(x + amplitude * std::cos(q * glm::dot(direction, x)) * shake, m);
      }
    const auto join = [&](int first, int second, double k, double length) {
      sim.join(sim.system.points()[first].id, sim.system.points()[second].id, k, length);
    };
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column) {
        const int here = row * side + column;
        if (column + 1 < side) join(here, here + 1, k1, a);
        if (row + 1 < side) join(here, here + side, k1, a);
        if (row + 1 < side && column + 1 < side) join(here, here + side + 1, k2, std::numbers::sqrt2 * a);
        if (row + 1 < side && column > 0) join(here, here + side - 1, k2, std::numbers::sqrt2 * a);
      }
    sim.run(*find_integrator("runge_kutta4"), quarter, 6 * cells);
    const double left = glm::dot(sim.state.position[reach * side + reach], shake) / amplitude;
    return std::acos(left) / (quarter * q);
  }

  // and the error converges with the square of a q: a chain at wavelength n a is (pi / n)^2 / 6 slower, the diagonals twice that
  void expect_speed(double angle, bool shakes_along, double expected) const {
    const double coarse = 1.0 - measured_speed(angle, shakes_along, 12, expected) / expected;
    const double fine = 1.0 - measured_speed(angle, shakes_along, 24, expected) / expected;
    EXPECT_LT(std::abs(coarse), 2.0 * std::pow(pi / 12.0, 2) / 6.0);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << "off by " << coarse << " and " << fine;
  }
};

TEST(Lattice, WavesAlongRowsAndDiagonalsHaveTheSpeedsOfASheet) {
  for (const Lattice lattice : {Lattice{300.0, 50.0}, {200.0, 100.0}, {80.0, 120.0}}) {
    SCOPED_TRACE(testing::Message() << "k1 = " << lattice.k1 << ", k2 = " << lattice.k2);
    lattice.expect_speed(0.0, true, lattice.along());
    lattice.expect_speed(0.0, false, lattice.across());
    lattice.expect_speed(0.25 * pi, true, lattice.along_diagonal());
    lattice.expect_speed(0.25 * pi, false, lattice.across_diagonal());
  }
}

TEST(Lattice, WithDiagonalsHalfAsStiffIsIsotropic) {
  const Lattice lattice{200.0, 100.0};
  for (const double angle : {0.2, 0.4, 0.6}) {
    SCOPED_TRACE(testing::Message() << "angle " << angle);
    lattice.expect_speed(angle, true, lattice.along());
    lattice.expect_speed(angle, false, lattice.across());
  }
}

}  // namespace
}  // namespace hooke
