// hooke-headless bench, run as a separate process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "study/work_precision_file.h"
#include "support/contents.h"
#include "support/headless.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

namespace fs = std::filesystem;

// A running benchmark; its stderr goes to a file in its folder.
class Process {
 public:
  Process(const fs::path& folder, std::vector<std::string> arguments, bool with_path = true) : errors_(folder / "errors") {
    arguments.insert(arguments.begin(), {HOOKE_HEADLESS, "bench", "--out", folder.native()});
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::string path = "PATH=/nowhere";
    char* without_path[] = {path.data(), nullptr};

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, (folder / "report").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    EXPECT_EQ(posix_spawn(&id_, argv[0], &actions, nullptr, argv.data(), with_path ? environ : without_path), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  void interrupt() const { kill(id_, SIGINT); }
  int wait() const {
    int status = 0;
    waitpid(id_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string errors() const { return contents(errors_); }

 private:
  fs::path errors_;
  pid_t id_ = 0;
};

int run(const fs::path& folder, const std::vector<std::string>& arguments) { return Process(folder, arguments).wait(); }

Results results_in(const fs::path& folder) { return parse_results(contents(folder / "bench.json"), "bench.json"); }

TEST(Bench, WritesItsFilesAndKeepsExistingRows) {
  const ScratchFolder scratch;
  const std::vector<std::string> arguments{"net_w2", "--quick", "--methods", "velocity_verlet,xpbd"};
  ASSERT_EQ(run(scratch.folder, arguments), 0);
  for (const char* file : {"bench.json", "bench.csv", "bench.md", "bench.svg", "bench.png"})
    EXPECT_GT(fs::file_size(scratch.folder / file), 100u) << file;
  EXPECT_NE(contents(scratch.folder / "report").find("1e-1"), std::string::npos);

  // times differ from run to run, so equal rows were not computed again
  const Results first = results_in(scratch.folder);
  ASSERT_EQ(run(scratch.folder, arguments), 0);
  const Results second = results_in(scratch.folder);
  EXPECT_EQ(first.problems.at(0).rows, second.problems.at(0).rows);
  EXPECT_EQ(first.date, second.date);
}

TEST(Bench, PartsAreMergedIntoOneTable) {
  const ScratchFolder scratch;
  const std::vector<std::string> arguments{"net_w2", "--quick", "--methods", "velocity_verlet,xpbd,runge_kutta4"};
  for (const char* part : {"1/2", "2/2"}) {
    fs::create_directories(scratch.folder / part);
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"--shard", part});
    ASSERT_EQ(run(scratch.folder / part, words), 0);
  }
  ASSERT_EQ(run(scratch.folder, {"--merge", scratch.folder / "1/2", scratch.folder / "2/2"}), 0);
  const Results merged = results_in(scratch.folder), first = results_in(scratch.folder / "1/2"),
                second = results_in(scratch.folder / "2/2");
  ASSERT_EQ(merged.problems.size(), 1u);
  // in the order of the table of methods: the first and the third are those of the first part
  std::vector<std::string> methods;
  for (const Row& row : merged.problems[0].rows)
    if (methods.empty() || methods.back() != row.method) methods.push_back(row.method);
  EXPECT_EQ(methods, (std::vector<std::string>{"velocity_verlet", "runge_kutta4", "xpbd"}));
  EXPECT_EQ(merged.problems[0].rows.size(), first.problems.at(0).rows.size() + second.problems.at(0).rows.size());
  EXPECT_TRUE(merged.problems[0].reference);
  EXPECT_TRUE(fs::exists(scratch.folder / "bench.svg"));

  // one part alone is written, and the other one named
  const fs::path half = scratch.folder / "half";
  fs::create_directories(half);
  const Process incomplete(half, {"--merge", scratch.folder / "2/2", "-q"});
  EXPECT_EQ(incomplete.wait(), 1);
  EXPECT_EQ(incomplete.errors(), "incomplete: 1 of 2 shards are missing or not finished, the first is 1/2\n");
  EXPECT_EQ(results_in(half).problems.at(0).rows, second.problems.at(0).rows);

  // a part for which nothing is left says so
  const fs::path last = scratch.folder / "last";
  fs::create_directories(last);
  std::vector<std::string> words = arguments;
  words.insert(words.end(), {"--shard", "4/4", "-q"});
  ASSERT_EQ(run(last, words), 0);
  EXPECT_FALSE(results_in(last).date.empty());
  ASSERT_EQ(results_in(last).parts.size(), 1u);
  EXPECT_TRUE(results_in(last).parts[0].is_complete);

  // figures of another build are not mixed with these
  Results other = second;
  other.conditions.build = "0";
  std::ofstream(scratch.folder / "2/2" / "bench.json") << format_results(other);
  const Process refused(scratch.folder, {"--merge", scratch.folder / "1/2", scratch.folder / "2/2"});
  EXPECT_EQ(refused.wait(), 3);
  EXPECT_NE(refused.errors().find("measured with another build"), std::string::npos) << refused.errors();
}

TEST(Bench, InvalidPartsAreOneLine) {
  const ScratchFolder scratch;
  const std::string none = scratch.folder / "none";
  struct RefusedParts {
    std::vector<std::string> words;
    int code;
    std::string message;
  };
  for (const RefusedParts& refused : {RefusedParts{{"net_w2", "--shard", "0/4"}, 2, "--shard 0/4: must be I/N with I from 1 to N"},
                                      {{"--merge", none, "--shard", "1/2"}, 2, "excludes"},
                                      {{"--scaling", "--kernels"}, 2, "excludes"},
                                      {{"--overhead", "--kernels"}, 2, "excludes"},
                                      {{"--edits", "two_masses"}, 2, "excludes"},
                                      {{"--overhead", "--shard", "1/2"}, 2, "excludes"},
                                      {{"--capacity", "net_w2"}, 2, "excludes"},
                                      {{"--merge", none}, 5, none + "/bench.json: "}}) {
    const Process process(scratch.folder, refused.words);
    EXPECT_EQ(process.wait(), refused.code);
    EXPECT_EQ(lines_of(process.errors()).size(), 1u);
    EXPECT_NE(process.errors().find(refused.message), std::string::npos) << process.errors();
  }
}

TEST(Bench, CapacityFindsTheLargestClothOfEachMethod) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--capacity", "--quick", "--methods", "velocity_verlet,explicit_euler", "--error", "1e-3"}), 0);
  const std::vector<std::string> rows = lines_of(contents(scratch.folder / "capacity.csv"));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0], "method,points,springs,substeps,tolerance_m,relative_error,frame_ms,bounded");
  EXPECT_EQ(rows[1].rfind("explicit_euler,", 0), 0u);
  EXPECT_EQ(rows[2].rfind("velocity_verlet,256,930,", 0), 0u) << rows[2];
  EXPECT_NE(contents(scratch.folder / "report").find("| `velocity_verlet` | at least 16 x 16 | 930 |"), std::string::npos);

  const Process refused(scratch.folder, {"--error", "1e-3"});
  EXPECT_EQ(refused.wait(), 2);
  EXPECT_NE(refused.errors().find("--capacity"), std::string::npos) << refused.errors();
}

