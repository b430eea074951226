// Runs one check of the reliability campaign:
//   campaign CHECK [--from NUMBER] [--cases COUNT] [--units COUNT] [--seconds SECONDS]
// It ends when one of the counts or the time limit is reached. Cases run in a child process, which is restarted when a case ends it.
// Prints "cases units findings" and exits with 1 if there are findings; each finding is a line on stderr with the number of its case.

#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <string>

#include "campaign/check.h"

namespace hooke {

std::span<const Check* const> checks() {
  static constexpr std::array rows{&round_trips, &saves_killed, &saves_failing, &actions, &replays, &extremes, &long_run, &hostile_paths};
  return rows;
}

namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::uint64_t from = 0, cases = ~std::uint64_t{0};
  long units = std::numeric_limits<long>::max();
  double seconds = 1e9;
};

// The progress of the child process, in memory shared with its parent.
struct Progress {
  std::atomic<std::uint64_t> cases{0}, findings{0};
  std::atomic<long> units{0};
};

bool is_done(const Options& options, Clock::time_point end, const Progress& progress) {
  return progress.cases >= options.cases || progress.units >= options.units || Clock::now() >= end;
}

// Ends the process when a case takes more CPU time than allowed, or waits forever; a machine that is busy elsewhere is no finding.
void limit_case(unsigned seconds) {
  const itimerval limit{.it_interval = {}, .it_value = {.tv_sec = static_cast<time_t>(seconds), .tv_usec = 0}};
  setitimer(ITIMER_PROF, &limit, nullptr);
  alarm(100 * seconds);
}

void run_cases(const Check& check, const Options& options, Clock::time_point end, Progress& progress) {
  while (!is_done(options, end, progress)) {
    const std::uint64_t number = options.from + progress.cases;
    limit_case(check.max_seconds);
    try {
      progress.units += check.run(number);
    } catch (const std::exception& finding) {
      std::fprintf(stderr, "%s: case %llu: %s\n", check.name.data(), static_cast<unsigned long long>(number), finding.what());
      ++progress.findings;
    }
    limit_case(0);
    ++progress.cases;
  }
}

int run(const Check& check, const Options& options) {
  void* shared = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::abort();
  auto& progress = *new (shared) Progress;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  while (!is_done(options, end, progress)) {
    const pid_t child = fork();
    if (child == 0) {
      run_cases(check, options, end, progress);
      std::exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
    const bool is_late = WIFSIGNALED(status) && (WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGALRM);
    std::fprintf(stderr, "%s: case %llu: %s %d\n", check.name.data(), static_cast<unsigned long long>(options.from) + progress.cases,
                 is_late ? "exceeded the time limit, in seconds:" : "ended the process with status",
                 is_late ? static_cast<int>(check.max_seconds) : status);
    ++progress.findings;
    ++progress.cases;
  }
  std::printf("%llu %ld %llu\n", static_cast<unsigned long long>(progress.cases.load()), progress.units.load(),
              static_cast<unsigned long long>(progress.findings.load()));
  return progress.findings > 0 ? 1 : 0;
}

int usage() {
  std::fprintf(stderr, "usage: campaign CHECK [--from NUMBER] [--cases COUNT] [--units COUNT] [--seconds SECONDS]\nchecks:\n");
  for (const Check* check : checks()) std::fprintf(stderr, "  %-16s counts %s\n", check->name.data(), check->unit.data());
  return 2;
}

}  // namespace
}  // namespace hooke

int main(int count, char** words) {
  using namespace hooke;
  if (count < 2 || count % 2 != 0) return usage();
  Options options;
  for (int i = 2; i < count; i += 2) {
    const std::string option = words[i];
    if (option == "--from")
      options.from = std::strtoull(words[i + 1], nullptr, 10);
    else if (option == "--cases")
      options.cases = std::strtoull(words[i + 1], nullptr, 10);
    else if (option == "--units")
      options.units = std::atol(words[i + 1]);
    else if (option == "--seconds")
      options.seconds = std::atof(words[i + 1]);
    else
      return usage();
  }
  for (const Check* check : checks())
    if (check->name == words[1]) return run(*check, options);
  return usage();
}
