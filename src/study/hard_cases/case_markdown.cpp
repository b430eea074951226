#include "study/hard_cases/case_groups.h"
#include "study/hard_cases/case_report.h"

namespace hooke {
namespace {

std::string_view outcome_label(const CaseResult* result) {
  if (result == nullptr || !result->finished) return "";
  if (is_broken(result->verdict)) return "**unexpected**";
  switch (result->verdict.outcome) {
    case Outcome::Held:
      return "held";
    case Outcome::FailedOpenly:
      return "*open*";
    case Outcome::FailedSilently:
      return "**silent**";
    case Outcome::OutOfScope:
      return "-";
  }
  return {};
}

std::string format_overview(std::span<const CaseResult> results) {
  const std::vector<const Integrator*> methods = methods_of(results);
  std::string head = "| case |", rule = "|---|";
  for (const Integrator* method : methods) {
    head += " " + std::string(method->id) + " |";
    rule += "---|";
  }
  std::string rows;
  for (const auto& group : by_case(results)) {
    rows += "| " + std::to_string(group[0].hard_case->number) + " " + std::string(group[0].hard_case->name) + " |";
    for (const Integrator* method : methods) rows += " " + std::string(outcome_label(find_result(group, *method))) + " |";
    rows += "\n";
  }
  return "\n" + head + "\n" + rule + "\n" + rows + "\n" + summarize_counts(results) + ".\n";
}

// One row for each case: its scene, and the criterion with which it counts as held.
std::string format_cases(std::span<const CaseResult> results) {
  std::string table = "\n| case | scene | held if | remark |\n|---|---|---|---|\n";
  for (const auto& group : by_case(results)) {
    const HardCase& hard_case = *group[0].hard_case;
    table += "| " + std::to_string(hard_case.number) + " | " + std::string(hard_case.parameters) + " | " +
             std::string(hard_case.criterion) + " | " + std::string(hard_case.remark) + " |\n";
  }
  return table;
}

}  // namespace

std::string format_markdown(std::span<const CaseResult> results, const Origin& origin) {
  return "Measured on " + origin.date + ", on one " + origin.machine + ", with `" + origin.command + "`.\n" + format_overview(results) +
         format_cases(results);
}

}  // namespace hooke
