// What `hooke check` runs by default, and its choices.
#pragma once

#include <string>
#include <vector>

#include "study/hard_cases/run_cases.h"

namespace hooke {

// The ids of all shipped scenes. Throws FileError if there are none.
std::vector<std::string> shipped_scene_ids();

// The hard cases with these numbers; all if there are none. Throws UsageError.
std::vector<const HardCase*> chosen_cases(const std::vector<int>& numbers);

// The methods with these ids; if there are none all, with `auto` unless only the quick cases run: its error estimates take longer than
// they do. Throws UsageError.
std::vector<const Integrator*> methods_for_cases(const std::vector<std::string>& ids, bool quick);

// One per core.
int default_threads();

}  // namespace hooke
