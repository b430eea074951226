// hooke-headless bench, run as a separate process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "study/work_precision_file.h"
#include "support/contents.h"
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

TEST(Bench, CtrlCKeepsFinishedResults) {
  const ScratchFolder scratch;
  const Process process(scratch.folder, {"net_w4", "--quick"});
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

TEST(Bench, RefusesInvalidRequests) {
  const ScratchFolder scratch;
  EXPECT_EQ(run(scratch.folder, {"--methods", "no_such_method"}), 2);
  EXPECT_EQ(run(scratch.folder, {"no_such_scene"}), 5);
  std::ofstream(scratch.folder / "bench.json") << "{}";
  EXPECT_EQ(run(scratch.folder, {"net_w2", "--quick"}), 3);
  EXPECT_EQ(contents(scratch.folder / "bench.json"), "{}");
}

// The page on methods equals the table and the results word for word; scripts/accuracy --report regenerates it.
TEST(Bench, TheDocumentedMethodsAreThoseOfTheTable) {
  const ScratchFolder scratch;
  ASSERT_EQ(Process(scratch.folder, {"--report", DOCS_FOLDER "/accuracy.json", "--quiet"}).wait(), 0);
  EXPECT_EQ(contents(scratch.folder / "methods.md"), contents(DOCS_FOLDER "/methods.md"));
}

}  // namespace
}  // namespace hooke
