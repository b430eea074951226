// Velocity Verlet with dashpots and wind among the forces: order, error, momentum, energy and work.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "sim/forces/energy/energy.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/nets.h"
#include "support/next_frame.h"

namespace hooke {
namespace {

constexpr double frame_rate = 60.0;
constexpr ForceValues breeze{2.0, 1.0, -3.0, 0.6, 0.1, 0.0, 1.0, 1.0}, storm{12.0, 5.0, -20.0, 1.2, 0.2, 0.0, 1.0, 1.0};

struct RunOutcome {
  State state;
  long evaluations = 0, sweeps = 0;
  double work = 0.0;  // [J], of the wind
};

RunOutcome run(const TestSim& start, int frames, const Settings& settings) {
  Plan plan = make_plan(start.system);
  Frame frame;
  RunOutcome result{.state = start.state};
  for (int i = 0; i < frames; ++i) {
    result.state = next_frame(plan, frame, start.system, settings, result.state);
    result.evaluations += frame.motion().counts.force_evaluations;
    result.sweeps += frame.motion().counts.dashpot_sweeps;
    result.work += frame.motion().energy.forces();
  }
  return result;
}
RunOutcome run(const TestSim& start, int frames, int substeps, const Integrator& method = velocity_verlet_explicit) {
  return run(start, frames, Settings{.integrator = &method, .substeps = substeps});
}
RunOutcome exact_run(const TestSim& start, int frames) { return run(start, frames, Settings{.integrator = &dop853, .tolerance = 1e-13}); }

// The fewest substeps within the limit, with this part of it.
int min_substeps(const TestSim& sim, double part) {
  return static_cast<int>(
      std::ceil(1.0 / (part * frame_rate * largest_stable_step(velocity_verlet_explicit, make_plan(sim.system).spectrum))));
}

// A net in free flight that vibrates at all frequencies.
TestSim free_net(double damping) {
  TestSim sim = net(17, 500.0, damping);
  sim.system.gravity = {};
  std::uint64_t random = 1;
  for (Index i = 0; i < sim.system.point_count(); ++i) {
    sim.system.point(i).nailed = false;
    for (int c = 0; c < 3; ++c) {
      random = random * 6364136223846793005u + 1442695040888963407u;
      sim.state.velocity[i][c] = 0.2 * (static_cast<double>(random >> 33) / 0x1p30 - 1.0);
    }
  }
  return sim;
}

// A swinging net with faces in wind.
TestSim net_in_wind(double damping, const ForceValues& wind) {
  constexpr int n = 17;
  TestSim sim = net(n, 500.0, damping);
  const auto id = [&](int row, int column) { return sim.system.points()[sheet::at(n, row, column)].id; };
  for (int row = 0; row + 1 < n; ++row)
    for (int column = 0; column + 1 < n; ++column) {
      sim.system.faces.push_back({{id(row, column), id(row + 1, column), id(row, column + 1)}});
      sim.system.faces.push_back({{id(row, column + 1), id(row + 1, column), id(row + 1, column + 1)}});
    }
  sim.system.forces = {{.term = &wind_force, .values = wind}};
  return sim;
}

TEST(ExplicitVerlet, EvaluatesEverythingOncePerStep) {
  for (const TestSim& sim : {net(17, 500.0, 0.1), net(5, 500.0, 0.1), net_in_wind(0.0, breeze), net_in_wind(0.1, storm)}) {
    const RunOutcome outcome = run(sim, 1, 40);
    // and once at the start of the frame
    EXPECT_EQ(outcome.evaluations, 41);
    EXPECT_EQ(outcome.sweeps, 0);
  }
}

TEST(ExplicitVerlet, KeepsItsOrderWithDashpots) {
  for (const int points : {5, 17})
    for (const double damping : {0.01, 0.1, 1.0}) {
      TestSim sim = net(points, 500.0, damping);
      for (const double drag : {0.0, 4.0}) {
        sim.system.drag = drag;
        const State exact = exact_run(sim, 6).state;
        const auto error = [&](int substeps) { return distance(run(sim, 6, substeps).state, exact); };
        EXPECT_NEAR(measured_order(error, 60), velocity_verlet_explicit.order_with.damped, 0.1) << points << ", " << damping;
      }
    }
}

TEST(ExplicitVerlet, KeepsItsOrderInWind) {
  for (const double damping : {0.0, 0.1})
    for (const ForceValues& wind : {breeze, storm}) {
      TestSim sim = net_in_wind(damping, wind);
      for (const double drag : {0.0, 4.0}) {
        sim.system.drag = drag;
        const State exact = exact_run(sim, 4).state;
        const auto error = [&](int substeps) { return distance(run(sim, 4, substeps).state, exact); };
        EXPECT_NEAR(measured_order(error, 60), velocity_verlet_explicit.order_with.force_terms, 0.1)
            << damping << ' ' << wind[0] << ' ' << drag;
      }
    }
}

// On a net that vibrates at all frequencies, where dashpots are weak.
TEST(ExplicitVerlet, IsAsAccurateAsSweepsOverWeakDashpots) {
  for (const double damping : {0.003, 0.01, 0.03, 0.1}) {
    const TestSim start = free_net(damping);
    const State exact = exact_run(start, 3).state;
    const int min_count = min_substeps(start, 0.5);
    for (const int count : {min_count, 2 * min_count, 8 * min_count}) {
      const double once = distance(run(start, 3, count).state, exact), swept = distance(run(start, 3, count, velocity_verlet).state, exact);
      if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("d = %g, %d steps: %.3g m, with sweeps %.3g m\n", damping, count, once, swept);
      EXPECT_LT(once, 1.05 * swept) << damping << ", " << count << " steps";
    }
  }
}

TEST(ExplicitVerlet, IsAsAccurateAsTwoEvaluationsOfTheWind) {
  for (const ForceValues& wind : {breeze, storm}) {
    const TestSim start = net_in_wind(0.0, wind);
    const State exact = exact_run(start, 4).state;
    for (const int count : {30, 60, 240}) {
      const double once = distance(run(start, 4, count).state, exact), twice = distance(run(start, 4, count, velocity_verlet).state, exact);
      if (std::getenv("HOOKE_PRINT") != nullptr)
        std::printf("%g m/s, %d steps: %.3g m, two evaluations %.3g m\n", wind[0], count, once, twice);
      EXPECT_LT(once, 1.2 * twice) << wind[0] << ", " << count << " steps";
    }
  }
}

// What the balance of energy records as supplied by the wind. Its error is of the second order, like that of the motion.
TEST(ExplicitVerlet, RecordsTheWorkOfTheWind) {
  for (const ForceValues& wind : {breeze, storm}) {
    const TestSim start = net_in_wind(0.0, wind);
    const double exact = exact_run(start, 4).work;
    const auto error = [&](int substeps) { return std::abs(run(start, 4, substeps).work - exact); };
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("%g m/s: %.6g J, error %.2g J with 60 substeps\n", wind[0], exact, error(60));
    EXPECT_LT(error(60), 2e-3 * std::abs(exact)) << wind[0];
    EXPECT_NEAR(measured_order(error, 60), 2.0, 0.2) << wind[0];
  }
}

TEST(ExplicitVerlet, ConservesMomentumToRounding) {
  const TestSim sim = free_net(0.1);
  const auto momentum = [&](const State& state) {
    Vec3 sum{0.0};
    for (Index i = 0; i < sim.system.point_count(); ++i) sum += sim.system.points()[i].mass * state.velocity[i];
    return sum;
  };
  const State end = run(sim, 30, min_substeps(sim, 0.9)).state;
  EXPECT_LT(glm::distance(momentum(end), momentum(sim.state)), 1e-14);
}

TEST(ExplicitVerlet, LosesEnergyNearTheLimitOfItsStability) {
  for (const double damping : {0.001, 0.01, 0.03, 0.1, 1.0}) {
    TestSim sim = free_net(damping);
    const int substeps = min_substeps(sim, 0.9);
    // the energy of a mode near the limit oscillates by a part of (h omega)^2 / 4
    const double start = compute_energy(sim.system, sim.state).total();
    double energy = 2.0 * start;
    for (int i = 0; i < 10; ++i) {
      sim.state = run(sim, 20, substeps).state;
      const double now = compute_energy(sim.system, sim.state).total();
      EXPECT_LT(now, energy) << damping << ", after " << 20 * (i + 1) << " frames";
      energy = now;
    }
    EXPECT_LT(energy, 0.9 * start) << damping;
  }
}

TEST(ExplicitVerlet, IsStableUpToTheLimitOfItsSource) {
  for (const double omega : {0.0, 0.5, 1.0, 1.5})
    for (const double part : {0.999, 1.001}) {
      const Spectrum spectrum{.omega = omega, .dashpot_rate = part * (1.0 - 0.25 * omega * omega), .min_dashpot_ratio = 1e30};
      EXPECT_EQ(largest_stable_step(velocity_verlet_explicit, spectrum) > 1.0, part < 1.0) << omega;
    }
}

}  // namespace
}  // namespace hooke
