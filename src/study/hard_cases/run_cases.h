// Runs hard cases over methods, on several threads.
#pragma once

#include <functional>
#include <vector>

#include "study/hard_cases/hard_case.h"

namespace hooke {

struct CaseResult {
  const HardCase* hard_case = nullptr;
  const Integrator* method = nullptr;
  bool finished = false;
  Verdict verdict;
  double cpu_seconds = 0.0;
};

// Every case with every method, not yet run; only the quick ones for the quick subset.
std::vector<CaseResult> list_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, bool quick);

// Runs the cases. The verdicts do not depend on the threads; a case that throws has failed silently. `should_continue` receives the number
// of finished cases and the total, on the calling thread; if it returns false, unfinished cases stay unfinished.
void run_cases(std::span<CaseResult> results, int threads, const std::function<bool(long done, long all)>& should_continue);

int count_broken(std::span<const CaseResult> results);

}  // namespace hooke