TEST(Bench, ScalingMeasuresTimeAndMemoryOfEachSize) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--scaling", "--quick"}), 0);
  std::ifstream csv(scratch.folder / "scaling.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "points,springs,step_ms,ns_per_spring,peak_mib,bytes_per_spring");
  for (const long springs : {930L, 3906L, 16002L, 64770L}) {
    ASSERT_TRUE(std::getline(csv, line));
    std::istringstream row(line);
    double points = 0.0, measured = 0.0, step = 0.0, each = 0.0, mib = 0.0, bytes = 0.0;
    char comma = 0;
    row >> points >> comma >> measured >> comma >> step >> comma >> each >> comma >> mib >> comma >> bytes;
    EXPECT_EQ(measured, static_cast<double>(springs));
    EXPECT_NEAR(each, step * 1e6 / measured, 0.01 * each);
    EXPECT_NEAR(bytes, mib * (1 << 20) / measured, 0.01 * bytes + 1.0);
    // the positions, velocities and springs alone take more
    if (springs > 60'000) {
      EXPECT_GT(bytes, 40.0);
    }
  }
  EXPECT_NE(contents(scratch.folder / "report").find("slope of log(time) over log(springs): "), std::string::npos);
}

TEST(Bench, KernelsAreMeasured) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--kernels", "--quick"}), 0);
  const std::string report = contents(scratch.folder / "report");
  for (const char* line : {"| grid | ", "| at rest on a plane | ", "| on a ball and a floor | ", "| lies in its folds | ", "| dashpots | ",
                           "| wind | ", "| general graph | ", "| jelly block | ", "| tr_bdf2 per 1/60 s | "})
    EXPECT_NE(report.find(line), std::string::npos) << line << report;
  std::istringstream csv(contents(scratch.folder / "kernels.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "case,points,springs,ns_per_spring");
  int rows = 0;
  for (; std::getline(csv, line); ++rows) {
    std::istringstream row(line.substr(line.find(',') + 1));
    double points = 0.0, springs = 0.0, each = 0.0;
    char comma = 0;
    row >> points >> comma >> springs >> comma >> each;
    EXPECT_GT(springs, 2 * points) << line;
    EXPECT_GT(each, 0.0) << line;
  }
  EXPECT_EQ(rows, 51);
}

TEST(Bench, CtrlCKeepsFinishedResults) {
  const ScratchFolder scratch;
  // soft enough for a slow machine to find its reference
  const Process process(scratch.folder, {"net_w2", "--quick"});
  // each method is written as soon as it is finished
  for (int i = 0; i < 3000 && !fs::exists(scratch.folder / "bench.json"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  process.interrupt();
  EXPECT_EQ(process.wait(), 130);
  EXPECT_FALSE(results_in(scratch.folder).problems.at(0).rows.empty());
  EXPECT_NE(process.errors().find("resumes from them"), std::string::npos);
}

TEST(Bench, WithoutGnuplotReportsItInOneLineAndWritesTheRest) {
  const ScratchFolder scratch;
  const Process process(scratch.folder, {"net_w2", "--quick", "--methods", "velocity_verlet"}, false);
  EXPECT_EQ(process.wait(), 0);
  EXPECT_EQ(process.errors(), "no chart: gnuplot is not installed (Debian: gnuplot-nox)\n");
  EXPECT_TRUE(fs::exists(scratch.folder / "bench.csv"));
  EXPECT_FALSE(fs::exists(scratch.folder / "bench.svg"));
}

TEST(Bench, OverheadMeasuresEveryMethodOnTheScenes) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--overhead", "--quick", "two_masses", "--methods", "velocity_verlet,dop853,auto"}), 0);
  const std::vector<std::string> rows = lines_of(contents(scratch.folder / "overhead.csv"));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], "scene,method,substeps,frame_ms,overhead");
  const std::vector<std::string> begins{"two_masses,velocity_verlet,", "two_masses,dop853,1,", "two_masses,auto,1,"};
  for (std::size_t i = 0; i < begins.size(); ++i) {
    EXPECT_TRUE(rows[i + 1].starts_with(begins[i])) << rows[i + 1];
    EXPECT_EQ(std::ranges::count(rows[i + 1], ','), 4);
    EXPECT_FALSE(rows[i + 1].ends_with(",")) << rows[i + 1];  // it did not diverge
  }
}

