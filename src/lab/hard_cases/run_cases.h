// Runs hard cases over methods, on several threads.
#pragma once

#include <functional>
#include <vector>

#include "lab/hard_cases/hard_case.h"

namespace hooke {

struct CaseResult {
  const HardCase* hard_case = nullptr;
  const Integrator* method = nullptr;  // null where no method is concerned
  Verdict verdict;
  double cpu_seconds = 0.0;
};

// Every case with every method that it concerns, in this order whatever the threads. A case that throws failed in
// silence. `on_done` is told how many of how many are done, from the calling thread.
std::vector<CaseResult> run_cases(std::span<const HardCase* const> cases, std::span<const Integrator* const> methods, int threads,
                                  const std::function<void(long done, long all)>& on_done);

int count_broken(std::span<const CaseResult> results);

}  // namespace hooke
