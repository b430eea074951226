#include "study/kernels/machine_limits.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "study/kernels/machine_loops.h"

namespace hooke {
namespace {

struct Amount {
  int repeats = 7;
  double triad_bytes = 1e9;  // read and written in each
  std::size_t rounds = 3000;
};
constexpr Amount full_amount{}, quick_amount{.repeats = 2, .triad_bytes = 1e8, .rounds = 300};

// [s], wall time, which for two threads is what counts.
double best_time(int repeats, const std::function<void()>& work) {
  double best = HUGE_VAL;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    work();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

struct Arrays {
  std::vector<double> a, b, c;
  explicit Arrays(std::size_t count) : a(count, 1.0), b(count, 2.0), c(count, 3.0) {}
  void run(std::size_t rounds) {
    for (std::size_t i = 0; i < rounds; ++i) run_triad(a.data(), b.data(), c.data(), a.size());
  }
};

// [bytes/s] of all threads together, each on arrays of its own that have `bytes` together.
double triad_rate(double bytes, int threads, const Amount& amount) {
  constexpr double accesses = 3.0 * sizeof(double);
  const auto count = static_cast<std::size_t>(bytes / accesses) / 64 * 64;
  const auto rounds = static_cast<std::size_t>(std::max(1.0, amount.triad_bytes / (accesses * static_cast<double>(count))));
  std::vector<Arrays> arrays;
  for (int i = 0; i < threads; ++i) arrays.emplace_back(count);
  const double time = best_time(amount.repeats, [&] {
    std::vector<std::thread> others;
    for (int i = 1; i < threads; ++i) others.emplace_back([&arrays, i, rounds] { arrays[static_cast<std::size_t>(i)].run(rounds); });
    arrays[0].run(rounds);
    for (std::thread& other : others) other.join();
  });
  return threads * accesses * static_cast<double>(count * rounds) / time;
}

double cache_bytes(int name, double otherwise) {
  const long bytes = sysconf(name);
  return bytes > 0 ? static_cast<double>(bytes) : otherwise;
}

template <class T>
ArithmeticLimits arithmetic_limits(const Amount& amount) {
  ArithmeticLimits limits{.lanes = static_cast<int>(vector_lanes<T>())};
  const std::size_t fma_rounds = 300 * amount.rounds;
  T sum = 0;
  const double fma_time = best_time(amount.repeats, [&] { sum += run_fma<T>(fma_rounds); });
  // the sum is used, so that it is computed
  limits.fma_rate = sum == T(0.5) ? 0.0 : static_cast<double>(fma_rounds) * fma_chains * limits.lanes / fma_time;

  constexpr std::size_t count = 1024;
  std::vector<T> x(count, T(2)), y(count);
  const auto time_of = [&](void (*loop)(const T*, T*, std::size_t)) {
    const double time = best_time(amount.repeats, [&] {
      for (std::size_t i = 0; i < amount.rounds; ++i) loop(x.data(), y.data(), count);
    });
    return time / static_cast<double>(count * amount.rounds);
  };
  limits.sqrt_time = time_of(run_sqrt);
  limits.division_time = time_of(run_division);
  return limits;
}

}  // namespace

MachineLimits measure_machine_limits(bool quick) {
  const Amount& amount = quick ? quick_amount : full_amount;
  MachineLimits limits{
      .double_precision = arithmetic_limits<double>(amount), .single_precision = arithmetic_limits<float>(amount), .triads = {}};
  const double l1 = cache_bytes(_SC_LEVEL1_DCACHE_SIZE, 32 << 10), l2 = cache_bytes(_SC_LEVEL2_CACHE_SIZE, 1 << 20);
  const double l3 = cache_bytes(_SC_LEVEL3_CACHE_SIZE, 16 << 20);
  // A virtual machine reports the cache of the whole processor but has a share of it. Arrays of two threads must fit into the shared cache.
  constexpr double max_shared = 12 << 20, memory = 192 << 20;
  limits.triads = {{.level = "L1", .bytes = 0.5 * l1, .is_of_each_core = true},
                   {.level = "L2", .bytes = 0.5 * l2, .is_of_each_core = true},
                   {.level = "L3", .bytes = std::min(0.4 * l3, max_shared)},
                   {.level = "memory", .bytes = memory}};
  for (TriadLimit& triad : limits.triads) {
    triad.one_thread = triad_rate(triad.bytes, 1, amount);
    triad.two_threads = triad_rate(triad.bytes, 2, amount);
  }
  return limits;
}

double shortest_time_per_spring(const MachineLimits& limits, const StepSize& step) {
  const ArithmeticLimits& arithmetic = step.is_single ? limits.single_precision : limits.double_precision;
  constexpr double operations = 22.0;
  const double calculation = std::max(operations / arithmetic.fma_rate, arithmetic.sqrt_time + arithmetic.division_time) / step.threads;
  // read and write three components of position and velocity, and read the mass
  const double value = step.is_single ? sizeof(float) : sizeof(double);
  const double bytes = 13.0 * value * step.points, state_bytes = 7.0 * value * step.points;
  // beside other programs, two threads may have been measured to be slower than one
  const auto rate_of = [&](const TriadLimit& triad) {
    return step.threads > 1 ? std::max(triad.one_thread, triad.two_threads) : triad.one_thread;
  };
  double rate = rate_of(limits.triads.back());
  for (const TriadLimit& triad : limits.triads) {
    if (state_bytes / (triad.is_of_each_core ? step.threads : 1) > 2.0 * triad.bytes) continue;
    rate = rate_of(triad);
    break;
  }
  return std::max(calculation, bytes / step.springs / rate);
}

}  // namespace hooke
