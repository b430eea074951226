// A cloth stepped by two threads: with all forces computed before the first point moves, or with each thread moving its points immediately,
// so that a force uses some neighbors before and some after their step, depending on timing.
#include <algorithm>
#include <atomic>
#include <barrier>
#include <cmath>
#include <thread>
#include <vector>

#include "question.h"

namespace hooke {
namespace {

constexpr int n = 16, points = n * n, steps = 3000, samples = 40;
constexpr double side = 1.0 / (n - 1), k = 200.0, mass = 1.0 / points, h = 1.0 / 6000.0, gravity = 9.81;

// Atomic, so that only the order of reads and writes is undetermined, and no value is torn.
using Shared = std::atomic<double>;

struct Cloth {
  std::vector<Shared> x = std::vector<Shared>(3 * points), v = std::vector<Shared>(3 * points);
  Cloth() {
    for (int i = 0; i < points; ++i) {
      const int row = i / n, column = i % n;
      x[3 * i] = column * side;
      x[3 * i + 1] = 0.0;
      x[3 * i + 2] = row * side;
    }
  }
  static bool is_nailed(int i) { return i == 0 || i == n - 1; }

  void force(int i, double* f) const {
    f[0] = f[2] = 0.0;
    f[1] = -mass * gravity;
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) {
        const int r = i / n + row, c = i % n + column, j = r * n + c;
        if ((row == 0 && column == 0) || r < 0 || r >= n || c < 0 || c >= n) continue;
        const double rest = side * std::hypot(row, column);
        double d[3], square = 0.0;
        for (int a = 0; a < 3; ++a) {
          d[a] = x[3 * j + a].load(std::memory_order_relaxed) - x[3 * i + a].load(std::memory_order_relaxed);
          square += d[a] * d[a];
        }
        const double pull = k * (1.0 - rest / std::sqrt(square));
        for (int a = 0; a < 3; ++a) f[a] += pull * d[a];
      }
  }
  void move(int i, const double* f) {
    if (is_nailed(i)) return;
    for (int a = 0; a < 3; ++a) {
      const double speed = v[3 * i + a].load(std::memory_order_relaxed) + h / mass * f[a];
      v[3 * i + a].store(speed, std::memory_order_relaxed);
      x[3 * i + a].store(x[3 * i + a].load(std::memory_order_relaxed) + h * speed, std::memory_order_relaxed);
    }
  }
};

// Height of the free corner over time.
std::vector<double> heights(bool separate_passes) {
  Cloth cloth;
  std::vector<double> forces(3 * points), heights_sampled;
  std::barrier sync_point(2);
  const auto work = [&](int thread) {
    const int begin = thread * points / 2, end = (thread + 1) * points / 2;
    for (int step = 0; step < steps; ++step) {
      for (int i = begin; i < end; ++i) {
        cloth.force(i, &forces[3 * i]);
        if (!separate_passes) cloth.move(i, &forces[3 * i]);
      }
      sync_point.arrive_and_wait();
      for (int i = begin; i < end && separate_passes; ++i) cloth.move(i, &forces[3 * i]);
      sync_point.arrive_and_wait();
      if (thread == 0 && step % (steps / samples) == 0) heights_sampled.push_back(cloth.x[3 * (points - 1) + 1]);
    }
  };
  std::jthread other(work, 1);
  work(0);
  other.join();
  return heights_sampled;
}

}  // namespace

Answer why_a_pass_must_end() {
  Answer answer{{.title = "Six runs of the same cloth on two threads, compared with the first run with separate passes",
                 .x = "simulated time [s]",
                 .y = "difference of the free corner [m]",
                 .log_y = true,
                 .series = {},
                 .y_range = "[1e-17:1]"},
                {}};
  const std::vector<double> first = heights(true);
  double spread = 0.0;
  std::vector<double> racing;
  for (const bool separate_passes : {true, false})
    for (int run = 1; run <= 3; ++run) {
      const std::vector<double> heights_sampled = heights(separate_passes);
      Series series{(separate_passes ? "separate passes, run " : "moved immediately, run ") + std::to_string(run), {}};
      for (int s = 0; s < samples; ++s) {
        const double gap = std::abs(heights_sampled[s] - first[s]);
        if (separate_passes) spread = std::max(spread, gap);
        constexpr int steps_per_sample = steps / samples;
        series.points.push_back({s * steps_per_sample * h, std::max(gap, 2e-17)});  // 0 cannot be shown on a logarithmic scale
      }
      if (!separate_passes) racing.push_back(series.points.back().second);
      answer.chart.series.push_back(std::move(series));
    }
  answer.expect(spread == 0.0, "runs with separate passes are bitwise equal");
  answer.expect(*std::max_element(racing.begin(), racing.end()) > 1e-9, "moving points immediately changes the result");
  return answer;
}

}  // namespace hooke
