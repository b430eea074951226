#include "lab/hard_cases/run_cases.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>
#include <thread>

#include "sim/settings.h"

namespace hooke {
namespace {

// CPU time of this thread [s].
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void run(CaseResult& result) {
  const double start = thread_seconds();
  try {
    result.verdict = result.hard_case->judge(result.method != nullptr ? *result.method : default_integrator());
  } catch (const std::exception& error) {
    result.verdict = {.outcome = Outcome::FailedSilently, .reason = std::string("threw: ") + error.what()};
  }
  result.cpu_seconds = thread_seconds() - start;
}

}  // namespace

std::vector<CaseResult> run_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, int threads,
                                  const std::function<void(long done, long all)>& on_done) {
  std::vector<CaseResult> results;
  for (const HardCase* hard_case : cases) {
    if (hard_case->concerns == Concerns::NoMethod)
      results.push_back({.hard_case = hard_case});
    else
      for (const Integrator* method : methods) results.push_back({.hard_case = hard_case, .method = method});
  }

  // the long ones first, so that no thread is left with one at the end
  std::vector<CaseResult*> order;
  for (CaseResult& result : results) order.push_back(&result);
  std::stable_partition(order.begin(), order.end(), [](const CaseResult* result) { return !result->hard_case->quick; });

  std::atomic<std::size_t> next = 0;
  std::atomic<long> done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < order.size(); i = next++) {
      run(*order[i]);
      ++done;
    }
  };
  std::vector<std::thread> crew;
  for (int i = 0; i < std::max(1, threads); ++i) crew.emplace_back(work);
  const long all = static_cast<long>(order.size());
  while (done < all) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    on_done(done, all);
  }
  for (std::thread& thread : crew) thread.join();
  return results;
}

int count_broken(std::span<const CaseResult> results) {
  return static_cast<int>(std::ranges::count_if(results, [](const CaseResult& result) { return is_broken(result.verdict); }));
}

}  // namespace hooke
