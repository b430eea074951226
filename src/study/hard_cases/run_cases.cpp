#include "study/hard_cases/run_cases.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <exception>
#include <thread>

#include "sim/model/settings.h"
#include "study/hard_cases/monitored_run.h"

namespace hooke {
namespace {

// CPU time of this thread [s].
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const Integrator& method_of(const CaseResult& result) { return result.method != nullptr ? *result.method : default_integrator(); }

void run(CaseResult& result) {
  const double start = thread_seconds();
  try {
    result.verdict = result.hard_case->judge(method_of(result));
  } catch (const Interrupted&) {
    return;
  } catch (const std::exception& error) {
    result.verdict = {.outcome = Outcome::FailedSilently, .reason = std::string("threw: ") + error.what()};
  }
  result.cpu_seconds = thread_seconds() - start;
  result.finished = true;
}

}  // namespace

std::vector<CaseResult> list_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, bool quick) {
  std::vector<CaseResult> results;
  const auto add = [&](const HardCase& hard_case, const Integrator* method) {
    CaseResult result{.hard_case = &hard_case, .method = method};
    if (!quick || is_quick(hard_case, method_of(result))) results.push_back(std::move(result));
  };
  for (const HardCase* hard_case : cases) {
    if (hard_case->concerns == Concerns::NoMethod)
      add(*hard_case, nullptr);
    else
      for (const Integrator* method : methods) add(*hard_case, method);
  }
  return results;
}

void run_cases(std::span<CaseResult> results, int threads, const std::function<bool(long done, long all)>& should_continue) {
  // long cases first, so that no single thread is left with one at the end
  std::vector<CaseResult*> order;
  for (CaseResult& result : results) order.push_back(&result);
  std::stable_partition(order.begin(), order.end(),
                        [](const CaseResult* result) { return !is_quick(*result->hard_case, method_of(*result)); });

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
