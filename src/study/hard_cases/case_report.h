// The results of hard cases as text for a terminal, as JSON and as Markdown.
#pragma once

#include <string>

#include "study/hard_cases/run_cases.h"

namespace hooke {

// [characters], of a terminal
inline constexpr std::size_t table_width = 100;

// One line per case with a mark for each method, unexpected results in full, and the counts; if there are few results, all in full. Lines
// end in a newline and have at most table_width characters, unless a word is longer.
std::string format_table(std::span<const CaseResult> results);

// {"cases": [{"number", "name", "parameters", "criterion", "remark", "results": [{"method", "outcome", "expected", "broken", "measured",
// "reason", "cpu_seconds"}]}], "broken", "unfinished"}, without unfinished results.
std::string format_json(std::span<const CaseResult> results);

// The origin of a document, as stated in it.
struct Origin {
  std::string command, date, machine;
};

// The tables of docs/evidence/stability.md: the result of each method in each case, and what the cases are.
std::string format_markdown(std::span<const CaseResult> results, const Origin& origin);

}  // namespace hooke
