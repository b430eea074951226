// Other engines on the equations of Hooke: what they agree on, and how fast they converge to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "peers/peer.h"
#include "peers/peer_problems.h"
#include "study/analytic_scenes.h"
#include "study/benchmark.h"
#include "support/bench_problem.h"
#include "support/crossings.h"

namespace hooke {
namespace {

// 64 points that swing in tension, in full motion at the start.
const Problem& swinging_net() {
  static const Problem problem = net_in_motion(0.5);
  return problem;
}

const std::vector<State>& converged() {
  static const std::vector<State> snapshots = [] {
    Benchmark benchmark(swinging_net());
    return benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-13}, always).snapshots;
  }();
  return snapshots;
}

// RMS distance of the points at the end [m].
double error_of(Peer& peer, int steps, int iterations = 1) {
  const PeerRun run = peer.run({.snapshots = snapshot_count, .steps = steps, .iterations = iterations});
  EXPECT_TRUE(run.is_finished);
  return run.is_finished ? rms_distance(swinging_net().system, run.snapshots.back(), converged().back()) : NAN;
}

double order_of(Peer& peer, int steps) { return std::log2(error_of(peer, steps) / error_of(peer, 2 * steps)); }

TEST(Peers, ConvergeToHookesMotionWithTheOrderOfTheirMethods) {
  struct Claim {
    const PeerKind& kind;
    double order;
    int steps;
  };
  for (const auto& [kind, order, steps] : {Claim{lammps_peer, 2.0, 100},
                                           {mujoco_euler_peer, 2.0, 100},
                                           {mujoco_runge_kutta_peer, 4.0, 50},
                                           {bullet_deformable_peer, 2.0, 100},
                                           {bullet_implicit_peer, 1.0, 400}}) {
    EXPECT_EQ(kind.obstacle(swinging_net()), "");
    const std::unique_ptr<Peer> peer = kind.load(swinging_net());
    EXPECT_NEAR(order_of(*peer, steps), order, 0.2) << kind.id;
    EXPECT_LT(error_of(*peer, 2 * steps), 1e-4) << kind.id;
  }
}

// The same method on the same equations: only the rounding differs.
TEST(Peers, WithHookesMethodHaveItsErrors) {
  const std::unique_ptr<Peer> ours = load_method(swinging_net(), default_integrator());
  for (const PeerKind* kind : {&lammps_peer, &mujoco_euler_peer, &bullet_deformable_peer}) {
    const std::unique_ptr<Peer> theirs = kind->load(swinging_net());
    const PeerSetting setting{.snapshots = snapshot_count, .steps = 250};
    const PeerRun a = ours->run(setting), b = theirs->run(setting);
    ASSERT_TRUE(a.is_finished && b.is_finished);
    for (int i = 0; i < snapshot_count; ++i)
      EXPECT_LE(rms_distance(swinging_net().system, a.snapshots[i], b.snapshots[i]), 1e-12) << kind->id;
  }
}

TEST(Peers, WithDashpotsConvergeToHookesMotion) {
  const Problem problem = with_dashpots(swinging_net(), 2.0);
  Benchmark benchmark(problem);
  const std::vector<State> exact = benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-13}, always).snapshots;
  EXPECT_GT(rms_distance(problem.system, exact.back(), converged().back()), 1e-4);
  for (const PeerKind* kind : {&mujoco_euler_peer, &mujoco_runge_kutta_peer, &bullet_deformable_peer}) {
    const std::unique_ptr<Peer> peer = kind->load(problem);
    double error[2];
    for (int i = 0; i < 2; ++i) {
      const PeerRun run = peer->run({.snapshots = snapshot_count, .steps = 200 << i});
      ASSERT_TRUE(run.is_finished) << kind->id;
      error[i] = rms_distance(problem.system, run.snapshots.back(), exact.back());
    }
    EXPECT_LT(error[1], 1e-5) << kind->id;
    EXPECT_GT(error[0] / error[1], 1.8) << kind->id;
  }
  EXPECT_EQ(lammps_peer.obstacle(problem), "dashpots");
  EXPECT_EQ(bullet_soft_body_peer.obstacle(problem), "dashpots");
}

TEST(Peers, AreNotMeasuredOnWhatTheyCannotRepresent) {
  EXPECT_NE(mujoco_euler_peer.obstacle(peer_cloth(64, 1.0)), "");
  EXPECT_EQ(mujoco_euler_peer.obstacle(peer_cloth(32, 1.0)), "");
  EXPECT_NE(lammps_peer.obstacle(cloth_in_folds(9, 1.0)), "");
  EXPECT_EQ(bullet_deformable_peer.obstacle(cloth_in_folds(9, 1.0)), "");
}

// The force of a link of Bullet's soft body is k (l^2 - l0^2) l / (l^2 + l0^2), which is that of a spring at small strains only: a mass
// that hangs on one stays at the length where this supports it.
TEST(Peers, TheSoftBodyOfBulletConvergesToADifferentLawOfSprings) {
  constexpr double k = 100.0, mass = 1.0, g = 9.81, l0 = 0.5;
  double law = l0;
  for (int i = 0; i < 200; ++i) law = l0 + mass * g / k * (law * law + l0 * l0) / (law * (law + l0));
  const double spring = l0 + mass * g / k;
  EXPECT_GT(spring - law, 5e-3);

  double drift[2];
  for (int i = 0; i < 2; ++i) {
    TestSim sim;
    const PointId nail = sim.nail(Vec3(0.0));
    sim.join(nail, sim.add({0.0, -law, 0.0}, mass), k, l0);
    Problem problem{.id = "mass", .system = sim.system, .start = sim.state, .seconds = 0.5};
    const PeerRun run = bullet_soft_body_peer.load(problem)->run({.snapshots = snapshot_count, .steps = 500 << i});
    ASSERT_TRUE(run.is_finished);
    drift[i] = 0.0;
    for (const State& state : run.snapshots) drift[i] = std::max(drift[i], std::abs(state.position[1].y + law));
  }
  EXPECT_LT(drift[0], 1e-6);
  EXPECT_LT(drift[1], 0.6 * drift[0]);
}

// A run that diverges is not one that finished.
TEST(Peers, ReportDivergence) {
  const Problem problem = net_in_motion(20.0);
  for (const PeerKind* kind : {&lammps_peer, &mujoco_euler_peer})
    EXPECT_FALSE(kind->load(problem)->run({.snapshots = snapshot_count, .steps = 200}).is_finished) << kind->id;
}

}  // namespace
}  // namespace hooke
