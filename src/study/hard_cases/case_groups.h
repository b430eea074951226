// Results of hard cases by their cases and methods, as all reports show them.
#pragma once

#include <string>
#include <vector>

#include "study/hard_cases/run_cases.h"

namespace hooke {

// The results of one case stand one after another.
std::vector<std::span<const CaseResult>> by_case(std::span<const CaseResult> results);

// Those that there are results of, in the order of their table.
std::vector<const Integrator*> methods_of(std::span<const CaseResult> results);

// In the results of one case; that of no method's own is every method's. Null: none.
const CaseResult* find_result(std::span<const CaseResult> group, const Integrator& method);

// Of its method; "any".
std::string_view id_of(const CaseResult& result);

// "27 results: 20 held, ..."
std::string summarize_counts(std::span<const CaseResult> results);

}  // namespace hooke
