// Static equilibria: chains, the elastic catenary and nets. Symbols: m mass, k stiffness, l0 rest length, g gravity.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/forces/forces.h"
#include "support/convergence.h"
#include "support/fall.h"
#include "support/nets.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

// Strong drag and a method that never blows up, with enough steps for all motion to decay.
void run_to_rest(TestSim& sim, double seconds) {
  sim.system.drag = 5.0;
  sim.run(*find_integrator("baraff_witkin"), seconds, static_cast<int>(std::lround(seconds / 0.05)));
}

// The largest force on a free point, relative to its own weight.
double max_residual(const TestSim& sim) {
  const Plan plan = make_plan(sim.system);
  Motion motion;
  pack(plan, sim.state, motion);
  Field force(motion.x.size());
  compute_forces(plan, 0.0, motion.x, motion.v, force);
  double greatest = 0.0;
  for (Index i = 0; i < plan.points; ++i) {
    if (plan.inverse_mass[i] == 0.0) continue;
    const Vec3 f(force[i], force[plan.points + i], force[2 * plan.points + i]);
    greatest = std::max(greatest, glm::length(f) / (plan.mass[i] * g));
  }
  return greatest;
}

// A vertical chain of springs below a nail, each with its own stiffness and rest length, with masses between them.
struct HangingChain {
  static constexpr std::array<double, 5> m{0.3, 0.1, 1.0, 0.02, 0.5}, k{400.0, 150.0, 1e4, 90.0, 300.0}, l0{0.2, 0.1, 0.3, 0.0, 0.4};

  // x_r = sum over the springs above of l0 + T / k, T = g times the masses below
  static double depth(int mass) {
    double sum = 0.0;
    for (int spring = 0; spring <= mass; ++spring) {
      double carried = 0.0;
      for (std::size_t below = spring; below < m.size(); ++below) carried += m[below];
      sum += l0[spring] + carried * g / k[spring];
    }
    return sum;
  }

  static TestSim hanging(double factor) {  // of the equilibrium depths
    TestSim sim;
    PointId above = sim.nail(Vec3(0.0));
    for (int i = 0; i < static_cast<int>(m.size()); ++i) {
      const PointId mass = sim.add({0.0, -factor * depth(i), 0.0}, m[i]);
      sim.join(above, mass, k[i], l0[i], 0.1);
      above = mass;
    }
    return sim;
  }

  static double off(const TestSim& sim) {  // relative to its length
    double worst = 0.0;
    for (int i = 0; i < static_cast<int>(m.size()); ++i)
      worst = std::max(worst, glm::distance(sim.state.position[i + 1], Vec3(0.0, -depth(i), 0.0)));
    return worst / depth(static_cast<int>(m.size()) - 1);
  }
};

class Hanging : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Hanging, testing::ValuesIn(every_method()), method_name);

// the equilibrium is the same for every method at any stable step; only XPBD with one sweep over the springs does not support the weight of
// all masses below
TEST_P(Hanging, ChainStaysAtItsEquilibriumLengths) {
  const auto off = [&](int steps) {
    TestSim sim = HangingChain::hanging(1.0);
    sim.run(method(), 1.0, steps);
    return HangingChain::off(sim);
  };
  if (method().stability == Stability::EachSpring && !method().iterates()) {
    EXPECT_LT(off(2000), 2e-4);
    EXPECT_LT(off(8000), 0.25 * off(2000));
  } else {
    EXPECT_LT(off(method().stability == Stability::None ? 20000 : 2000), 1e-13);
  }
}

TEST(Hanging, ChainReachesItsEquilibriumLengths) {
  TestSim sim = HangingChain::hanging(0.7);
  EXPECT_GT(HangingChain::off(sim), 0.1);
  run_to_rest(sim, 60.0);
  EXPECT_LT(HangingChain::off(sim), 1e-12);
}

