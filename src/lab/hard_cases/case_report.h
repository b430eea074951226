// The results of hard cases, for a terminal, for machines and for people.
#pragma once

#include <string>

#include "lab/hard_cases/run_cases.h"

namespace hooke {

// A line a case with a mark for each method, what broke in full, and the count; lines end in a newline.
std::string format_table(std::span<const CaseResult> results);

std::string format_json(std::span<const CaseResult> results);

// docs/stability.md. Without times, so that it comes out the same on every machine.
std::string format_markdown(std::span<const CaseResult> results);

}  // namespace hooke