TEST(Bench, EditsAreTimedByKindAndSize) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--edits", "--quick"}), 0);
  const std::vector<std::string> rows = lines_of(contents(scratch.folder / "edits.csv"));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0], "edit,points,springs,ms");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::size_t last = rows[i].rfind(',');
    EXPECT_TRUE(rows[i].substr(0, last).ends_with(",1024,3906")) << rows[i];
    const double ms = std::stod(rows[i].substr(last + 1));
    EXPECT_TRUE(ms > 0.0 && ms < 60e3) << rows[i];
  }
}

TEST(Bench, ThatCannotWriteItsChartsFails) {
  const ScratchFolder scratch;
  std::filesystem::copy(DOCS_FOLDER "/evidence/accuracy.json", scratch.folder / "accuracy.json");
  const auto words = [&](const char* out) {
    return std::vector<std::string>{"bench", "--report", scratch.folder / "accuracy.json", "--quiet", "--out", scratch.folder / out};
  };
  ASSERT_EQ(headless(words("complete")).code, 0);
  // between the sizes of the pages and of the chart
  const auto pages = std::max(fs::file_size(scratch.folder / "complete/bench.md"), fs::file_size(scratch.folder / "complete/methods.md"));
  const auto chart = fs::file_size(scratch.folder / "complete/bench.svg");
  const int kibibytes = static_cast<int>((pages + chart) / 2048);
  ASSERT_LT(pages, 1024u * static_cast<unsigned>(kibibytes));
  ASSERT_GT(chart, 1024u * static_cast<unsigned>(kibibytes));
  const Outcome outcome = headless_with_short_files(kibibytes, words("short"));
  EXPECT_EQ(outcome.code, 5);
  EXPECT_NE(outcome.err.find((scratch.folder / "short/bench.svg").string() + ": cannot be written: File too large\n"), std::string::npos);
  EXPECT_FALSE(fs::exists(scratch.folder / "short/bench.svg"));
}

