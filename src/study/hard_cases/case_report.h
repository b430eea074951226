// The results of hard cases, for a terminal, for machines and for people.
#pragma once

#include <string>

#include "study/hard_cases/run_cases.h"

namespace hooke {

// Of a terminal.
inline constexpr std::size_t table_width = 100;

// A line a case with a mark for each method, what broke in full, and the count; of a few results all in full. Lines end in a
// newline and hold table_width characters at most.
std::string format_table(std::span<const CaseResult> results);

// {"cases": [{"number", "name", "parameters", "criterion", "remark", "results": [{"method", "outcome", "expected", "broken",
// "measured", "reason", "cpu_seconds"}]}], "broken", "unfinished"}: what is not finished is not in the list. A case with a
// table of its own has "columns", its results have "rows".
std::string format_json(std::span<const CaseResult> results);

// What made a document, as it says itself.
struct Origin {
  std::string command, date, machine;
};

// docs/stability.md. Times stand in the cases' own tables alone.
std::string format_markdown(std::span<const CaseResult> results, const Origin& origin);

}  // namespace hooke
