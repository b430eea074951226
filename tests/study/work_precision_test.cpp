// The benchmark: its sweeps and output files.
#include "study/work_precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "study/work_precision_chart.h"
#include "study/work_precision_file.h"
#include "support/bench_problem.h"

namespace hooke {
namespace {

Results results_of(ProblemRecord record) { return {{"1.0", "abc", "a machine", "full"}, "2024-01-01T00:00:00Z", {}, {std::move(record)}}; }

Row row(const char* method, double error, double cost) {
  return {.method = method,
          .setting = "1 steps/s",
          .step = 1.0,
          .error = error,
          .relative_error = error,
          .cpu_ms_per_s = cost,
          .status = status::ok};
}

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
  Results written = results_of(swept_record());
  written.parts = {{.of = "a by b", .number = 2, .count = 4, .is_complete = true}, {.of = "a by c"}};
  const Results read = parse_results(format_results(written), "bench.json");
  EXPECT_EQ(read.conditions, written.conditions);
  EXPECT_EQ(read.date, written.date);
  ASSERT_EQ(read.problems.size(), 1u);
  EXPECT_EQ(read.problems[0].rows, written.problems[0].rows);
  EXPECT_EQ(read.problems[0].fingerprint, written.problems[0].fingerprint);
  EXPECT_EQ(read.problems[0].reference->own_gap, written.problems[0].reference->own_gap);
  EXPECT_EQ(format_results(read), format_results(written));
}

// What merging results with these parts, one per file, says is missing.
std::string missing_of(const std::vector<PartRecord>& parts) {
  std::vector<std::pair<std::string, Results>> files;
  for (const PartRecord& part : parts)
    files.emplace_back("bench.json", Results{.conditions = {}, .date = {}, .parts = {part}, .problems = {}});
  return merge_results(files).missing;
}

TEST(BenchFiles, MergingThemCountsThePartsThatAreMissing) {
  const auto part = [](std::size_t number, std::size_t count, bool is_complete = true, const char* of = "a by b") {
    return PartRecord{of, number, count, is_complete};
  };
  EXPECT_EQ(missing_of({part(1, 1)}), "");
  EXPECT_EQ(missing_of({part(2, 2), part(1, 2)}), "");
  EXPECT_EQ(missing_of({part(1, 1, false)}), "1 of 1 shards are missing or not finished, the first is 1/1");
  EXPECT_EQ(missing_of({part(3, 4), part(1, 4)}), "2 of 4 shards are missing or not finished, the first is 2/4");
  EXPECT_EQ(missing_of({part(1, 2, false), part(1, 2), part(2, 2)}), "") << "it was resumed in another folder";
  EXPECT_EQ(missing_of({part(1, 4), part(1, 1)}), "") << "all of it was measured, too";
  EXPECT_TRUE(missing_of({part(1, 1), part(1, 2, true, "a by c")}).ends_with("the first is 2/2")) << "of other methods";
  EXPECT_EQ(merge_results({{"old.json", {}}}).missing, "old.json does not say which shard it is");
}

TEST(BenchFiles, OtherJsonIsRefusedInOneLine) {
  for (const char* text : {"", "[", "[]", "{}", "{\"hooke_bench\":1}", "{\"hooke\": 1}", "{\"hooke_bench\":1,\"version\":3}",
                           R"({"hooke_bench": 1, "version": "", "build": "", "machine": "", "effort": "", "date": "", "scenes": [],
                               "parts": [{"of": "", "number": 3, "count": 2, "complete": true}]})",
                           R"({"hooke_bench": 1, "version": "", "build": "", "machine": "", "effort": "", "date": "", "scenes": [],
                               "parts": [{"of": "", "number": 3, "count": 2000000, "complete": true}]})"}) {
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
  const std::string script = work_precision_chart(results_of(swept_record())).script;
  for (const Integrator& method : integrators()) {
    EXPECT_NE(script.find("$panel0_" + std::string(method.id) + " with linespoints"), std::string::npos) << method.id;
    EXPECT_NE(script.find("title '" + std::string(method.id) + "'"), std::string::npos) << method.id;
  }
  EXPECT_NE(script.find("$panel0_front with lines"), std::string::npos);
}

TEST(BenchChart, NamesTheTimeOfADevice) {
  ProblemRecord record = swept_record();
  EXPECT_NE(work_precision_chart(results_of(record)).script.find("set xlabel 'CPU time, ms"), std::string::npos);
  record.rows.front().method = "velocity_verlet on GPU";
  EXPECT_NE(work_precision_chart(results_of(record)).script.find("set xlabel 'CPU time (on GPU: real time), ms"), std::string::npos);
}

TEST(BenchChart, DrawsOtherEnginesBesideTheMethods) {
  ProblemRecord record = swept_record();
  Row row = record.rows.front();
  row.relative_error = 1e-3;
  row.cpu_ms_per_s = 5.0;
  for (const char* engine : {"lammps", "another", "lammps"}) {
    row.method = engine;
    record.rows.push_back(row);
  }
  const std::string script = work_precision_chart(results_of(record)).script;
  for (const char* text : {"title 'lammps'", "title 'another'"}) {
    const auto at = script.find(text);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_EQ(script.find(text, at + 1), std::string::npos) << text;
  }
  const std::string first = "$panel0_engine" + std::to_string(integrators().size());
  EXPECT_NE(script.find(first + " << EOD\n5 0.001\n5 0.001\nEOD\n"), std::string::npos);
  EXPECT_NE(script.find(first + " with linespoints"), std::string::npos);
}

// The name of a scene is untrusted text, and so is that of an engine.
TEST(BenchChart, ANameCannotEndItsQuotes) {
  ProblemRecord record = swept_record();
  record.title = record.rows.front().method = "it's'\nsystem(\"touch /tmp/x\")";
  record.rows.front().relative_error = 1e-3;
  record.rows.front().cpu_ms_per_s = 5.0;
  const std::string script = work_precision_chart(results_of(record)).script;
  EXPECT_NE(script.find("it''s'' system("), std::string::npos);
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(std::count(line.begin(), line.end(), '\'') % 2, 0) << line;
    EXPECT_FALSE(line.starts_with("system")) << line;
  }
}

}  // namespace
}  // namespace hooke