TEST(Bench, RefusesInvalidRequests) {
  const ScratchFolder scratch;
  EXPECT_EQ(run(scratch.folder, {"--methods", "no_such_method"}), 2);
  EXPECT_EQ(run(scratch.folder, {"no_such_scene"}), 5);
  std::ofstream(scratch.folder / "bench.json") << "{}";
  EXPECT_EQ(run(scratch.folder, {"net_w2", "--quick"}), 3);
  EXPECT_EQ(contents(scratch.folder / "bench.json"), "{}");
}

// What is below the uncertainty of the reference was not missed by the methods.
TEST(Bench, SaysWhatTheReferenceCannotTell) {
  const ScratchFolder scratch;
  ASSERT_EQ(run(scratch.folder, {"--report", DOCS_FOLDER "/evidence/accuracy.json"}), 0);
  const std::string report = contents(scratch.folder / "report");
  EXPECT_NE(report.find(", uncertain by "), std::string::npos) << report;
  EXPECT_NE(report.find("not measurable: the reference is uncertain by "), std::string::npos) << report;
  EXPECT_EQ(report.find("stability"), std::string::npos) << report;
}

// The page on methods equals the table and the results word for word; scripts/accuracy --report regenerates it.
TEST(Bench, TheDocumentedMethodsAreThoseOfTheTable) {
  const ScratchFolder scratch;
  ASSERT_EQ(Process(scratch.folder, {"--report", DOCS_FOLDER "/evidence/accuracy.json", "--quiet"}).wait(), 0);
  EXPECT_EQ(contents(scratch.folder / "methods.md"), contents(DOCS_FOLDER "/reference/methods.md"));
}

TEST(Bench, VerifyFailsOnlyWhereAnErrorHasGrown) {
  const ScratchFolder scratch;
  const fs::path now = scratch.folder / "now";
  fs::create_directory(now);
  const std::vector<std::string> request{"two_masses", "--methods", "velocity_verlet", "--quick", "--quiet"};
  ASSERT_EQ(Process(now, request).wait(), 0);
  Results results = parse_results(contents(now / "bench.json"), "now");
  const auto verify = [&] {
    std::ofstream(scratch.folder / "earlier.json") << format_results(results);
    std::vector<std::string> arguments = request;
    arguments.insert(arguments.end(), {"--verify", scratch.folder / "earlier.json", "--junit", scratch.folder / "junit.xml"});
    const Process process(now, arguments);
    const int code = process.wait();
    return std::pair(code, process.errors());
  };
  EXPECT_EQ(verify(), std::pair(0, std::string()));
  const auto found = std::ranges::find_if(results.problems[0].rows, [](const Row& row) { return row.relative_error > 1e-6; });
  ASSERT_NE(found, results.problems[0].rows.end());
  *found->relative_error *= 0.8;
  const auto [code, errors] = verify();
  EXPECT_EQ(code, 1);
  EXPECT_TRUE(errors.starts_with("two_masses, velocity_verlet, " + found->setting + ": error ")) << errors;
  EXPECT_EQ(std::ranges::count(errors, '\n'), 1);
  EXPECT_NE(contents(scratch.folder / "junit.xml").find("failures=\"1\""), std::string::npos);
  results.problems[0].id = "another";
  EXPECT_EQ(verify().first, 3);
}

}  // namespace
}  // namespace hooke
