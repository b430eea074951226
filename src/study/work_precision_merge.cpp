#include "study/work_precision_merge.h"

#include <algorithm>

#include "sim/integrator.h"

namespace hooke {
namespace {

void add(ProblemRecord& record, const ProblemRecord& part) {
  if (!record.reference) record.reference = part.reference;
  for (const Row& row : part.rows) {
    const bool is_known =
        std::ranges::any_of(record.rows, [&](const Row& other) { return other.method == row.method && other.setting == row.setting; });
    if (!is_known) record.rows.push_back(row);
  }
}

// Rows of a method stay in their order, coarsest first.
void sort_rows(ProblemRecord& record) {
  const auto place = [](const Row& row) {
    const auto table = integrators();
    return std::find_if(table.begin(), table.end(), [&](const Integrator& method) { return method.id == row.method; }) - table.begin();
  };
  std::ranges::stable_sort(record.rows, {}, place);
}

// Built-in problems come in the order of their table, others after them in the order of the files.
std::size_t place_of(const ProblemRecord& record) {
  const auto table = built_in_problems();
  return static_cast<std::size_t>(std::ranges::find(table, record.id, &BuiltInProblem::id) - table.begin());
}

}  // namespace

Results merge_results(const std::vector<std::pair<std::string, Results>>& parts) {
  Results merged;
  for (const auto& [name, part] : parts) {
    if (&part == &parts.front().second) merged.conditions = part.conditions;
    if (part.conditions != merged.conditions)
      throw InputError(name + ": measured with another build, machine or effort than " + parts.front().first);
    merged.date = std::max(merged.date, part.date);
    for (const ProblemRecord& problem : part.problems) {
      const auto known = std::ranges::find(merged.problems, problem.id, &ProblemRecord::id);
      if (known == merged.problems.end()) {
        merged.problems.push_back(problem);
        continue;
      }
      if (known->fingerprint != problem.fingerprint) throw InputError(name + ": " + problem.id + ": another scene of the same name");
      add(*known, problem);
    }
  }
  for (ProblemRecord& record : merged.problems) sort_rows(record);
  std::ranges::stable_sort(merged.problems, {}, place_of);
  return merged;
}

}  // namespace hooke
