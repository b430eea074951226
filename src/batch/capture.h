// Draws a scene as it moves, without a display: `hooke capture`, and `capture` of the Python module.
#pragma once

#include <functional>
#include <string>

#include "batch/capture_options.h"
#include "lab/lab.h"

namespace hooke {

struct CaptureResults {
  double seconds = 0.0;           // [s], from the first picture to the last, if nothing ended the run
  bool diverged = false;          // pictures end with the last valid frame
  bool interrupted = false;       // by Interrupted (batch/run_frames.h); pictures end with the last complete frame
  std::string error_limit;        // the first frame that exceeded the limit `fail_above`; empty: none
  std::string tolerance_warning;  // of the method `auto`; empty: it met its tolerance
};

// Draws the scene of the laboratory, which steps or replays a recording, from its present frame on. `length` [s] applies where the options
// give neither seconds nor frames. `progress` is called after every frame, and may throw. Throws UsageError, InputError,
// FileError.
CaptureResults capture_frames(Lab& lab, const CaptureOptions& options, double length,
                              const std::function<void(long done, long all)>& progress);

}  // namespace hooke
