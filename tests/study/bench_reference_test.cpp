// The benchmark: its problems and their references.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "sim/forces/energy/energy.h"
#include "sim/forces/forces.h"
#include "support/bench_problem.h"
#include "support/sanitizer_slowdown.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// The two initial states have the same positions: the points of each row of the net hang in equilibrium.
TEST(BenchProblems, TheNetsStartWithoutForceAndInMotion) {
  const InitialState net = make_net(16, 1e2, 0.0);
  EXPECT_EQ(net.system.point_count(), 256);
  EXPECT_EQ(net.system.spring_count(), 480);
  const Plan plan = make_plan(net.system);
  Motion motion;
  pack(plan, net.state, motion);
  compute_forces(plan, 0.0, motion.x, motion.v, motion.a);
  divide_by_mass(plan, motion.a);
  for (const double a : motion.a) EXPECT_NEAR(a, 0.0, 1e-9);
  // bottom left: s = 1 m, u = 0
  EXPECT_NEAR(net.state.velocity[15 * 16].z, 0.5, 1e-12);
  EXPECT_NEAR(net.state.position[15 * 16].y, -1.0 - 120.0 * 9.81 / 256.0 / 1e2, 1e-12);
}

TEST(BenchProblems, TheChainHangsInEquilibriumUnderItsHeavyEnd) {
  const InitialState chain = make_chain(200, 1e3);
  EXPECT_DOUBLE_EQ(chain.system.points().back().mass, 1.0);
  for (Index i = 1; i < chain.system.point_count(); ++i) {
    const Vec3 force = chain.system.points()[i].mass * chain.system.gravity;
    double pull = 0.0;
    for (const Spring& spring : chain.system.springs()) {
      const double tension = spring.stiffness * strain(chain.system, chain.state, spring) * spring.rest_length;
      if (chain.system.index_of(spring.second) == i) pull += tension;
      if (chain.system.index_of(spring.first) == i) pull -= tension;
    }
    EXPECT_NEAR(pull + force.y, 0.0, 1e-9);
  }
}

TEST(BenchProblems, AFingerprintDistinguishesScenesThatDifferInOneStiffness) {
  const Problem problem = problem_of(make_net(4, 1e2, 0.0), 1.0);
  Problem other = problem;
  EXPECT_EQ(fingerprint(problem), fingerprint(other));
  other.system.spring(3)->stiffness *= 1.0 + 1e-15;
  EXPECT_NE(fingerprint(problem), fingerprint(other));
}

// All halves of a quarter of a second down to 1/240 s end at the same phase of the plate.
TEST(BenchReference, ResolvesCollidersThatOscillate) {
  TestSim sim;
  sim.add({0.0, 0.1, 0.0});
  sim.system.colliders = {
      {.shape = Plane{}, .restitution = 0.5, .path = {.amplitude = {0.0, 1e-3, 0.0}, .frequency = 960.0, .phase = 1.0}}};
  const Problem problem = problem_of({sim.system, sim.state}, 1.0);
  Benchmark benchmark(problem);
  const ReferenceResult result = compute_reference(benchmark, 0.5 * sanitizer_slowdown, always);
  if (!result.reference) return;
  for (const Refinement* each : {&result.reference->own, &result.reference->other})
    EXPECT_TRUE(is_adaptive(*each->method) || each->setting.steps >= 16 * 240) << each->setting_name;
}

TEST(BenchReference, TwoMethodsAgreeAndASmallPerturbationStaysSmall) {
  Benchmark benchmark(swept_problem());
  const std::optional<Reference> reference = compute_reference(benchmark, 0.5 * sanitizer_slowdown, always).reference;
  ASSERT_TRUE(reference);
  EXPECT_NE(reference->own.method, reference->other.method);
  EXPECT_LT(reference->own.gap, 1e-12);
  EXPECT_LT(reference->other_gap, 1e-11);
  EXPECT_GT(reference->other_gap, 0.0);
  EXPECT_GT(reference->amplification, 0.05);
  EXPECT_LT(reference->amplification, 2.0);
  EXPECT_EQ(reference->measure, Measure::Trajectory);
}

// Positions to nine digits from a different program, in long double.
TEST(BenchReference, DrumRopeAndClothPassThroughTheKnownPositions) {
  struct Place {
    const char* problem;
    int snapshot;
    Index point;
    Vec3 x;
  };
  const Place places[] = {
      {"drum_32", 0, 528, {0.516139452, -0.516139452, -0.014719998}}, {"drum_32", 1, 528, {0.516211063, -0.516211063, -0.049190882}},
      {"drum_32", 3, 528, {0.516165695, -0.516165695, -0.000460663}}, {"rope_64", 1, 63, {0.881716351, 0.0, -0.306562500}},
      {"rope_64", 3, 63, {-0.220203585, 0.0, -0.878862949}},          {"cloth_32", 1, 528, {0.516137244, -0.403723769, -0.305391510}},
  };
  std::map<std::string, std::vector<State>> snapshots;
  for (const char* id : {"drum_32", "rope_64", "cloth_32"}) {
    const Problem problem = find_problem(id)->make();
    Benchmark benchmark(problem);
    const Integrator& best = *most_accurate_methods(problem).front();
    snapshots[problem.id] = benchmark.run(best, {.tolerance = 1e-10}, always).snapshots;
  }
  for (const Place& place : places) {
    const Vec3& x = snapshots.at(place.problem).at(place.snapshot).position[place.point];
    EXPECT_LT(glm::distance(x, place.x), 2e-9) << place.problem << ", snapshot " << place.snapshot;
  }
}

