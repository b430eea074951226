// The benchmark: its problems, references, sweeps and output files.
#include "study/work_precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <sstream>

#include "sim/divergence.h"
#include "sim/energy.h"
#include "sim/forces/forces.h"
#include "study/analytic_scenes.h"
#include "study/label_placement.h"
#include "study/work_precision_chart.h"
#include "study/work_precision_file.h"

namespace hooke {
namespace {

bool always() { return true; }

Problem problem_of(InitialState start, double seconds) {
  initialize_ledger(start.system, start.state);
  return {.id = "problem", .title = "a problem", .system = std::move(start.system), .start = std::move(start.state), .seconds = seconds};
}

// Net W2 with fewer points, starting in full motion: from its own start, in equilibrium, a first-order method whose velocities are half a
// step late is as accurate as one of second order.
Problem net_in_motion(double seconds) {
  Problem problem = problem_of(make_net(6, 1e2, 0.0), 0.4);
  Benchmark benchmark(problem);
  problem.start = benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-13}, always).snapshots.back();
  problem.start.time = 0.0;
  problem.start.memory = {};
  initialize_ledger(problem.system, problem.start);
  problem.seconds = seconds;
  return problem;
}

Effort small_effort() { return {.repeats = 1, .run_seconds = 0.1, .reference_seconds = 2.0, .finest_error = 1e-9}; }

// The record of every method on a small net, computed once.
const Problem& swept_problem() {
  static const Problem problem = net_in_motion(2.0);
  return problem;
}

const ProblemRecord& swept_record() {
  static const ProblemRecord record = [] {
    ProblemRecord made = make_record(swept_problem());
    const Effort effort = small_effort();
    PrecisionSweep sweep(swept_problem(), effort, made);
    for (const Integrator& method : integrators()) sweep.run(method);
    return made;
  }();
  return record;
}

Results results_of(ProblemRecord record) { return {{"1.0", "abc", "a machine", "full"}, "2024-01-01T00:00:00Z", {std::move(record)}}; }

Row row(const char* method, double error, double cost) {
  return {.method = method,
          .setting = "1 steps/s",
          .step = 1.0,
          .error = error,
          .relative_error = error,
          .cpu_ms_per_s = cost,
          .status = status::ok};
}

// ---- the problems ----

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
  other.system.spring(3).stiffness *= 1.0 + 1e-15;
  EXPECT_NE(fingerprint(problem), fingerprint(other));
}

// ---- the references ----

TEST(BenchReference, TwoMethodsAgreeAndASmallPerturbationStaysSmall) {
  Benchmark benchmark(swept_problem());
  const std::optional<Reference> reference = compute_reference(benchmark, 0.5, always).reference;
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
      {{.id = start.system.new_spring_id(), .first = first, .second = second, .stiffness = 400.0, .rest_length = 0.5}});
  start.state.position = {{0.0, 0.6, 0.0}, {0.1, 1.1, 0.0}};
  start.state.velocity = {Vec3(0.0), Vec3(0.0)};
  return problem_of(std::move(start), 1.0);
}

