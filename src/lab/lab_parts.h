// The parts of a laboratory that have no behavior of their own.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "edit/command.h"
#include "edit/history.h"
#include "lab/accuracy/accuracy_meter.h"
#include "lab/controls.h"
#include "lab/status.h"
#include "sim/control/frame_runner.h"
#include "sim/plan/phase_times.h"

namespace hooke {

class FrameDevice;

// From this number of points on, memory counts more than the time that it takes to allocate it again: a laboratory without a start, and the
// monitor of a run, keep nothing between frames that can be computed again.
inline constexpr std::size_t min_points_of_large_run = 100'000;

// What was submitted and is not applied yet.
struct Queued {
  std::variant<Command, Control> what;
  Gesture gesture = 0;
  std::string name{};  // of the step in the history
};

// The frame that is being computed.
struct FrameProgress {
  bool is_in_progress = false;
  bool must_finish = false;         // an edit discarded the previous frame
  std::vector<Command> held_edits;  // applied while a frame that they do not affect is in progress; recorded after it
  State end;                        // result of the frame
  FrameRunner runner;
  std::function<void()> after_substep;  // null: nothing is called
  // Computes the frames of scenes that it does not refuse; null: the processor computes all.
  std::shared_ptr<FrameDevice> device;
};

// What is measured of the run.
struct Metering {
  AccuracyMeter meter;
  bool at_once = false;  // the accuracy of a frame, before the next one
  double cpu_seconds = 0.0;
  PhaseTimes times{.clock = [] { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }};
  std::array<double, phase_count> phase_ms{};  // of a frame, smoothed

  void end_frame() {
    constexpr double weight = 0.1;  // of the newest frame
    for (std::size_t i = 0; i < phase_count; ++i) {
      const double ms = 1e3 * std::exchange(times.seconds[i], 0.0);
      phase_ms[i] += (phase_ms[i] == 0.0 ? 1.0 : weight) * (ms - phase_ms[i]);
    }
  }
};

// Drags in a run.
struct DragState {
  Gesture grab = 0;                     // of the last grab: tears during it are undone with it
  Gesture gesture = 0;                  // of the last drag in a run
  std::shared_ptr<const State> before;  // the state before it; null: none
  double lag = 0.0;                     // [m], of the hand behind its target
};

// Counts and sums since the start of the run; edits since the laboratory began.
struct RunTallies {
  long frames = 0, edits = 0;
  double limit_work = 0.0, last_limit_work = 0.0;  // [J], of the strain limit since the start, and in the last frame
  std::vector<double> gas_releases;
};

// Copies for readers; null: none yet.
struct PublishedCopies {
  std::shared_ptr<const System> system;
  std::shared_ptr<const DocumentStatus> document;
  std::uint64_t system_revision = 0, document_revision = 0;
  std::shared_ptr<const Status> status;
};

}  // namespace hooke
