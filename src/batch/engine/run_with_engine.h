// Runs a scene with LAMMPS, on any number of ranks: `hooke run --engine`.
#pragma once

#include <functional>
#include <string>

#include "batch/run_frames.h"

namespace hooke {

struct EngineRequest {
  std::string command;  // "mpirun -np 8 lmp"; words are separated by blanks, no shell interprets them
  std::string scene;    // its name in messages
  RunRequest run;       // without measuring the accuracy
};

struct EngineResults {
  RunTotals totals;        // the CPU time is that of all processes of the engine on this machine
  std::string divergence;  // why the run diverged, in one line; empty: it did not
  bool is_stopped = false;
};

// Runs the scene from its present state. The engine computes all frames first; then the scene gets those that are needed, one after the
// other: the samples, and with `hooks.frame` every one. `hooks.progress` is called while the engine runs. `should_continue` is called
// several times a second; false ends the engine with all its processes. Throws UsageError, InputError for what the engine cannot represent,
// and FileError if it cannot be started or fails.
EngineResults run_with_engine(Scene& scene, const EngineRequest& request, const RunHooks& hooks,
                              const std::function<bool()>& should_continue);

}  // namespace hooke