TEST(BenchReference, TwoMethodsAgreeThroughImpacts) {
  for (const double restitution : {0.0, 0.5}) {
    const Problem problem = spring_on_a_floor(restitution);
    Benchmark benchmark(problem);
    const ReferenceResult result = compute_reference(benchmark, 0.5, always);
    ASSERT_TRUE(result.reference) << restitution << ": " << result.reason;
    EXPECT_EQ(result.reference->measure, Measure::Trajectory);
    EXPECT_LT(result.reference->other_gap, 1e-4) << restitution;

    // a third method agrees too
    const State& exact = result.reference->snapshots().back();
    const RunResult verlet = benchmark.run(default_integrator(), {.steps = 16384}, always);
    EXPECT_LT(rms_distance(verlet.snapshots.back(), exact), 1e-4 * problem.size) << restitution;
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
  const ReferenceResult result = compute_reference(benchmark, 0.5, always);
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
  const ReferenceResult result = compute_reference(benchmark, 0.5, always);
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

// ---- the sweeps ----

TEST(WorkPrecision, ErrorsFallWithTheDeclaredOrder) {
  const Problem problem = net_in_motion(0.25);
  Benchmark benchmark(problem);
  const std::vector<State> exact = benchmark.run(*find_integrator("dop853"), {.tolerance = 1e-14}, always).snapshots;
  const auto error = [&](const Integrator& method, const Setting& setting) {
    return judge(problem, Measure::Trajectory, exact, benchmark.run(method, setting, always).snapshots).error;
  };
  for (const Integrator& method : integrators()) {
    if (is_adaptive(method)) {
      EXPECT_LT(error(method, {.tolerance = 1e-8}), 1e-6) << method.id;
      EXPECT_LT(error(method, {.tolerance = 1e-11}), 0.01 * error(method, {.tolerance = 1e-8})) << method.id;
      continue;
    }
    const int steps = method.order == 1 ? 512 : method.order == 2 ? 64 : 24;
    const double coarse = error(method, {.steps = steps}), fine = error(method, {.steps = 2 * steps});
    EXPECT_NEAR(std::log2(coarse / fine), method.order, 0.3) << method.id << ": " << coarse << ", " << fine;
  }
}

TEST(WorkPrecision, EveryMethodIsSweptStartingFromItsCoarsestStep) {
  for (const Integrator& method : integrators()) {
    std::vector<double> errors;
    for (const Row& each : swept_record().rows)
      if (each.method == method.id && each.relative_error) errors.push_back(*each.relative_error);
    ASSERT_GE(errors.size(), 3u) << method.id;
    EXPECT_LT(errors.back(), 0.1 * errors.front()) << method.id;
  }
}

TEST(WorkPrecision, ADivergingSettingIsReportedAndNotDropped) {
  const Row* diverged = nullptr;
  for (const Row& each : swept_record().rows)
    if (each.method == "velocity_verlet" && each.status == status::diverged) diverged = &each;
  ASSERT_NE(diverged, nullptr);
  EXPECT_FALSE(diverged->error);
  EXPECT_FALSE(diverged->cpu_ms_per_s);
  EXPECT_GT(diverged->work.force_evaluations, 0);

  EXPECT_NE(format_csv(results_of(swept_record())).find("," + diverged->setting + "," + std::to_string(*diverged->step).substr(0, 4)),
            std::string::npos);
}

// h omega < 2 for the actual highest frequency of the net, which no bound gives: the sweep finds it within a fifth.
TEST(WorkPrecision, TheCoarsestStableStepIsFound) {
  double coarsest = 0.0, finest_failure = INFINITY;
  for (const Row& each : swept_record().rows) {
    if (each.method != "velocity_verlet") continue;
    if (each.status == status::ok) coarsest = std::max(coarsest, *each.step);
    if (each.status == status::diverged || each.status == status::lost) finest_failure = std::min(finest_failure, *each.step);
  }
  EXPECT_LT(coarsest, finest_failure);
  EXPECT_LT(finest_failure, 1.21 * coarsest);
}

TEST(WorkPrecision, ExistingRowsAreNotRunAgain) {
  // through the file, as an interrupted benchmark resumes
  const Results read = parse_results(format_results(results_of(swept_record())), "bench.json");
  ProblemRecord record = read.problems.at(0);
  EXPECT_EQ(record.rows.size(), swept_record().rows.size());
  // the coarsest that Verlet survived: no later row depends on timing
  const auto lost =
      std::find_if(record.rows.begin(), record.rows.end(), [](const Row& each) { return each.method == "velocity_verlet" && each.error; });
  ASSERT_NE(lost, record.rows.end());
  const std::string lost_name = lost->method + ", " + lost->setting;
  record.rows.erase(lost);

  const Effort effort = small_effort();
  PrecisionSweep sweep(swept_problem(), effort, record);
  std::vector<std::string> measured;
  sweep.row_done = [&] { measured.push_back(record.rows.back().method + ", " + record.rows.back().setting); };
  for (const Integrator& method : integrators()) EXPECT_TRUE(sweep.run(method));
  EXPECT_EQ(measured, std::vector{lost_name});
}

TEST(WorkPrecision, AStoppedSweepKeepsItsResults) {
  ProblemRecord record = make_record(swept_problem());
  const Effort effort = small_effort();
  PrecisionSweep sweep(swept_problem(), effort, record);
  sweep.should_continue = [&] { return record.rows.size() < 3; };
  EXPECT_FALSE(sweep.run(*find_integrator("velocity_verlet")));
  EXPECT_EQ(record.rows.size(), 3u);
  EXPECT_EQ(sweep.reference_failure(), ReferenceResult::Failure::None);
}

TEST(WorkPrecision, TheParetoFrontContainsRowsThatNothingBeatsInBothRespects) {
  ProblemRecord record;
  record.reference = ReferenceRecord{.own_gap = 1e-12};
  record.rows = {row("a", 1e-2, 1.0), row("b", 1e-1, 2.0), row("c", 1e-3, 5.0), row("d", 1e-3, 4.0), row("e", 1e-13, 9.0)};
  std::string ids;
  for (const Row* each : pareto_front(record)) ids += each->method;
  EXPECT_EQ(ids, "ade");
  EXPECT_EQ(cheapest(record, 1e-1)->method, "a");
  EXPECT_EQ(cheapest(record, 1e-3)->method, "d");
  EXPECT_EQ(cheapest(record, 1e-11)->method, "e");
  EXPECT_EQ(cheapest(record, 1e-13), nullptr) << "below the uncertainty of the reference";
}

// ---- what is written ----

TEST(BenchFiles, TheCsvHasItsFixedColumns) {
  ProblemRecord record{.id = "a, b"};
  Row each = row("velocity_verlet", 0.125, 3.5);
  each.step = 0.5;
  each.energy_drift = -0.25;
  each.work = {.force_evaluations = 7, .factorizations = 2, .solves = 3, .sweeps = 4};
  record.rows = {each, {.method = "xpbd", .setting = "2 steps/s", .step = 0.5, .status = status::diverged}};
  EXPECT_EQ(format_csv(results_of(record)),
            "scene,method,setting,step_s,error_m,relative_error,cpu_ms_per_s,force_evaluations,factorizations,energy_drift,status\n"
            "\"a, b\",velocity_verlet,1 steps/s,0.5,0.125,0.125,3.5,7,2,-0.25,ok\n"
            "\"a, b\",xpbd,2 steps/s,0.5,,,,0,0,,diverged\n");
}

TEST(BenchFiles, AreReadBackAsWritten) {
  const Results written = results_of(swept_record());
  const Results read = parse_results(format_results(written), "bench.json");
  EXPECT_EQ(read.conditions, written.conditions);
  EXPECT_EQ(read.date, written.date);
  ASSERT_EQ(read.problems.size(), 1u);
  EXPECT_EQ(read.problems[0].rows, written.problems[0].rows);
  EXPECT_EQ(read.problems[0].fingerprint, written.problems[0].fingerprint);
  EXPECT_EQ(read.problems[0].reference->own_gap, written.problems[0].reference->own_gap);
  EXPECT_EQ(format_results(read), format_results(written));
}

TEST(BenchFiles, OtherJsonIsRefusedInOneLine) {
  for (const char* text : {"", "[", "[]", "{}", "{\"hooke_bench\":1}", "{\"hooke\": 1}", "{\"hooke_bench\":1,\"version\":3}"}) {
    try {
      parse_results(text, "bench.json");
      ADD_FAILURE() << text;
    } catch (const InputError& refused) {
      EXPECT_EQ(std::string(refused.what()).rfind("bench.json: ", 0), 0u);
      EXPECT_EQ(std::string(refused.what()).find('\n'), std::string::npos);
    }
  }
}

TEST(BenchChart, TheScriptDrawsAndNamesEveryMethod) {
  const std::string script = chart_script(results_of(swept_record()), ChartFormat::Svg, "bench.svg");
  for (const Integrator& method : integrators()) {
    EXPECT_NE(script.find("$panel0_" + std::string(method.id) + " with linespoints"), std::string::npos) << method.id;
    EXPECT_NE(script.find("set label '" + std::string(method.id) + "' at"), std::string::npos) << method.id;
  }
  EXPECT_NE(script.find("$panel0_front with lines"), std::string::npos);
  EXPECT_NE(script.find("set output 'bench.svg'"), std::string::npos);
}

// The name of a scene is untrusted text.
TEST(BenchChart, ANameCannotEndItsQuotes) {
  ProblemRecord record = swept_record();
  record.title = "it's'\nsystem(\"touch /tmp/x\")";
  const std::string script = chart_script(results_of(record), ChartFormat::Png, "bench.png");
  EXPECT_NE(script.find("it''s'' system("), std::string::npos);
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) EXPECT_EQ(std::count(line.begin(), line.end(), '\'') % 2, 0) << line;
}

TEST(BenchChart, LabelsDoNotOverlap) {
  const std::vector<ChartLabel> labels(6, {{100.0, 100.0}, 90.0, 15.0});
  const std::vector<PlacedLabel> places = place_labels(labels, {}, {0.0, 0.0, 400.0, 400.0});
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(places[i].justify != places[j].justify || std::abs(places[i].at.y - places[j].at.y) >= 14.9) << i << ", " << j;
}

}  // namespace
}  // namespace hooke
