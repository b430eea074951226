// Handling of controls: documents, undo, the timeline, recordings.
#include "base/overloaded.h"
#include "lab/lab.h"

namespace hooke {

void Lab::open(std::shared_ptr<const Scene> scene) {
  start_ = std::move(scene);
  scene_ = *start_;
  reset_session();
  // until the first edit, readers share the System of the start, which avoids a copy
  published_system_ = std::shared_ptr<const System>(start_, &start_->system);
  published_system_revision_ = scene_.revision;
}

// Resets everything for the scene that was just opened.
void Lab::reset_session() {
  scene_.state.ledger = {};
  held_edits_.clear();
  published_system_.reset();
  published_document_.reset();
  must_finish_frame_ = false;
  history_.clear();
  divergence_.reset();
  running_ = unsaved_ = edited_ = false;
  playback_.stop();
  playback_.clear_difference();
  run_to_.reset();
  frame_history_.clear();
  meter_.restart();
  frame_pacer_.reset();
  simulate_ms_ = 0.0;
  frames_ = 0;
  limit_work_ = last_limit_work_ = hand_lag_ = 0.0;
  update_plan({.structure = true});
  initialize_ledger(scene_.system, scene_.state);
}

// Edits made before the first frame belong to the start.
void Lab::keep_start() {
  if (start_ && edited_ && scene_.state.time == start_->state.time) start_ = std::make_shared<const Scene>(scene_);
  edited_ = false;
}

void Lab::go_to_timeline_index(std::size_t moment, Gesture gesture) {
  running_ = false;
  run_to_.reset();
  playback_.stop();
  const auto state = frame_history_.timeline().at(moment);
  if (state->time != scene_.state.time) edit(GoToState{state}, gesture);
}

void Lab::handle(const Control& control, Gesture gesture) {
  const auto go_to_history_step = [this](std::size_t done) {
    if (done == history_.done() || done > history_.done() + history_.undone()) return;
    playback_.stop();
    drop_frame();
    const double before = compute_energy(scene_.system, scene_.state).total();
    update_plan(history_.go_to(done, scene_));
    record_edit_energy(scene_.system, before, scene_.state);
    recorder_.record_scene(scene_);
    meter_.restart();
    check_divergence();
    unsaved_ = edited_ = true;
    ++edits_;
  };
  std::visit(Overloaded{
                 [&](const Undo&) { go_to_history_step(history_.done() - 1); },
                 [&](const Redo&) { go_to_history_step(history_.done() + 1); },
                 [&](const GoToHistoryStep& go) { go_to_history_step(go.done); },
                 [&](const SetRunning& set) {
                   running_ = set.running;
                   run_to_.reset();
                   frame_pacer_.reset();
                   drop_frame();
                   if (running_) divergence_.reset();
                 },
                 [&](const StepOnce&) {
                   running_ = false;
                   drop_frame();
                   step_frame();
                 },
                 [&](const RunTo& run) {
                   if (!(run.time > scene_.state.time)) return;
                   run_to_ = run.time;
                   run_from_ = scene_.state.time;
                   running_ = true;
                   divergence_.reset();
                 },
                 [&](const StepBack&) {
                   if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.step_back_from(scene_.state.time), 0);
                 },
                 [&](const Watch& watch) { frame_history_.watch(watch.quantities, scene_.system); },
                 [&](const SetAccuracy& set) { meter_.set_mode(set.mode); },
                 [&](const GoToTime& go) {
                   if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.timeline().find(go.time), gesture);
                 },
                 [&](const GoToStart&) {
                   if (!start_) return;
                   playback_.stop();
                   Scene start = *start_;
                   start.settings = scene_.settings;
                   edit(Replace{std::make_shared<const Scene>(std::move(start))}, 0);
                   limit_work_ = 0.0;
                   running_ = running_ && !divergence_;
                 },
                 [&](const Open& open_scene) {
                   open(open_scene.scene);
                   unsaved_ = open_scene.unsaved;
                 },
                 [&](const MarkSaved&) {
                   unsaved_ = false;
                   keep_start();
                 },
                 [&](const Record& what) {
                   drop_frame();
                   if (what.file)
                     recorder_.start(*what.file, scene_);
                   else
                     recorder_.stop();
                 },
                 [&](const Play& play) {
                   open(play.recording->start);
                   scene_.state.ledger = start_->state.ledger;
                   playback_.start(play.recording);
                   if (play.recording->frames == 0) play_edits();
                 },
             },
             control);
}

}  // namespace hooke
