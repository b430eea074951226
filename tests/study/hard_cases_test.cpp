// The hard cases as a test method: planted failures are detected. The results of the methods themselves are checked by `hooke check
// --hard`.

#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <glm/geometric.hpp>
#include <set>
#include <sstream>
#include <utility>

#include "sim/control/automatic.h"
#include "sim/methods/rows.h"
#include "study/analytic_scenes.h"
#include "study/hard_cases/case_report.h"
#include "study/hard_cases/monitored_run.h"
#include "study/hard_cases/rows.h"

namespace hooke {
namespace {

const Integrator& method(const char* id) { return *find_integrator(id); }

TEST(Verdict, IsUnexpectedWhenItDiffersFromTheExpectation) {
  using enum Outcome;
  using enum Expectation;
  struct Row {
    Outcome outcome;
    Expectation expected;
    bool broken;
  };
  for (const Row& row : {Row{Held, Hold, false},
                         {Held, Report, true},
                         {Held, HoldOrReport, false},
                         {FailedOpenly, Hold, true},
                         {FailedOpenly, Report, false},
                         {FailedOpenly, HoldOrReport, false},
                         {FailedSilently, Hold, true},
                         {FailedSilently, Report, true},
                         {FailedSilently, HoldOrReport, true},
                         {OutOfScope, Hold, false}})
    EXPECT_EQ(is_broken({.outcome = row.outcome, .expected = row.expected}), row.broken)
        << describe(row.outcome) << ", expected to " << describe(row.expected);
}

TEST(Verdict, OfSeveralPartsIsTheWorstWithTheFiguresOfAll) {
  const std::array parts{Verdict{.measured = "a"}, Verdict{.outcome = Outcome::FailedOpenly, .measured = "b", .reason = "why"},
                         Verdict{.outcome = Outcome::OutOfScope}};
  const Verdict worst = worst_of(parts);
  EXPECT_EQ(worst.outcome, Outcome::FailedOpenly);
  EXPECT_EQ(worst.measured, "a; b");
  EXPECT_EQ(worst.reason, "why");
  EXPECT_TRUE(is_broken(worst));
}

// a mass on a spring, released 0.1 m from equilibrium
TestNetwork oscillator(double omega) {
  TestNetwork network;
  network.system.gravity = Vec3(0.0);
  network.join(network.nail(Vec3(0.0)), network.add({1.1, 0.0, 0.0}), omega * omega, 1.0);
  return network;
}

TEST(Verdict, OnAMissedCriterionDependsOnWhetherTheRunReportsIt) {
  // accurate, so no warning
  MonitoredRun accurate(oscillator(2.0), {.substeps = 20}, {.position = 1e-3});
  accurate.run(1.0);
  EXPECT_EQ(judge(accurate, true, "").outcome, Outcome::Held);
  EXPECT_EQ(judge(accurate, false, "").outcome, Outcome::FailedSilently);

  // it loses energy without dissipation
  MonitoredRun damped(oscillator(2.0), {.integrator = &method("implicit_euler"), .substeps = 1});
  damped.run(1.0);
  const Verdict verdict = judge(damped, false, "");
  EXPECT_EQ(verdict.outcome, Outcome::FailedOpenly);
  EXPECT_NE(verdict.reason.find("energy balance"), std::string::npos) << verdict.reason;

  // a run that diverged is never a success, whatever its figures
  MonitoredRun wild(oscillator(1e4), {.substeps = 1});
  EXPECT_FALSE(wild.run(1.0));
  const Verdict stopped = judge(wild, true, "fine");
  EXPECT_EQ(stopped.outcome, Outcome::FailedOpenly);
  EXPECT_EQ(stopped.expected, Expectation::HoldOrReport);
  EXPECT_NE(stopped.reason.find("diverged at"), std::string::npos) << stopped.reason;
  EXPECT_NE(stopped.reason.find("spring 0"), std::string::npos) << stopped.reason;
}

TEST(RunMonitor, EstimatesTheErrorOfARunWithinAFactorOfFour) {
  const InitialState net = make_net(8, 1e2, 0.0);
  const auto run = [&](const char* id, int substeps) {
    MonitoredRun watched({net.system, net.state}, {.integrator = &method(id), .substeps = substeps}, {.position = 1.0});
    watched.run(1.0);
    return watched;
  };
  const MonitoredRun exact = run("blanes_moan4", 50);
  for (const char* id : {"velocity_verlet", "tr_bdf2", "baraff_witkin"}) {
    const MonitoredRun rough = run(id, 4);
    double sum = 0.0;
    for (std::size_t i = 0; i < exact.state().position.size(); ++i) {
      const Vec3 apart = rough.state().position[i] - exact.state().position[i];
      sum += glm::dot(apart, apart);
    }
    const double error = std::sqrt(sum / static_cast<double>(exact.state().position.size()));
    EXPECT_GT(rough.monitor().estimated_error(), 0.25 * error) << id;
    EXPECT_LT(rough.monitor().estimated_error(), 4.0 * error) << id;
  }
}

TEST(RunMonitor, DistinguishesAGainOfEnergyFromALoss) {
  const auto doubts_of = [](const char* id, double drag) {
    TestNetwork network = oscillator(2.0);
    network.system.drag = drag;
    MonitoredRun run(network, {.integrator = &method(id), .substeps = 1});
    run.run(1.0);
    const std::vector<std::string> warnings = run.monitor().warnings({});
    return warnings.empty() ? "" : warnings.front();
  };
  EXPECT_NE(doubts_of("explicit_euler", 0.0).find("(gain)"), std::string::npos);
  EXPECT_NE(doubts_of("implicit_euler", 0.0).find("(loss)"), std::string::npos);
  EXPECT_EQ(doubts_of("velocity_verlet", 0.0), "");
  // drag dissipates it
  EXPECT_EQ(doubts_of("velocity_verlet", 5.0), "");
}

// Planted cases: one holds, one fails silently, one throws.
Verdict judge_held(const Integrator&) { return {.measured = "fine"}; }
Verdict judge_silent(const Integrator& row) {
  if (row.id != "xpbd") return {};
  std::string long_word(300, 'x');
  long_word += " and more words";
  return {.outcome = Outcome::FailedSilently, .measured = long_word};
}
Verdict judge_thrown(const Integrator&) { throw std::runtime_error("a planted error"); }
Verdict judge_endless(const Integrator&) {
  MonitoredRun run(oscillator(2.0), {.substeps = 1});
  while (run.frame()) {
  }
  return {};
}

constexpr HardCase held{.number = 1, .name = "Held", .parameters = "p", .criterion = "c", .judge = judge_held};
constexpr HardCase silent{
    .number = 2, .name = "Silent", .parameters = "p", .criterion = "c", .slow_under = method_list<xpbd, tr_bdf2>, .judge = judge_silent};
constexpr HardCase thrown{.number = 3, .name = "Thrown", .parameters = "p", .criterion = "c", .remark = "r", .judge = judge_thrown};
constexpr HardCase endless{.number = 4, .name = "Endless", .parameters = "p", .criterion = "c", .judge = judge_endless};

std::vector<CaseResult> run_planted(int threads) {
  const std::array cases{&held, &silent, &thrown};
  const std::array methods{&method("velocity_verlet"), &method("xpbd"), &method("tr_bdf2")};
  std::vector<CaseResult> results = list_cases(cases, methods, false);
  run_cases(results, threads, [](long, long) { return true; });
  return results;
}

TEST(HardCases, PlantedFailuresAreDetectedForAnyNumberOfThreads) {
  for (const int threads : {1, 4}) {
    const std::vector<CaseResult> results = run_planted(threads);
    ASSERT_EQ(results.size(), 9u);
    EXPECT_EQ(count_broken(results), 4);
    EXPECT_EQ(results[4].method->id, "xpbd");
    EXPECT_TRUE(is_broken(results[4].verdict));
    EXPECT_EQ(results[6].verdict.reason, "threw: a planted error");
    for (const CaseResult& result : results) EXPECT_TRUE(result.finished);
  }
}

TEST(HardCases, TheQuickSubsetContainsTheCheapOnes) {
  const std::array cases{&held, &silent};
  const std::array methods{&method("velocity_verlet"), &method("tr_bdf2")};
  const std::vector<CaseResult> results = list_cases(cases, methods, true);
  ASSERT_EQ(results.size(), 3u);
  EXPECT_EQ(results[2].hard_case, &silent);
  EXPECT_EQ(results[2].method->id, "velocity_verlet");
}

TEST(HardCases, InterruptedOnesStayUnfinished) {
  const std::array cases{&endless};
  std::vector<CaseResult> results = list_cases(cases, std::array{&method("velocity_verlet")}, false);
  run_cases(results, 1, [](long, long) { return false; });
  ASSERT_EQ(results.size(), 1u);
  EXPECT_FALSE(results[0].finished);
  EXPECT_EQ(count_broken(results), 0);
  EXPECT_NE(format_table(results).find("1 not run"), std::string::npos);
  // the next run is not affected
  EXPECT_EQ(count_broken(run_planted(1)), 4);
}

TEST(HardCases, AreTheConstantsOfTheirFiles) { EXPECT_EQ(&stiff_spring_case, &hard_cases()[0]); }

TEST(HardCases, AreComplete) {
  int number = 0;
  std::set<std::string_view> names;
  for (const HardCase& row : hard_cases()) {
    EXPECT_GT(row.number, std::exchange(number, row.number));
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_FALSE(row.parameters.empty() || row.criterion.empty() || row.judge == nullptr) << row.name;
  }
  EXPECT_GE(hard_cases().size(), 23u);
}

TEST(CaseReport, FitsATerminalAndNamesUnexpectedResults) {
  const std::string table = format_table(run_planted(1));
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(line.size() <= table_width || line.find_first_of(' ', 4) == std::string::npos) << line;
  EXPECT_NE(table.find("! 2 Silent, xpbd: failed silently, expected to hold;"), std::string::npos) << table;
  EXPECT_NE(table.find("9 results: 5 held, 0 failed openly, 0 out of scope, 4 unexpected"), std::string::npos) << table;
}

TEST(CaseReport, SeparatesAllWords) {
  const HardCase two_digits{.number = 27, .name = "Held", .parameters = "p", .criterion = "c", .judge = judge_held};
  std::vector<CaseResult> results = list_cases(std::array{&two_digits}, std::array{&method("xpbd")}, false);
  run_cases(results, 1, [](long, long) { return true; });
  EXPECT_NE(format_table(results).find("+ 27 Held, xpbd: held;"), std::string::npos) << format_table(results);
}

TEST(CaseReport, IsAvailableAsJson) {
  rapidjson::Document document;
  document.Parse(format_json(run_planted(1)).c_str());
  ASSERT_FALSE(document.HasParseError());
  EXPECT_EQ(document["broken"].GetInt(), 4);
  EXPECT_EQ(document["unfinished"].GetInt(), 0);
  EXPECT_FALSE(document["interrupted"].GetBool());
  ASSERT_EQ(document["cases"].Size(), 3u);
  const auto& silent_case = document["cases"][1];
  EXPECT_EQ(silent_case["number"].GetInt(), 2);
  for (const char* key : {"name", "parameters", "criterion", "remark"}) EXPECT_TRUE(silent_case[key].IsString()) << key;
  ASSERT_EQ(silent_case["results"].Size(), 3u);
  const auto& result = silent_case["results"][1];
  EXPECT_STREQ(result["method"].GetString(), "xpbd");
  EXPECT_STREQ(result["outcome"].GetString(), "failed_silently");
  EXPECT_STREQ(result["expected"].GetString(), "hold");
  EXPECT_TRUE(result["broken"].GetBool());
  EXPECT_TRUE(result["measured"].IsString() && result["reason"].IsString() && result["cpu_seconds"].IsDouble());
}

TEST(CaseReport, IsAvailableAsMarkdown) {
  const std::string document =
      format_markdown(run_planted(1), {.command = "hooke check --hard", .date = "2000-01-02", .machine = "Abacus"});
  for (const char* part : {"Measured on 2000-01-02, on one Abacus, with `hooke check --hard`.\n",
                           "| 2 Silent | held | **unexpected** | held |", "\n| 3 | ", " | r |\n"})
    EXPECT_NE(document.find(part), std::string::npos) << part;
}

// The trimmed cells of "| a | b |".
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream row(line.substr(1));
  for (std::string cell; std::getline(row, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
  }
  return cells;
}

TEST(StabilityPage, HasTheCasesAndMethodsOfTheProgramAndNoUnexpectedResults) {
  std::ifstream page(DOCS_FOLDER "/evidence/stability.md");
  std::vector<std::string> methods, rows, scenes;
  std::string text;
  for (std::string line; std::getline(page, line); text += line + "\n") {
    if (!line.starts_with("| ")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (cells[0] == "case" && methods.empty()) {
      methods.assign(cells.begin() + 1, cells.end());
    } else if (cells.size() == methods.size() + 1) {
      rows.push_back(cells[0]);
      // no case was excluded from the run that generated it
      EXPECT_EQ(std::ranges::count(cells, ""), 0) << line;
    } else if (cells[0] != "case") {
      scenes.push_back(line);
    }
  }

  std::vector<std::string> ids, names, descriptions;
  for (const Integrator& row : integrators()) ids.emplace_back(row.id);
  ids.emplace_back(automatic_method().id);
  for (const HardCase& row : hard_cases()) {
    names.push_back(std::to_string(row.number) + " " + std::string(row.name));
    descriptions.push_back("| " + std::to_string(row.number) + " | " + std::string(row.parameters) + " | " + std::string(row.criterion) +
                           " | " + std::string(row.remark) + " |");
  }
  EXPECT_EQ(methods, ids);
  EXPECT_EQ(rows, names);
  EXPECT_EQ(scenes, descriptions);
  EXPECT_EQ(text.find("**unexpected**"), std::string::npos);
  EXPECT_NE(text.find("none unexpected"), std::string::npos);
}

}  // namespace
}  // namespace hooke
