#include "study/work_precision_merge.h"

#include <algorithm>
#include <utility>

#include "sim/methods/integrator.h"

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

void add_parts(std::vector<PartRecord>& known, const std::vector<PartRecord>& parts) {
  for (const PartRecord& part : parts) {
    const auto same = std::ranges::find_if(known, [&](const PartRecord& other) { return other.is_same(part); });
    if (same == known.end())
      known.push_back(part);
    else
      same->is_complete = same->is_complete || part.is_complete;
  }
}

// A division of the same scenes and methods into so many parts.
struct Division {
  enum class Part : char { Missing, Begun, Complete };
  std::string of;
  std::vector<Part> parts;
  bool is_complete() const { return std::ranges::count(parts, Part::Complete) == std::ssize(parts); }
};

std::vector<Division> divisions_of(const std::vector<PartRecord>& parts) {
  std::vector<Division> divisions;
  for (const PartRecord& part : parts) {
    const auto is_of = [&](const Division& division) { return division.of == part.of && division.parts.size() == part.count; };
    auto known = std::ranges::find_if(divisions, is_of);
    if (known == divisions.end()) known = divisions.insert(known, {part.of, std::vector(part.count, Division::Part::Missing)});
    known->parts[part.number - 1] = part.is_complete ? Division::Part::Complete : Division::Part::Begun;
  }
  return divisions;
}

// Of scenes and methods that were divided in several ways, one that is complete is enough.
std::string describe_missing(const std::vector<PartRecord>& parts) {
  constexpr std::size_t max_listed = 10;
  const std::vector<Division> divisions = divisions_of(parts);
  std::string text;
  std::size_t listed = 0, others = 0;
  for (const Division& division : divisions) {
    const auto is_done = [&](const Division& other) { return other.of == division.of && other.is_complete(); };
    if (std::ranges::any_of(divisions, is_done)) continue;
    for (std::size_t i = 0; i < division.parts.size(); ++i) {
      if (division.parts[i] == Division::Part::Complete || (listed >= max_listed && ++others > 0)) continue;
      text += (listed++ > 0 ? ", shard " : "shard ") + std::to_string(i + 1) + '/' + std::to_string(division.parts.size()) +
              (division.parts[i] == Division::Part::Begun ? " is not finished" : " is missing");
    }
  }
  return others == 0 ? text : text + ", and " + std::to_string(others) + " more";
}

}  // namespace

MergedResults merge_results(const std::vector<std::pair<std::string, Results>>& parts) {
  Results merged;
  std::string unknown;
  for (const auto& [name, part] : parts) {
    if (&part == &parts.front().second) merged.conditions = part.conditions;
    if (part.conditions != merged.conditions)
      throw InputError(name + ": measured with another build, machine or effort than " + parts.front().first);
    merged.date = std::max(merged.date, part.date);
    if (part.parts.empty()) unknown = name + " does not say which shard it is";
    add_parts(merged.parts, part.parts);
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
  std::string missing = unknown.empty() ? describe_missing(merged.parts) : unknown;
  return {std::move(merged), std::move(missing)};
}

}  // namespace hooke
