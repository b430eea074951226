// What a Lab does when it is asked for something else than an edit: documents, undo, going back in time, recordings.
#include "lab/lab.h"
#include "sim/overloaded.h"

namespace hooke {

void Lab::open(std::shared_ptr<const Scene> scene) {
  start_ = std::move(scene);
  scene_ = *start_;
  start_afresh();
  // until the first edit the start is what is shown: a large scene is not copied once more
  published_system_ = std::shared_ptr<const System>(start_, &start_->system);
}

// With the scene that was just put in place.
void Lab::start_afresh() {
  scene_.state.ledger = {};
  history_.clear();
  divergence_.reset();
  running_ = unsaved_ = edited_ = false;
  playback_.stop();
  playback_.forget();
  run_to_.reset();
  past_.clear();
  real_time_.reset();
  simulate_ms_ = 0.0;
  frames_ = 0;
  limit_work_ = last_limit_work_ = hand_lag_ = 0.0;
  take_over({.structure = true});
  open_ledger(scene_.system, scene_.state);
}

// The start is what was built before it ran: edits until then belong to it.
void Lab::keep_start() {
  if (start_ && edited_ && scene_.state.time == start_->state.time) start_ = std::make_shared<const Scene>(scene_);
  edited_ = false;
}

void Lab::go_to_moment(std::size_t moment, Gesture gesture) {
  running_ = false;
  run_to_.reset();
  playback_.stop();
  const auto state = past_.timeline().at(moment);
  if (state->time != scene_.state.time) edit(GoToState{state}, gesture);
}

void Lab::obey(const Control& control, Gesture gesture) {
  const auto go_in_history = [this](std::size_t done) {
    if (done == history_.done() || done > history_.done() + history_.undone()) return;
    playback_.stop();
    const double before = compute_energy(scene_.system, scene_.state).total();
    take_over(history_.go_to(done, scene_));
    book_edit(scene_.system, before, scene_.state);
    recorder_.note_scene(scene_);
    divergence_.reset();
    unsaved_ = edited_ = true;
    ++edits_;
  };
  std::visit(Overloaded{
                 [&](const Undo&) { go_in_history(history_.done() - 1); },
                 [&](const Redo&) { go_in_history(history_.done() + 1); },
                 [&](const GoInHistory& go) { go_in_history(go.done); },
                 [&](const SetRunning& set) {
                   running_ = set.running;
                   run_to_.reset();
                   real_time_.reset();
                   drop_frame();
                   if (running_) divergence_.reset();
                 },
                 [&](const StepOnce&) {
                   running_ = false;
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
                   if (!past_.timeline().empty()) go_to_moment(past_.step_back_from(scene_.state.time), 0);
                 },
                 [&](const Watch& watch) { past_.watch(watch.quantities, scene_.system); },
                 [&](const GoToTime& go) {
                   if (!past_.timeline().empty()) go_to_moment(past_.timeline().find(go.time), gesture);
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
