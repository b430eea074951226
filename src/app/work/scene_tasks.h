// What is computed in the background about the present state of the scene on screen.
#pragma once

#include <vector>

#include "app/work/result_task.h"

namespace hooke {

void start_comparison(ResultTask<MethodComparison>& task, const Status& status);
// `forecast`: of the scene, whose equilibrium is an initial guess.
void start_result_check(ResultTask<ResultCheck>& task, const Status& status, const Forecast& forecast);
void start_stretch(ResultTask<StretchBreakdown>& task, const Status& status, const std::vector<SpringId>& springs);

}  // namespace hooke
