#include "peers/peer_sweep.h"

#include <algorithm>
#include <cmath>

#include "base/formatted.h"

namespace hooke {
namespace {

bool is_beaten(const Row& row, const Row& by) {
  return *by.relative_error <= *row.relative_error && *by.cpu_ms_per_s <= *row.cpu_ms_per_s && by.setting != row.setting;
}

class Sweep {
 public:
  Sweep(const std::string& id, int iterations, Peer& peer, const Problem& problem, const Reference& reference, const Effort& effort)
      : id_(id), iterations_(iterations), peer_(peer), problem_(problem), reference_(reference), effort_(effort) {}

  std::vector<Row> rows;

  void run(double first_step) {
    const double part = problem_.seconds / snapshot_count;
    const int first = first_step > 0.0 ? std::max(1, static_cast<int>(std::ceil(part / first_step))) : 4;
    if (measure(first)) sweep_coarser(first);
    sweep_finer(first);
  }

 private:
  // Whether the run was stable.
  bool measure(int steps) {
    for (const Row& row : rows)
      if (row.setting == name(steps)) return is_stable(row);
    PeerRun run = peer_.run({.snapshots = snapshot_count, .steps = steps, .iterations = iterations_});
    Row row{.method = id_, .setting = name(steps), .step = problem_.seconds / snapshot_count / steps, .runs = 1};
    if (run.is_finished) {
      const Score score = judge(problem_, reference_.measure, reference_.snapshots(), run.snapshots);
      double min = run.total_cpu_seconds(), spent = min;
      for (; row.runs < effort_.repeats && spent + min < effort_.run_seconds; ++row.runs) {
        const double again = peer_.run({.snapshots = snapshot_count, .steps = steps, .iterations = iterations_}).total_cpu_seconds();
        min = std::min(min, again);
        spent += again;
      }
      row.error = score.error;
      row.relative_error = std::max(score.relative_error, reference_.uncertainty());
      row.cpu_ms_per_s = 1e3 * min / problem_.seconds;
    }
    row.status = !run.is_finished ? status::diverged : *row.relative_error > 1.0 ? status::lost : status::ok;
    rows.push_back(row);
    return is_stable(row);
  }

  void sweep_coarser(int held) {
    while (held > 1) {
      const int coarser = held / 2;
      if (measure(coarser)) {
        held = coarser;
        continue;
      }
      // the limit to within 20 %: an explicit method is often cheapest there
      for (int failed = coarser; 1.2 * failed < held;) {
        const int middle = static_cast<int>(std::lround(std::sqrt(static_cast<double>(failed) * held)));
        if (middle == failed || middle == held) return;
        (measure(middle) ? held : failed) = middle;
      }
      return;
    }
  }

  void sweep_finer(int steps) {
    double last_error = INFINITY;
    for (int stalled = 0; stalled < 3 && steps < 10'000'000; steps *= 2) {
      if (!measure(steps)) continue;
      const Row& row = *std::ranges::find(rows, name(steps), &Row::setting);
      if (*row.relative_error <= std::max(effort_.finest_error, reference_.uncertainty())) return;
      stalled = *row.relative_error > 0.9 * last_error && *row.relative_error < 0.1 ? stalled + 1 : 0;
      last_error = *row.relative_error;
      if (2.0 * *row.cpu_ms_per_s * 1e-3 * problem_.seconds > effort_.run_seconds) return;
    }
  }

  std::string name(int steps) const {
    std::string text = formatted("%.10g steps/s", steps * snapshot_count / problem_.seconds);
    if (iterations_ > 1) append_formatted(text, ", %d iterations", iterations_);
    return text;
  }
  static bool is_stable(const Row& row) { return row.status == status::ok; }

  const std::string& id_;
  int iterations_;
  Peer& peer_;
  const Problem& problem_;
  const Reference& reference_;
  const Effort& effort_;
};

}  // namespace

void sweep_peer(const PeerSweep& sweep, Peer& peer, const Problem& problem, const Reference& reference, const Effort& effort,
                ProblemRecord& record) {
  std::vector<Row> rows;
  for (const int iterations : sweep.iterations) {
    Sweep each(sweep.id, iterations, peer, problem, reference, effort);
    each.run(sweep.first_step);
    rows.insert(rows.end(), each.rows.begin(), each.rows.end());
  }
  std::erase_if(rows, [](const Row& row) { return row.status != status::ok; });
  if (sweep.iterations.size() > 1) {
    const std::vector<Row> all = rows;
    std::erase_if(rows, [&](const Row& row) { return std::ranges::any_of(all, [&](const Row& by) { return is_beaten(row, by); }); });
  }
  std::ranges::stable_sort(rows, {}, [](const Row& row) { return *row.cpu_ms_per_s; });
  record.rows.insert(record.rows.end(), rows.begin(), rows.end());
}

double step_seconds_per_spring(const ProblemRecord& record, const std::string& id) {
  double min = 0.0;
  for (const Row& row : record.rows) {
    if (row.method != id) continue;
    const double seconds = *row.cpu_ms_per_s * 1e-3 * *row.step / record.springs;
    if (min == 0.0 || seconds < min) min = seconds;
  }
  return min;
}

}  // namespace hooke
