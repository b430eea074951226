// The laboratory without a screen: a scene, its clock and its history. It queues commands, applies them between substeps, steps in real
// time, detects divergence and publishes a Status with a Snapshot.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "edit/command.h"
#include "edit/history.h"
#include "lab/accuracy/companions.h"
#include "lab/controls.h"
#include "lab/failure.h"
#include "lab/frame_history.h"
#include "lab/lab_parts.h"
#include "lab/playback.h"
#include "lab/recorder.h"
#include "lab/run_clock.h"
#include "lab/start.h"
#include "lab/status.h"

namespace hooke {

// Whether a copy of the opened scene is kept for GoToStart. A long run of a large scene does not need one; its accuracy is measured only
// on demand, and then at once, also while a recording is played.
enum class KeepStart { Yes, No };

class Lab {
 public:
  // Without a start there is no GoToStart, no timeline, and no status before the first `publish`.
  explicit Lab(Scene scene, KeepStart keep = KeepStart::Yes);

  // `name`: of the step in the history; without one the command's own.
  void submit(Command command, Gesture gesture = 0, std::string name = {});
  void submit(Control control, Gesture gesture = 0);

  // On what and in which precision frames are computed, from the next one on.
  void set_execution(Execution execution);

  // Applies the queue, then computes as many frames as `real_seconds` at the speed of the scene require, until `should_continue` returns
  // false (called between substeps; the next call continues an unfinished frame). Frames that cannot be computed in time are skipped, so
  // that a slow scene runs slower.
  void advance(double real_seconds, const std::function<bool()>& should_continue);

  // Applies the queue and publishes, without computing anything: what is due is left to `advance`.
  void show_edits(double real_seconds);
  // Whether edits wait for the end of the frame in progress, so that a stream of them does not stop the clock.
  bool must_wait_for_frame() const;

  // Real time until the next frame is due while running; zero for a frame in progress.
  std::chrono::duration<double> time_to_next_frame() const;

  // Applies the queue and computes exactly one frame. False if it diverged: the state is that of the previous frame.
  bool step();

  // Called after every substep of `step`. What it throws passes through `step`, and discards the frame.
  void watch_substeps(std::function<void()> after_substep) { frame_.after_substep = std::move(after_substep); }

  // Continues to measure the accuracy of the frames computed so far, until it is done or `should_continue` returns false.
  void measure_accuracy(const std::function<bool()>& should_continue);
  bool has_accuracy_to_measure() const { return measuring_.meter.is_repeating() || measuring_.meter.has_work(); }
  // Whether `advance` has companions to compute, even while paused.
  bool has_companions_to_compute() const { return companions_.has_work(); }
  Accuracy accuracy() const;
  // Of the frames computed again to measure it, where that is done at once.
  double accuracy_cpu_seconds() const { return measuring_.cpu_seconds; }

  // Whether submitted commands wait for the frame in progress; applies them without waiting.
  bool has_pending() const { return !queue_.empty(); }
  void apply_pending() { apply_queue(); }

  // The last published status. `advance` publishes; after `step`, the caller may.
  const std::shared_ptr<const Status>& status() const { return published_.status; }
  void publish();
  const Scene& scene() const { return scene_; }
  const Energy& energy() const { return energy_; }
  // The scene as GoToStart would leave it; as it is now if no start is kept.
  Scene scene_at_start();

  // Why the processor computes the frames although a device is set; empty: it does not, or none is.
  std::string device_refusal() const;
  // The scene compiled for stepping, as of the last frame or edit.
  const Plan& plan() const { return plan_; }

  // Ids for the points and springs of an Insert.
  PointId new_point_id() { return scene_.system.new_point_id(); }
  SpringId new_spring_id() { return scene_.system.new_spring_id(); }

  // Whether a recording is being played, and where the playback differs from it: "frame 12, at 0.2 s: point 5 is not where recorded".
  bool is_playing() const { return playback_.is_on(); }
  const std::string& difference() const { return playback_.difference(); }

  // [s], the times of the frames in which tears opened surfaces filled with gas, one for each surface.
  const std::vector<double>& gas_releases() const { return tallies_.gas_releases; }

  // The last frame, for `run --json`.
  const FrameRunner& last_frame() const { return frame_.runner; }

 private:
  void apply_queue();
  void check_divergence();
  void resolve_divergence();
  void handle(const Control& control, Gesture gesture);
  void go_to_history_step(std::size_t done);
  void set_running(bool running);
  void run_to(double time, Gesture gesture);
  void go_to_start();
  void set_start();
  void reset_parameters();
  void release_nails();
  void record(const Record& what);
  void play(const Play& what);
  // `name`: in the history; without one the command's own.
  void edit(const Command& command, Gesture gesture, const std::string& name = {}, std::optional<History::Of> known = {});
  bool is_at_start() const;
  History::Of changed_by(const Command& command) const;
  std::shared_ptr<const State> state_before_drag(const Command& command, Gesture gesture, History::Of of);
  static void return_to_state(const std::shared_ptr<const State>& state, std::vector<Command>& inverse);
  void update_plan(Effect effect);
  void rebuild_plan();
  void open(std::shared_ptr<const Scene> scene);
  void reset_session();
  void add_to_timeline(bool continues);
  void go_to_timeline_index(std::size_t moment, Gesture gesture);
  void play_edits();
  void check_played_frame();
  void begin_frame();
  bool finish_frame();
  bool step_frame();
  void meter_frame(double energy);
  void pass_edit_to_meter(const Effect& effect, Settings settings);
  Energy energy_after_frame() const;
  std::optional<Insert> tear();
  void record_tear(Insert pieces);
  void drop_frame(bool restores_springs = true);
  bool compute_companions(const std::function<bool()>& should_continue);
  void record_edit(const Command& command);
  void record_held_edits();
  double hand_lag() const;
  const std::shared_ptr<const System>& published_system();
  const std::shared_ptr<const DocumentStatus>& published_document();
  std::shared_ptr<const Snapshot> snapshot();
  RunStatus run_status() const;
  TimelineStatus timeline_status() const;

  Scene scene_;
  Start start_;
  std::vector<Queued> queue_;
  History history_;
  FrameHistory frame_history_;
  Recorder recorder_;
  Playback playback_;
  RunClock clock_;
  Metering measuring_;
  Companions companions_;
  Plan plan_;
  FrameProgress frame_;
  Energy energy_;  // of the scene
  Failure failure_;
  DragState drag_;
  RunTallies tallies_;
  PublishedCopies published_;
};

}  // namespace hooke
