// Results of hard cases grouped by case and method, for the reports.
#pragma once

#include <string>
#include <vector>

#include "study/hard_cases/run_cases.h"

namespace hooke {

// Groups results; those of one case must be adjacent.
std::vector<std::span<const CaseResult>> by_case(std::span<const CaseResult> results);

// The methods that have results, in table order.
std::vector<const Integrator*> methods_of(std::span<const CaseResult> results);

// The result of a method within one case; a result independent of the method counts for all. Null: none.
const CaseResult* find_result(std::span<const CaseResult> group, const Integrator& method);

// The id of its method, or "any".
std::string_view id_of(const CaseResult& result);

// "27 results: 20 held, ..."
std::string summarize_counts(std::span<const CaseResult> results);

}  // namespace hooke