// A mass on a spring that falls onto a floor and bounces.
Problem spring_on_a_floor(double restitution) {
  InitialState start;
  start.system.colliders.push_back({.shape = Plane{}, .restitution = restitution, .friction = 0.0});
  const PointId first = start.system.new_point_id(), second = start.system.new_point_id();
  start.system.set_points({{.id = first, .mass = 1.0, .radius = 0.0}, {.id = second, .mass = 2.0, .radius = 0.0}});
  start.system.set_springs(
      std::vector<Spring>{{.id = start.system.new_spring_id(), .first = first, .second = second, .stiffness = 400.0, .rest_length = 0.5}});
  start.state.position = {{0.0, 0.6, 0.0}, {0.1, 1.1, 0.0}};
  start.state.velocity = {Vec3(0.0), Vec3(0.0)};
  return problem_of(std::move(start), 1.0);
}

TEST(BenchReference, TwoMethodsAgreeThroughImpacts) {
  for (const double restitution : {0.0, 0.5}) {
    const Problem problem = spring_on_a_floor(restitution);
    Benchmark benchmark(problem);
    const ReferenceResult result = compute_reference(benchmark, 0.5 * sanitizer_slowdown, always);
    ASSERT_TRUE(result.reference) << restitution << ": " << result.reason;
    EXPECT_EQ(result.reference->measure, Measure::Trajectory);
    EXPECT_LT(result.reference->other_gap, 1e-4) << restitution;

    // a third method agrees too
    const State& exact = result.reference->snapshots().back();
    const RunResult verlet = benchmark.run(default_integrator(), {.steps = 16384}, always);
    EXPECT_LT(rms_distance(problem.system, verlet.snapshots.back(), exact), 1e-4 * problem.size) << restitution;
  }
}

// Four masses on stiff springs, started upright: chaotic, so that after half a minute no two solutions agree.
Problem upright_pendulum() {
  InitialState start;
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i) {
    points.push_back({.id = start.system.new_point_id(), .mass = 1.0, .radius = 0.0});
    start.state.position.push_back({0.01 * i, 0.5 * i, 0.0});
  }
  points.front().nailed = true;
  std::vector<Spring> springs;
  for (int i = 0; i < 4; ++i) {
    const SpringId id = start.system.new_spring_id();
    springs.push_back({.id = id, .first = points[i].id, .second = points[i + 1].id, .stiffness = 1e3, .rest_length = 0.5});
  }
  start.system.set_points(std::move(points));
  start.system.set_springs(std::move(springs));
  start.state.velocity.assign(5, Vec3(0.0));
  return problem_of(std::move(start), 30.0);
}

TEST(BenchReference, MethodsThatDisagreeGiveNoReferenceAndAReason) {
  const Problem problem = upright_pendulum();
  Benchmark benchmark(problem);
  const ReferenceResult result = compute_reference(benchmark, 0.5 * sanitizer_slowdown, always);
  EXPECT_FALSE(result.reference);
  EXPECT_EQ(result.failure, ReferenceResult::Failure::Disagreement);
  EXPECT_NE(result.reason.find(" differ by "), std::string::npos) << result.reason;
}

TEST(BenchReference, AMethodThatTakesTooLongIsReplacedByTheNext) {
  // a net that falls onto a ball: with friction the tolerance of dop853 requires any number of steps
  Problem problem = problem_of(make_curtain(8, 1e4, 0.0), 1.0);
  problem.system.colliders.push_back({.shape = Sphere{{0.5, -0.5, 0.0}, 0.3}, .restitution = 0.0, .friction = 0.5});
  for (Index i = 0; i < problem.system.point_count(); ++i) problem.system.point(i).nailed = false;
  ASSERT_EQ(most_accurate_methods(problem).front()->id, "dop853");
  Benchmark benchmark(problem);
  const ReferenceResult result = compute_reference(benchmark, 0.5 * sanitizer_slowdown, always);
  EXPECT_NE(result.failure, ReferenceResult::Failure::Interrupted);
  EXPECT_TRUE(result.reference.has_value() != !result.reason.empty());
  if (result.reference) {
    EXPECT_NE(result.reference->own.method->id, "dop853");
  }
  EXPECT_EQ(result.reason.find("dop853"), std::string::npos) << result.reason;
}

TEST(BenchReference, AnUnpredictableSceneIsComparedByObservables) {
  // two solutions that differ by a rotation about the vertical through the center of mass: the same observables
  const Problem problem = problem_of(make_curtain(4, 1e2, 0.0), 1.0);
  State turned = problem.start;
  for (Vec3& x : turned.position) x.x = 1.0 - x.x;
  const Score trajectory = judge(problem, Measure::Trajectory, {problem.start}, {turned});
  const Score observables = judge(problem, Measure::Observables, {problem.start}, {turned});
  EXPECT_GT(trajectory.relative_error, 0.5);
  EXPECT_LT(observables.relative_error, 1e-12);

  for (Vec3& x : turned.position) x.z += 0.25;
  EXPECT_NEAR(judge(problem, Measure::Observables, {problem.start}, {turned}).error, 0.25, 1e-12);
}

}  // namespace
}  // namespace hooke
