#include "batch/sweep/run_sweep.h"

#include "base/atomic_write.h"
#include "batch/output_file.h"
#include "batch/sweep/sweep_chart.h"
#include "batch/sweep/sweep_report.h"

namespace hooke {

SweepResults run_sweep(const SweepRequest& request, const SweepHooks& hooks) {
  SweepResults results{request.sweep, {}};
  std::optional<SweepJournal> journal;
  if (request.folder) {
    make_folder(*request.folder);
    journal.emplace(*request.folder / sweep_journal_name, request.sweep);
    results.rows = journal->rows();
  }

  std::vector<std::size_t> missing;
  for (std::size_t row = 0; row < request.sweep.row_count(); ++row)
    if (request.shard.has(row) && !results.rows.contains(row)) missing.push_back(row);
  const auto all = static_cast<long>(missing.size());
  long done = 0;
  hooks.progress(done, all);
  for (const std::size_t row : missing) {
    const std::optional<SweepRow> result = run_row(request.sweep, request.scene, row, hooks.should_continue);
    if (!result) break;
    if (journal) journal->add(*result);
    results.rows.emplace(row, *result);
    hooks.progress(++done, all);
  }
  if (request.folder) save_sweep(results, *request.folder);
  return results;
}

SweepResults merge_sweeps(const std::vector<std::filesystem::path>& parts, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> journals;
  for (const std::filesystem::path& part : parts) journals.push_back(part / sweep_journal_name);
  const std::filesystem::path target = folder / sweep_journal_name;
  if (std::filesystem::exists(target)) journals.push_back(target);
  const JournalContents merged = merge_journals(journals);
  make_folder(folder);
  write_atomically(target, format_journal(merged.sweep, merged.rows));
  SweepResults results{merged.sweep, merged.rows};
  save_sweep(results, folder);
  return results;
}

std::optional<std::string> draw_sweep_charts(const SweepResults& results, const std::filesystem::path& folder) {
  const std::optional<GnuplotChart> chart = sweep_chart(results.sweep, results.rows);
  if (!chart) return "no chart: too many combinations; vary at most two parameters, or fewer values";
  for (const char* file : {"sweep.svg", "sweep.png"})
    if (std::optional<std::string> failure = draw_chart(*chart, folder / file)) return failure;
  return std::nullopt;
}

void save_sweep(const SweepResults& results, const std::filesystem::path& folder) {
  make_folder(folder);
  write_atomically(folder / "sweep.csv", format_sweep_csv(results.sweep, results.rows));
  write_atomically(folder / "sweep.json", format_sweep_json(results.sweep, results.rows));
}

}  // namespace hooke
