// Handling of controls: documents, undo, the timeline, recordings.
#include <limits>
#include <utility>

#include "base/overloaded.h"
#include "lab/lab.h"
#include "lab/reset_parameters.h"
#include "sim/control/automatic.h"

namespace hooke {

void Lab::open(std::shared_ptr<const Scene> scene) {
  start_.set(scene);
  scene_ = *scene;
  opened_ = std::move(scene);
  reset_session();
  // until the first edit, readers share the System of the start, which avoids a copy
  published_system_ = std::shared_ptr<const System>(opened_, &opened_->system);
  published_system_revision_ = scene_.revision;
}

// Resets everything for the scene that was just opened.
void Lab::reset_session() {
  scene_.state.supply = {};
  held_edits_.clear();
  published_system_.reset();
  published_document_.reset();
  must_finish_frame_ = false;
  history_.clear();
  divergence_.reset();
  before_failure_.reset();
  changes_.clear();
  before_drag_.reset();
  drag_gesture_ = 0;
  companions_.set({});
  explained_until_ = scene_.state.time;
  running_ = start_is_edited_ = false;
  playback_.stop();
  playback_.clear_difference();
  run_to_.reset();
  frame_history_.clear();
  meter_.restart();
  frame_pacer_.reset();
  simulate_ms_ = 0.0;
  frames_ = 0;
  limit_work_ = last_limit_work_ = hand_lag_ = 0.0;
  gas_releases_.clear();
  update_plan({.structure = true});
  frame_.take_change();  // it is the start of a run, not an edit in one
  initialize_supply(scene_.system, scene_.state);
}

void Lab::rebuild_plan() {
  plan_ = make_plan(scene_.system);
  plan_.execution = execution_;
}

void Lab::set_execution(Execution execution) {
  execution_ = std::move(execution);
  plan_.execution = execution_;
}

// Edits made before the first frame belong to the start.
void Lab::keep_start() {
  if (start_is_edited_ && scene_.state.time == start_.scene()->state.time) start_.set_with_released_nails(scene_);
  start_is_edited_ = false;
}

Scene Lab::scene_at_start() {
  if (!start_.scene()) return scene_;
  keep_start();
  return start_.return_from(scene_);
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
    keep_start();
    drop_frame();
    const double before = energy_.total();
    const Settings settings = scene_.settings;
    const Effect effect = history_.go_to(done, scene_);
    update_plan(effect);
    record_edit_energy(scene_.system, effect.invalidates_frame() ? energy_.total() - before : 0.0, scene_.state);
    recorder_.record_scene(scene_);
    pass_edit_to_meter(effect, settings);
    check_divergence();
    start_is_edited_ = start_is_edited_ || is_at_start();
    for (const Point& point : scene_.system.points())
      if (point.nailed) start_.forget_release(point.id);
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
                   if (running_) resolve_divergence();
                 },
                 [&](const StepOnce&) {
                   running_ = false;
                   drop_frame();
                   step_frame();
                 },
                 [&](const RunTo& run) {
                   // an earlier time is past already: go back to it
                   if (!(run.time > scene_.state.time)) {
                     if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.timeline().find(run.time), gesture);
                     return;
                   }
                   run_to_ = run.time;
                   run_from_ = scene_.state.time;
                   running_ = true;
                   resolve_divergence();
                 },
                 [&](const StepBack&) {
                   if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.step_back_from(scene_.state.time), 0);
                 },
                 [&](const Watch& watch) { frame_history_.watch(watch.quantities, scene_.system); },
                 [&](const SetAccuracy& set) { meter_.set_mode(set.mode); },
                 [&](const SetCompanions& set) { companions_.set(set.companions); },
                 [&](const GoToTime& go) {
                   if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.timeline().find(go.time), gesture);
                 },
                 [&](const GoToStart&) {
                   if (!start_.scene()) return;
                   playback_.stop();
                   edit(Replace{std::make_shared<const Scene>(scene_at_start())}, 0);
                   start_.forget_releases();
                   limit_work_ = 0.0;
                   gas_releases_.clear();
                   running_ = running_ && !divergence_;
                 },
                 [&](const SetStart&) {
                   Scene start = scene_;
                   start.system.colliders = carried_colliders(scene_.system, scene_.state);
                   start.system.grab.reset();
                   start.state.hand = {};
                   start_.set(std::make_shared<const Scene>(std::move(start)));
                   history_.record_unsaved_change("set the start");
                 },
                 [&](const ResetParameters&) {
                   if (!opened_) return;
                   playback_.stop();
                   // one step of the history, though several commands
                   const Gesture reset = std::numeric_limits<Gesture>::max() - 1 - static_cast<Gesture>(edits_);
                   for (const Command& command : commands_to_reset_parameters(scene_, *opened_)) edit(command, reset, "reset parameters");
                 },
                 [&](const ReleaseNails&) {
                   SetNailed release;
                   for (const Point& point : scene_.system.points())
                     if (point.nailed) release.items.push_back({point.id, false});
                   if (release.items.empty()) return;
                   playback_.stop();
                   start_.record_release(release);
                   edit(release, 0);
                 },
                 [&](const Open& open_scene) {
                   open(open_scene.scene);
                   recorder_.record_scene(scene_);
                   if (open_scene.unsaved) history_.record_unsaved_change("restored from an autosave");
                 },
                 [&](const MarkSaved&) {
                   keep_start();
                   history_.mark_saved();
                 },
                 [&](const Record& what) {
                   drop_frame();
                   if (frame_.take_change()) compare_after_edit(scene_.state.memory);
                   if (what.file)
                     recorder_.start(*what.file, scene_);
                   else
                     recorder_.stop();
                 },
                 [&](const Play& play) {
                   open(play.recording->start);
                   scene_.state.supply = opened_->state.supply;
                   recorder_.record_scene(scene_);
                   playback_.start(play.recording);
                   if (play.recording->frames == 0) play_edits();
                 },
             },
             control);
}

}  // namespace hooke