TEST(Hanging, NetComesToRestWithoutResidual) {
  TestSim sim = net(12, 1e3, 0.0);
  Random random(7);
  for (Index i = 0; i < sim.system.point_count(); ++i)
    if (!sim.system.points()[i].nailed)
      sim.state.position[i] += 0.03 * Vec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  EXPECT_GT(max_residual(sim), 1.0);
  run_to_rest(sim, 40.0);
  EXPECT_LT(max_residual(sim), 1e-10);
}

// The elastic catenary between two nails (H. M. Irvine, Cable Structures, 1981): p the unstretched length from the lowest point, H the
// horizontal tension, w = M g / L the weight per unstretched length, x(p) = H / w asinh(w p / H) + H p / EA,  y(p) = sqrt((H / w)^2 + p^2)
// + w p^2 / (2 EA).
struct Catenary {
  double length, weight, EA;    // [m], [N/m], [N]
  double H = 0.0, start = 0.0;  // [N]; p at the first nail

  double x(double p) const { return H / weight * std::asinh(weight * p / H) + H * p / EA; }
  double y(double p) const { return std::hypot(H / weight, p) + weight * p * p / (2.0 * EA); }

  // H and the start for a second nail at `apart` from the first, by Newton's method
  void span(const Vec3& apart) {
    H = 0.5 * weight * length;
    start = -0.5 * length;
    const auto miss = [&](double at_H, double at_start) {
      const Catenary tried{length, weight, EA, at_H, at_start};
      return std::array{tried.x(at_start + length) - tried.x(at_start) - apart.x, tried.y(at_start + length) - tried.y(at_start) - apart.y};
    };
    for (int i = 0; i < 40; ++i) {
      const double step = 1e-7;
      const auto here = miss(H, start), more_H = miss(H * (1.0 + step), start), more_start = miss(H, start + step);
      const double a = (more_H[0] - here[0]) / (H * step), b = (more_start[0] - here[0]) / step;
      const double c = (more_H[1] - here[1]) / (H * step), d = (more_start[1] - here[1]) / step;
      const double to_H = -(d * here[0] - b * here[1]) / (a * d - b * c), to_start = -(a * here[1] - c * here[0]) / (a * d - b * c);
      H = std::max(0.2 * H, H + to_H);
      start += to_start;
    }
    const auto left = miss(H, start);
    EXPECT_LT(std::abs(left[0]) + std::abs(left[1]), 1e-12);
  }
};

// A chain of N springs, k = EA / l0, with M / N at each point between them: second order in 1 / N.
TEST(Hanging, RopeConvergesToTheElasticCatenary) {
  const double mass = 0.5, length = 1.2;
  const Vec3 apart(1.0, -0.3, 0.0);
  for (const double EA : {20.0, 1000.0}) {
    Catenary exact{length, mass * g / length, EA};
    exact.span(apart);
    const auto error = [&](int springs) {
      TestSim sim;
      PointId last = sim.nail(Vec3(0.0));
      for (int j = 1; j <= springs; ++j) {
        const Vec3 x = static_cast<double>(j) / springs * apart;
        const PointId next =
            j == springs ? sim.nail(x) : sim.add(x - Vec3(0.0, 0.1 * std::sin(std::numbers::pi * j / springs), 0.0), mass / springs);
        sim.join(last, next, EA * springs / length, length / springs);
        last = next;
      }
      run_to_rest(sim, 60.0);
      double sum = 0.0;
      for (int j = 0; j <= springs; ++j) {
        const double p = exact.start + length * j / springs;
        const Vec3 there(exact.x(p) - exact.x(exact.start), exact.y(p) - exact.y(exact.start), 0.0);
        sum += std::pow(glm::distance(sim.state.position[j], there), 2) / (springs + 1);
      }
      return std::sqrt(sum);
    };
    SCOPED_TRACE(testing::Message() << "EA = " << EA);
    EXPECT_LT(error(16), 2e-3);
    expect_order(error, 16, 2.0, 0.1);
  }
}

}  // namespace
}  // namespace hooke
