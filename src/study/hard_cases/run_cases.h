// Runs hard cases over methods, on several threads.
#pragma once

#include <functional>
#include <vector>

#include "study/hard_cases/hard_case.h"

namespace hooke {

struct CaseResult {
  const HardCase* hard_case = nullptr;
  const Integrator* method = nullptr;  // null where no method is concerned
  bool finished = false;
  Verdict verdict;
  double cpu_seconds = 0.0;
};

// Every case with every method that it concerns, yet to be run; in the quick subset only what is quick.
std::vector<CaseResult> list_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, bool quick);

// Runs them. The verdicts do not depend on the threads; a case that throws failed in silence. `should_continue` is told how many
// of how many are done, from the calling thread; when it says no, what is not finished stays so.
void run_cases(std::span<CaseResult> results, int threads, const std::function<bool(long done, long all)>& should_continue);

int count_broken(std::span<const CaseResult> results);

}  // namespace hooke
