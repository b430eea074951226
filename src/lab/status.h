// What the laboratory publishes once per frame for panels and tools: a Snapshot of the simulation and the state of everything around it.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "edit/command.h"
#include "edit/history_list.h"
#include "lab/accuracy/companion.h"
#include "lab/traces.h"
#include "scene/scene.h"
#include "sim/model/accuracy.h"
#include "sim/plan/phase_times.h"
#include "sim/step/snapshot.h"

namespace hooke {

// The parts of the scene that only edits change; the same object until the next edit.
struct DocumentStatus {
  std::string name, description, notes;
  ViewSettings view;
  ClothTexture cloth_texture;
  Defaults defaults;
  std::shared_ptr<const SheetWeights> sheet;  // null: there is no cloth
  ControlRanges controls;
  std::vector<Force> opened_forces;      // of the scene as it was opened
  std::vector<double> parameter_values;  // one for each row of parameters(); NaN: the row does not apply
};

struct RunStatus {
  bool running = false;
  std::array<double, phase_count> phase_ms{};  // of real time per simulated frame, smoothed
  double speed = 0.0;                          // simulated seconds per real second, measured; 0 while paused
  long frames = 0;                             // computed since the document was opened
  double from = 0.0, to = 0.0;                 // [s], of a run to a given time; both 0: none
  double hand_lag = 0.0;                       // [m], from the hand to its target because of its maximum speed
  double limit_power = 0.0, limit_work = 0.0;  // [W] now and [J] in total, of the strain limit on the scene
  std::size_t gas_releases = 0;                // surfaces filled with gas that tears have opened
  long crossings = 0;                          // as Motion, at the start of the last frame
  bool on_device = false;                      // a device was chosen
  std::string device_refusal;                  // why it does not compute the frames; empty: it does

  double ms(Phase phase) const { return phase_ms[static_cast<std::size_t>(phase)]; }
  double simulate_ms() const { return ms(Phase::Forces) + ms(Phase::Contact) + ms(Phase::Solve) + ms(Phase::Auto); }
};

struct HistoryStatus {
  bool unsaved = false;                     // edited since the document was opened or saved
  long edits = 0;                           // counts edits, undo and redo
  std::string undo_name, redo_name;         // "nail 3 points"; empty: nothing to undo
  std::shared_ptr<const HistoryList> list;  // never null
};

struct TimelineStatus {
  double start = 0.0, end = 0.0;             // [s], of the recorded states; equal: none but the current one
  std::shared_ptr<const TraceTable> traces;  // what the plots show
};

struct RecordingStatus {
  std::string file;                // being written; empty: none
  std::string error;               // why the last recording ended early; empty: it did not
  double playback_progress = 0.0;  // [1]; 0: no playback
  std::string difference;          // where a playback differs from its recording; empty: nowhere so far
};

// An edit shortly before a run diverged.
struct RecentChange {
  std::string text;              // "k: 185 -> 270,000 N/m", or its name in the history
  std::vector<Command> restore;  // sets what it changed back to what it was
};

// A run that diverged, from which remedies are tested on copies (study/remedy/remedy.h).
struct FailedRun {
  std::shared_ptr<const Scene> start;    // the scene as GoToStart leaves it
  std::shared_ptr<const System> system;  // at the failure
  std::shared_ptr<const State> before;   // a recorded state from before the energy grew; null: none
  Settings settings;
  double time = 0.0;                  // [s], of the failure
  std::vector<RecentChange> changes;  // since shortly before the energy was last explained, newest first
};

struct DiagnosisStatus {
  std::string message;              // why the run stopped; empty: nothing to report
  bool is_too_large = false;        // the network, for the method: nothing has diverged
  std::optional<FailedRun> failed;  // none: nothing to report, or the laboratory keeps no start
};

struct Status {
  std::shared_ptr<const Snapshot> snapshot;
  std::shared_ptr<const DocumentStatus> document;
  RunStatus run;
  HistoryStatus history;
  TimelineStatus timeline;
  Accuracy accuracy;
  RecordingStatus recording;
  DiagnosisStatus diagnosis;
  CompanionsStatus companions;
  std::uint32_t next_point_id = 0, next_spring_id = 0;  // ids from here on are unused
};

}  // namespace hooke
