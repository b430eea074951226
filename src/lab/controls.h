// Requests to the laboratory itself; queued with the commands, in order.
#pragma once

#include <filesystem>
#include <memory>
#include <variant>
#include <vector>

#include "lab/accuracy/companion.h"
#include "lab/traces.h"
#include "scene/scene.h"

namespace hooke {

struct Recording;
class FrameDevice;

struct Undo {};
struct Redo {};
struct GoToHistoryStep {  // undoes or redoes until `done` steps are in effect
  std::size_t done;
};
struct SetRunning {
  bool running;
};
struct StepOnce {};  // one frame, while paused
struct RunTo {       // as fast as possible, until the scene's clock reaches `time`
  double time;
};
struct StepBack {};  // to the previous recorded state; pauses
struct GoToTime {    // to the last recorded state at this time or before; pauses
  double time;
};
struct Watch {  // sets the quantities measured in every frame, for the plots
  std::vector<Quantity> quantities;
};
// What is measured of the accuracy of the run.
enum class AccuracyMode {
  Off,
  Frame,  // the error of a frame, a tenth of the cost of the run, and the energy balance, half of it where there are dashpots
  Full,   // and the second runs: about two and a half times the cost of the run
};
struct SetAccuracy {
  AccuracyMode mode;
};
struct SetCompanions {  // runs beside the run, from its present state on; empty: none
  std::vector<Companion> companions;
};
struct GoToStart {};        // positions, velocities, tears and time of the start; edits of structure and parameters stay
struct SetStart {};         // the current state becomes the start
struct ResetParameters {};  // parameters, method and forces as they were when the document was opened
struct ReleaseNails {};     // all of them, until the scene goes back to its start
struct Open {               // another document, with an empty history
  std::shared_ptr<const Scene> scene;
  bool unsaved = false;  // it contains unsaved changes
};
struct MarkSaved {};
struct SetDevice {  // computes the frames of scenes that it does not refuse; null: the processor computes all
  std::shared_ptr<FrameDevice> device;
};
struct Record {                                       // starts a recording; an earlier one ends
  std::shared_ptr<const std::filesystem::path> file;  // null: only ends it
};
struct Play {  // opens the start of a recording and replays it, until its end or the next edit
  std::shared_ptr<const Recording> recording;
};
using ControlVariant = std::variant<Undo, Redo, GoToHistoryStep, SetRunning, StepOnce, RunTo, StepBack, GoToTime, Watch, SetAccuracy,
                                    SetCompanions, GoToStart, SetStart, ResetParameters, ReleaseNails, Open, MarkSaved, SetDevice, Record, Play>;
// Copies are compiled once, in lab_controls.cpp.
struct Control : ControlVariant {
  using ControlVariant::ControlVariant;
  Control(const Control&);
  Control(Control&&) noexcept;
  Control& operator=(const Control&);
  Control& operator=(Control&&) noexcept;
  ~Control();
};

}  // namespace hooke
