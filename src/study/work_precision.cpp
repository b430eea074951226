#include "study/work_precision.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/step/frame_device.h"

namespace hooke {
namespace {

bool reached_end(const Row& row) { return row.relative_error.has_value(); }

bool is_stable(const Row& row) { return reached_end(row) && row.status != status::lost; }

void sort_rows(std::vector<Row>& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    const auto key = [](const Row& row) { return std::pair(method_index(row), -row.step.value_or(row.tolerance.value_or(0.0))); };
    return key(a) < key(b);
  });
}

// The first setting of a sweep: at the stability limit if there is one, otherwise four steps per snapshot.
Setting coarsest_setting(const Benchmark& benchmark, const Integrator& method) {
  if (is_adaptive(method)) return {.tolerance = 1e-2 * benchmark.problem().size};
  const double limit = StepLimits(benchmark.spectrum()).stable_step(method);
  if (!(limit > 0.0) || !std::isfinite(limit)) return {.steps = 4};
  return {.steps = std::max(1, static_cast<int>(std::ceil(benchmark.step({}) / limit)))};
}

}  // namespace

std::ptrdiff_t method_index(const Row& row) {
  const auto methods = integrators();
  return std::ranges::find(methods, row.method, &Integrator::id) - methods.begin();
}

ProblemRecord make_record(const Problem& problem) {
  return {.id = problem.id,
          .title = problem.title,
          .points = problem.system.point_count(),
          .springs = problem.system.spring_count(),
          .seconds = problem.seconds,
          .size = problem.size,
          .fingerprint = fingerprint(problem)};
}

PrecisionSweep::PrecisionSweep(const Problem& problem, const Effort& effort, ProblemRecord& record)
    : problem_(problem), effort_(effort), record_(record), benchmark_(problem) {}

bool PrecisionSweep::run(const Integrator& method, const std::shared_ptr<FrameDevice>& device) {
  if (device != nullptr && !device->refusal(benchmark_.plan(), method).empty()) return true;
  device_ = device;
  const Setting first = coarsest_setting(benchmark_, method);
  const Row* row = measure(method, first);
  if (row != nullptr && is_stable(*row)) sweep_coarser(method, first);
  if (!stopped_) sweep_finer(method, first);
  sort_rows(record_.rows);
  return !stopped_;
}

void PrecisionSweep::sweep_coarser(const Integrator& method, Setting setting) {
  if (setting.tolerance) {
    // one larger tolerance; it makes no sense beyond the size of the scene
    measure(method, {.steps = setting.steps, .tolerance = 10.0 * *setting.tolerance});
    return;
  }
  int held = setting.steps;
  while (held > 1) {
    const int coarser = held / 2;
    const Row* row = measure(method, {.steps = coarser});
    if (row == nullptr) return;
    if (is_stable(*row)) {
      held = coarser;
      continue;
    }

    // find the limit to within 20 %: an explicit method is often cheapest there
    for (int failed = coarser; 1.2 * failed < held;) {
      const int middle = static_cast<int>(std::lround(std::sqrt(static_cast<double>(failed) * held)));
      if (middle == failed || middle == held) return;
      row = measure(method, {.steps = middle});
      if (row == nullptr) return;
      (is_stable(*row) ? held : failed) = middle;
    }
    return;
  }
}

void PrecisionSweep::sweep_finer(const Integrator& method, Setting setting) {
  double last_error = INFINITY, last_cost = 0.0;
  for (;; setting = benchmark_.finer(setting)) {
    const Row* row = measure(method, setting);
    if (row == nullptr || row->status == status::too_slow || row->status == status::too_large || row->status == status::below_reference)
      return;
    if (setting.tolerance && *setting.tolerance < 1e-13 * problem_.size) return;
    if (!reached_end(*row)) {
      if (setting.steps > 100'000'000) return;
      continue;
    }

    const double error = *row->relative_error;
    const bool has_stalled = error < 1e-8 && error > 0.7 * last_error;
    if (error < effort_.finest_error || has_stalled) return;
    const double cost = *row->cpu_ms_per_s * 1e-3 * problem_.seconds;
    const double growth = last_cost > 0.0 ? std::clamp(cost / last_cost, 1.0, 2.0) : 2.0;
    if (growth * cost > effort_.run_seconds) return;
    last_error = error;
    last_cost = cost;
  }
}

const Row* PrecisionSweep::measure(const Integrator& method, const Setting& setting) {
  if (stopped_) return nullptr;
  const std::string name = benchmark_.name(setting);
  for (const Row& row : record_.rows)
    if (row.method == name_of(method) && row.setting == name) return &row;

  std::optional<Row> row = ensure_reference() ? measure_row(method, setting) : std::nullopt;
  if (!row) {
    stopped_ = true;
    return nullptr;
  }
  record_.rows.push_back(*row);
  row_done();
  return &record_.rows.back();
}

