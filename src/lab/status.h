// What the laboratory shows of itself, published once a frame beside the Snapshot; read by panels, never written.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edit/history_list.h"
#include "lab/traces.h"
#include "scene/diagnosis.h"
#include "scene/scene.h"
#include "sim/snapshot.h"

namespace hooke {

struct Status {
  std::shared_ptr<const Snapshot> snapshot;
  std::string scene_name, scene_description;
  ViewSettings view;
  ClothTexture cloth_texture;
  Defaults defaults;
  std::shared_ptr<const SheetWeights> sheet;  // null: there is no cloth
  ControlRanges controls;
  std::vector<double> parameter_values;        // one a row of parameters(); NaN: the row does not apply
  double hand_lag = 0.0;                       // [m], of the hand behind the cursor, by its top speed; 0: it keeps up
  double limit_power = 0.0, limit_work = 0.0;  // [W], [J]: what the strain limit does to the scene now, and did in all
  bool running = false;
  bool unsaved = false;                                 // edited since it was opened or saved
  long edits = 0;                                       // made, taken back and made again, ever: tells whether there was one since
  std::string undo_name, redo_name;                     // "nail 3 points"; empty: nothing to undo
  std::shared_ptr<const HistoryList> history;           // never null
  std::string message;                                  // why the run stopped, and what would hold; empty: nothing to say
  std::optional<Advice> advice;                         // what would hold, to be applied by a click
  double simulate_ms = 0.0;                             // of real time per simulated frame, smoothed
  double speed = 0.0;                                   // simulated against real seconds, measured; 0 while paused
  std::uint32_t next_point_id = 0, next_spring_id = 0;  // ids from here on are free
  long frames = 0;                                      // stepped since the document was opened
  double timeline_start = 0.0, timeline_end = 0.0;      // [s], of the frames that one can go back to; the same: none but this
  std::shared_ptr<const TraceTable> traces;             // what the plots show
  double run_to = 0.0;                                  // [s], where a run to a time ends, from `run_from`; both 0: none
  double run_from = 0.0;
  std::string recording;           // the file that what is done is recorded in; empty: none
  std::string recording_error;     // why the last recording ended early, in one line; empty: it did not
  double playback_progress = 0.0;  // how much of a recording has been played, to 1; 0: none is playing
  std::string difference;          // where a recording came out otherwise than recorded; empty: nowhere so far
};

}  // namespace hooke
