// The parts of a laboratory that have no behavior of their own.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "edit/command.h"
#include "edit/history.h"
#include "lab/accuracy/accuracy_meter.h"
#include "lab/status.h"

namespace hooke {

class FrameDevice;

// The frame that is being computed.
struct FrameProgress {
  bool in_frame = false;
  bool must_finish = false;         // an edit discarded the previous frame
  std::vector<Command> held_edits;  // applied while a frame that they do not affect is in progress; recorded after it
  State end;                        // result of the frame
  // Computes the frames of scenes that it does not refuse; null: the processor computes all.
  std::shared_ptr<FrameDevice> device;
};

// What is measured of the run.
struct Metering {
  AccuracyMeter meter;
  bool at_once = false;  // the accuracy of a frame, before the next one
  double cpu_seconds = 0.0;
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
