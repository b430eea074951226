#include "batch/bench_report.h"

#include <cmath>
#include <vector>

#include "base/formatted.h"

namespace hooke {
namespace {

// Consecutive decades of error with the same cheapest row; null if no row reaches them.
struct CheapestRow {
  int first = 1, last = 1;
  const Row* row = nullptr;
  std::string decades() const {
    std::string text = "1e-" + std::to_string(first);
    return last > first ? text + " .. 1e-" + std::to_string(last) : text;
  }
};

std::vector<CheapestRow> cheapest_rows(const ProblemRecord& record) {
  std::vector<CheapestRow> list;
  for (int decade = 1; decade <= 10; ++decade) {
    const Row* row = cheapest(record, std::pow(10.0, -decade));
    if (!list.empty() && list.back().row == row)
      list.back().last = decade;
    else
      list.push_back({decade, decade, row});
  }
  return list;
}

std::string describe(const ReferenceRecord& reference) {
  std::string text;
  if (reference.measure == Measure::Observables)
    text += "Errors are those of the center of mass, the largest strain and the energy, because the trajectory is not reproducible. ";
  append_formatted(text, "Reference: %s at %s; half the precision changes it by %.0e%s. ", reference.method.c_str(),
                   reference.setting.c_str(), reference.own_gap,
                   reference.own_gap == 0.0 ? " (stability limits its steps, not the tolerance)" : "");
  append_formatted(text, "%s at %s differs by %.0e; half its precision changes it by %.0e. ", reference.other_method.c_str(),
                   reference.other_setting.c_str(), reference.other_gap, reference.other_own_gap);
  append_formatted(text, "A perturbation of 1e-10 is amplified %.2g times.", reference.amplification);
  return text;
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
  append_formatted(text, "%s: %s (%d points, %d springs, %g s)\n", record.id.c_str(), record.title.c_str(), record.points, record.springs,
                   record.seconds);
  if (!record.reference) return text + "  no reference, nothing measured\n";
  text += "  " + describe(*record.reference) + "\n";
  for (const CheapestRow& cheapest_row : cheapest_rows(record))
    if (cheapest_row.row == nullptr)
      append_formatted(text, "  %-14s  not reached\n", cheapest_row.decades().c_str());
    else
      append_formatted(text, "  %-14s  %-18s %10.3g ms/s   %s\n", cheapest_row.decades().c_str(), cheapest_row.row->method.c_str(),
                       *cheapest_row.row->cpu_ms_per_s, cheapest_row.row->setting.c_str());
  return text;
}

std::string markdown_report(const Results& results) {
  const Conditions& conditions = results.conditions;
  std::string text;
  append_formatted(text, "Measured %s with hooke %s, %s effort, one thread of: %s. ", results.date.c_str(), conditions.version.c_str(),
                   conditions.effort.c_str(), conditions.machine.c_str());
  text +=
      "Errors are relative to the size of the scene; the cost is in CPU milliseconds per simulated second, the minimum of several runs.\n";
  for (const ProblemRecord& record : results.problems) {
    append_formatted(text, "\n### %s: %s\n\n%d points, %d springs, %g s. ", record.id.c_str(), record.title.c_str(), record.points,
                     record.springs, record.seconds);
    if (!record.reference) {
      text += "No reference: nothing measured.\n";
      continue;
    }
    text += describe(*record.reference) +
            "\n\n| error at most | cheapest method | cost [ms/s] | setting | error | work |\n"
            "|---|---|---|---|---|---|\n";
    for (const CheapestRow& cheapest_row : cheapest_rows(record))
      if (cheapest_row.row == nullptr)
        append_formatted(text, "| %s | not reached | | | | |\n", cheapest_row.decades().c_str());
      else
        append_formatted(text, "| %s | `%s` | %.3g | %s | %.1e | %s |\n", cheapest_row.decades().c_str(), cheapest_row.row->method.c_str(),
                         *cheapest_row.row->cpu_ms_per_s, cheapest_row.row->setting.c_str(), *cheapest_row.row->relative_error,
                         describe(cheapest_row.row->work).c_str());
  }
  return text;
}

}  // namespace hooke
