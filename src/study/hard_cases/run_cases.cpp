#include "study/hard_cases/run_cases.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

#include "base/threads/thread_time.h"
#include "study/hard_cases/monitored_run.h"

namespace hooke {
namespace {

void run(CaseResult& result) {
  const double start = thread_cpu_seconds();
  try {
    result.verdict = result.hard_case->judge(*result.method);
  } catch (const Interrupted&) {
    return;
  } catch (const std::exception& error) {
    result.verdict = {.outcome = Outcome::FailedSilently, .reason = std::string("threw: ") + error.what()};
  }
  result.cpu_seconds = thread_cpu_seconds() - start;
  result.finished = true;
}

}  // namespace

std::vector<CaseResult> list_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, bool quick) {
  std::vector<CaseResult> results;
  for (const HardCase* hard_case : cases)
    for (const Integrator* method : methods)
      if (!quick || is_quick(*hard_case, *method)) results.push_back({.hard_case = hard_case, .method = method});
  return results;
}

void run_cases(std::span<CaseResult> results, int threads, const std::function<bool(long done, long all)>& should_continue) {
  // long cases first, so that no single thread is left with one at the end
  std::vector<CaseResult*> order;
  for (CaseResult& result : results) order.push_back(&result);
  std::stable_partition(order.begin(), order.end(),
                        [](const CaseResult* result) { return !is_quick(*result->hard_case, *result->method); });

  std::atomic<std::size_t> next = 0;
  std::atomic<long> done = 0;
  std::atomic<bool> stopped = false;
  set_interrupted(false);
  const auto work = [&] {
    for (std::size_t i = next++; i < order.size() && !stopped; i = next++) {
      run(*order[i]);
      ++done;
    }
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < std::max(1, threads); ++i) workers.emplace_back(work);

  const long all = static_cast<long>(order.size());
  while (done < all && !stopped) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (should_continue(done, all)) continue;
    stopped = true;
    set_interrupted(true);
  }
}

int count_broken(std::span<const CaseResult> results) {
  return static_cast<int>(
      std::ranges::count_if(results, [](const CaseResult& result) { return result.finished && is_broken(result.verdict); }));
}

}  // namespace hooke
