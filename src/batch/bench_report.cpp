#include "batch/bench_report.h"

#include <cmath>
#include <vector>

#include "base/formatted.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

// Consecutive decades of error with the same cheapest row; null if no row reaches them, or if the reference does not tell.
struct CheapestRow {
  int first = 1, last = 1;
  const Row* row = nullptr;
  bool is_measurable = true;
  std::string decades() const {
    std::string text = "1e-" + std::to_string(first);
    return last > first ? text + " .. 1e-" + std::to_string(last) : text;
  }
};

std::vector<CheapestRow> cheapest_rows(const ProblemRecord& record) {
  std::vector<CheapestRow> list;
  for (int decade = 1; decade <= 10; ++decade) {
    const double error = std::pow(10.0, -decade);
    const Row* row = cheapest(record, error);
    const bool measurable = is_measurable(record, error);
    if (!list.empty() && list.back().row == row && list.back().is_measurable == measurable)
      list.back().last = decade;
    else
      list.push_back({decade, decade, row, measurable});
  }
  return list;
}

// Of decades without a row.
std::string without_row(const CheapestRow& cheapest_row, const ProblemRecord& record) {
  if (cheapest_row.is_measurable) return "not reached";
  return formatted("not measurable: the reference is uncertain by %.0e", record.reference->uncertainty());
}

const char* errors_of(const ReferenceRecord& reference) {
  return reference.measure == Measure::Observables ? "center of mass, largest strain and energy" : "positions";
}

// "2 points, 1 spring"
std::string size_text(const ProblemRecord& record) {
  return pluralize(static_cast<std::size_t>(record.points), "point", "points") + ", " +
         pluralize(static_cast<std::size_t>(record.springs), "spring", "springs");
}

// A row of the table of references.
std::string reference_row(const ProblemRecord& record) {
  std::string row = formatted("| %s | %s, %g s |", record.id.c_str(), size_text(record).c_str(), record.seconds);
  if (!record.reference) return row + " | none: nothing measured | | | | | |\n";
  const ReferenceRecord& reference = *record.reference;
  append_formatted(row, " %s | `%s`, %s | %.0e | `%s`, %s | %.0e | %.0e | %.2g times |\n", errors_of(reference), reference.method.c_str(),
                   reference.setting.c_str(), reference.own_gap, reference.other_method.c_str(), reference.other_setting.c_str(),
                   reference.other_gap, reference.other_own_gap, reference.amplification);
  return row;
}

// "192 forces", "40 factorizations, 80 solves".
std::string describe(const WorkCounts& work) {
  std::string text;
  const auto add = [&](long count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + what;
  };
  add(work.force_evaluations, "forces");
  add(work.sweeps, "sweeps");
  add(work.factorizations, "factorizations");
  add(work.solves, "solves");
  return text;
}

}  // namespace

std::string report(const ProblemRecord& record) {
  std::string text;
  append_formatted(text, "%s: %s (%s, %g s)\n", record.id.c_str(), record.title.c_str(), size_text(record).c_str(), record.seconds);
  if (!record.reference) return text + "  no reference, nothing measured\n";
  append_formatted(text, "  errors of %s; reference: %s at %s, uncertain by %.0e\n", errors_of(*record.reference),
                   record.reference->method.c_str(), record.reference->setting.c_str(), record.reference->uncertainty());
  for (const CheapestRow& cheapest_row : cheapest_rows(record))
    if (cheapest_row.row == nullptr)
      append_formatted(text, "  %-14s  %s\n", cheapest_row.decades().c_str(), without_row(cheapest_row, record).c_str());
    else
      append_formatted(text, "  %-14s  %-18s %10.3g ms/s   %s\n", cheapest_row.decades().c_str(), cheapest_row.row->method.c_str(),
                       *cheapest_row.row->cpu_ms_per_s, cheapest_row.row->setting.c_str());
  return text;
}

std::string markdown_report(const Results& results) {
  const Conditions& conditions = results.conditions;
  std::string text, references;
  append_formatted(text, "Measured %s with hooke %s, %s effort, one thread of: %s. ", results.date.c_str(), conditions.version.c_str(),
                   conditions.effort.c_str(), conditions.machine.c_str());
  text +=
      "Errors are relative to the size of the scene; the cost is in CPU milliseconds per simulated second, the minimum of several runs.\n";
  for (const ProblemRecord& record : results.problems) {
    references += reference_row(record);
    if (!record.reference) continue;
    append_formatted(text, "\n### %s: %s\n\n", record.id.c_str(), record.title.c_str());
    text += "| error at most | cheapest method | cost [ms/s] | setting | error | work |\n|---|---|---|---|---|---|\n";
    for (const CheapestRow& cheapest_row : cheapest_rows(record))
      if (cheapest_row.row == nullptr)
        append_formatted(text, "| %s | %s | | | | |\n", cheapest_row.decades().c_str(), without_row(cheapest_row, record).c_str());
      else
        append_formatted(text, "| %s | `%s` | %.3g | %s | %.1e | %s |\n", cheapest_row.decades().c_str(), cheapest_row.row->method.c_str(),
                         *cheapest_row.row->cpu_ms_per_s, cheapest_row.row->setting.c_str(), *cheapest_row.row->relative_error,
                         describe(cheapest_row.row->work).c_str());
  }
  return text +
         "\n### References\n\n| problem | size | errors of | reference | half its precision changes it by | another method | differs by | "
         "half its precision changes it by | a difference of 1e-10 grows |\n|---|---|---|---|---|---|---|---|---|\n" +
         references;
}

}  // namespace hooke