std::optional<Row> PrecisionSweep::measure_row(const Integrator& method, const Setting& setting) {
  Row row{.method = name_of(method), .setting = benchmark_.name(setting), .tolerance = setting.tolerance};
  if (!setting.tolerance) row.step = benchmark_.step(setting);

  // abandon a run that takes far longer than the sweep allows
  benchmark_.set_device(device_);
  if (device_ != nullptr) benchmark_.run(method, setting, [] { return false; });  // compiles the passes
  double begin = benchmark_.now();
  const auto within_time = [&] { return should_continue() && benchmark_.now() - begin < 5.0 * effort_.run_seconds; };
  RunResult result = benchmark_.run(method, setting, within_time);
  if (!should_continue()) return std::nullopt;
  row.work = result.work;
  row.runs = 1;
  if (result.end != RunResult::End::Finished) {
    using enum RunResult::End;
    row.status = result.end == Diverged ? status::diverged : result.end == TooLarge ? status::too_large : status::too_slow;
    return row;
  }

  // the minimum time of several runs, as many as fit in the time of one long run
  double min = result.cpu_seconds, spent = min;
  while (row.runs < effort_.repeats && spent + min < effort_.run_seconds) {
    begin = benchmark_.now();
    const RunResult again = benchmark_.run(method, setting, within_time);
    if (again.end != RunResult::End::Finished) return std::nullopt;
    spent += again.cpu_seconds;
    min = std::min(min, again.cpu_seconds);
    ++row.runs;
  }

  const Score score = judge(problem_, reference_->measure, reference_->snapshots(), result.snapshots);
  row.error = score.error;
  row.relative_error = score.relative_error;
  row.energy_drift = score.energy_drift;
  row.strain_error = score.strain_error;
  row.cpu_ms_per_s = 1e3 * min / problem_.seconds;
  if (result.unconverged_solves > 0)
    row.status = status::unconverged;
  else if (score.relative_error > 1.0)
    row.status = status::lost;
  else if (score.relative_error < reference_->uncertainty())
    row.status = status::below_reference;
  else
    row.status = status::ok;
  return row;
}

bool PrecisionSweep::ensure_reference() {
  if (reference_) return true;
  ReferenceResult result = compute_reference(benchmark_, effort_.reference_seconds, should_continue);
  reference_failure_ = result.failure;
  reference_failure_reason_ = result.reason;
  if (!result.reference) return false;
  reference_ = std::move(result.reference);
  record_.reference = ReferenceRecord{.method = std::string(reference_->own.method->id),
                                      .setting = reference_->own.setting_name,
                                      .other_method = std::string(reference_->other.method->id),
                                      .other_setting = reference_->other.setting_name,
                                      .own_gap = reference_->own.gap,
                                      .other_own_gap = reference_->other.gap,
                                      .other_gap = reference_->other_gap,
                                      .amplification = reference_->amplification,
                                      .measure = reference_->measure};
  return true;
}

std::optional<double> error_with_uncertainty(const ProblemRecord& record, const Row& row) {
  if (!row.relative_error) return std::nullopt;
  return std::max(*row.relative_error, record.reference ? record.reference->uncertainty() : 0.0);
}

bool is_measurable(const ProblemRecord& record, double relative_error) {
  return !record.reference || record.reference->uncertainty() <= relative_error;
}

const Row* cheapest(const ProblemRecord& record, double relative_error) {
  const Row* best = nullptr;
  for (const Row& row : record.rows) {
    const std::optional<double> error = error_with_uncertainty(record, row);
    if (!error || *error > relative_error) continue;
    if (best == nullptr || *row.cpu_ms_per_s < *best->cpu_ms_per_s) best = &row;
  }
  return best;
}

std::vector<const Row*> pareto_front(const ProblemRecord& record) {
  std::vector<const Row*> rows;
  for (const Row& row : record.rows)
    if (is_stable(row)) rows.push_back(&row);
  std::stable_sort(rows.begin(), rows.end(), [](const Row* a, const Row* b) { return *a->cpu_ms_per_s < *b->cpu_ms_per_s; });

  std::vector<const Row*> pareto_front;
  for (const Row* row : rows)
    if (pareto_front.empty() || *error_with_uncertainty(record, *row) < *error_with_uncertainty(record, *pareto_front.back()))
      pareto_front.push_back(row);
  return pareto_front;
}

}  // namespace hooke
