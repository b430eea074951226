// Handling of controls: documents, undo, the timeline, recordings.
#include <limits>
#include <utility>

#include "base/overloaded.h"
#include "lab/lab.h"
#include "lab/reset_parameters.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/step/frame_device.h"

namespace hooke {

Control::Control(const Control&) = default;
Control::Control(Control&&) noexcept = default;
Control& Control::operator=(const Control&) = default;
Control& Control::operator=(Control&&) noexcept = default;
Control::~Control() = default;

void Lab::open(std::shared_ptr<const Scene> scene) {
  scene_ = *scene;
  start_.open(std::move(scene));
  reset_session();
  // until the first edit, readers share the System of the start, which avoids a copy
  published_.system = std::shared_ptr<const System>(start_.opened(), &start_.opened()->system);
  published_.system_revision = scene_.revision;
}

// Resets everything for the scene that was just opened.
void Lab::reset_session() {
  scene_.state.supply = {};
  frame_.held_edits.clear();
  frame_.must_finish = false;
  published_ = {.status = published_.status};
  history_.clear();
  failure_.restart(scene_.state.time);
  drag_ = {};
  companions_.set({});
  clock_ = {};
  playback_.stop();
  playback_.clear_difference();
  frame_history_.clear();
  measuring_.meter.restart();
  tallies_ = {.edits = tallies_.edits};
  update_plan({.structure = true});
  frame_.runner.take_change();  // it is the start of a run, not an edit in one
  initialize_supply(scene_.system, energy_, scene_.state);
}

void Lab::rebuild_plan() {
  Execution execution = std::move(plan_.execution);
  plan_ = make_plan(scene_.system);
  plan_.execution = std::move(execution);
}

void Lab::set_execution(Execution execution) {
  execution.phases = plan_.execution.phases;
  plan_.execution = std::move(execution);
  frame_.device = plan_.execution.device;
}

std::string Lab::device_refusal() const {
  if (frame_.device == nullptr) return {};
  if (playback_.is_on() || recorder_.file() != nullptr) return "not on the GPU: recordings, whose replay has the same bits";
  return frame_.device->refusal(plan_, *scene_.settings.integrator);
}

Scene Lab::scene_at_start() {
  if (!start_.scene()) return scene_;
  start_.keep_edits(scene_);
  return start_.return_from(scene_);
}

void Lab::go_to_timeline_index(std::size_t moment, Gesture gesture) {
  clock_.set_running(false);
  playback_.stop();
  const auto state = frame_history_.timeline().at(moment);
  if (state->time == scene_.state.time) return;
  edit(GoToState{state}, gesture);
  // muscles and winches at the phase that they had, whatever their speed is now
  const MuscleClock& muscles = scene_.system.muscles;
  if (const double then = frame_history_.timeline().muscle_time(moment); muscles.at(state->time) != then)
    edit(RestoreParameter{find_parameter("muscle_offset"), then - muscles.rate() * state->time}, gesture);
}

void Lab::go_to_history_step(std::size_t done) {
  if (done == history_.done() || done > history_.done() + history_.undone()) return;
  playback_.stop();
  start_.keep_edits(scene_);
  drop_frame();
  const double before = energy_.total();
  const Settings settings = scene_.settings;
  const Effect effect = history_.go_to(done, scene_);
  update_plan(effect);
  record_edit_energy(scene_.system, effect.invalidates_frame() ? energy_.total() - before : 0.0, scene_.state);
  recorder_.record_scene(scene_);
  pass_edit_to_meter(effect, settings);
  check_divergence();
  if (is_at_start()) start_.record_edit();
  for (const Point& point : scene_.system.points())
    if (point.nailed) start_.forget_release(point.id);
  ++tallies_.edits;
}

void Lab::set_running(bool running) {
  clock_.set_running(running);
  clock_.reset_pace();
  drop_frame();
  if (running) resolve_divergence();
}

void Lab::run_to(double time, Gesture gesture) {
  // an earlier time is past already: go back to it
  if (!(time > scene_.state.time)) {
    if (!frame_history_.timeline().empty()) go_to_timeline_index(frame_history_.timeline().find(time), gesture);
    return;
  }
  clock_.run_to(scene_.state.time, time);
  resolve_divergence();
}

void Lab::go_to_start() {
  if (!start_.scene()) return;
  playback_.stop();
  edit(Replace{std::make_shared<const Scene>(scene_at_start())}, 0);
  start_.forget_releases();
  tallies_.limit_work = 0.0;
  tallies_.gas_releases.clear();
  if (failure_.is_known()) clock_.set_running(false);
}

void Lab::set_start() {
  Scene start = scene_;
  start.system.colliders = carried_colliders(scene_.system, scene_.state);
  start.system.grab.reset();
  start.state.hand = {};
  start_.set(std::make_shared<const Scene>(std::move(start)));
  history_.record_unsaved_change("set the start");
}

void Lab::reset_parameters() {
  if (!start_.opened()) return;
  playback_.stop();
  // one step of the history, though several commands
  const Gesture reset = std::numeric_limits<Gesture>::max() - 1 - static_cast<Gesture>(tallies_.edits);
  for (const Command& command : commands_to_reset_parameters(scene_, *start_.opened())) edit(command, reset, "reset parameters");
}

void Lab::release_nails() {
  SetNailed release;
  for (const Point& point : scene_.system.points())
    if (point.nailed) release.items.push_back({point.id, false});
  if (release.items.empty()) return;
  playback_.stop();
  start_.record_release(release);
  edit(release, 0);
}

void Lab::record(const Record& what) {
  drop_frame();
  if (frame_.runner.take_change()) estimate_after_edit(scene_.state.memory);
  if (what.file)
    recorder_.start(*what.file, scene_);
  else
    recorder_.stop();
}

void Lab::play(const Play& what) {
  open(what.recording->start);
  scene_.state.supply = start_.opened()->state.supply;
  recorder_.record_scene(scene_);
  playback_.start(what.recording);
  if (what.recording->frames == 0) play_edits();
}

void Lab::handle(const Control& control, Gesture gesture) {
  const Timeline& timeline = frame_history_.timeline();
  std::visit(Overloaded{
                 [&](const Undo&) { go_to_history_step(history_.done() - 1); },
                 [&](const Redo&) { go_to_history_step(history_.done() + 1); },
                 [&](const GoToHistoryStep& go) { go_to_history_step(go.done); },
                 [&](const SetRunning& set) { set_running(set.running); },
                 [&](const StepOnce&) {
                   clock_.set_running(false);
                   drop_frame();
                   step_frame();
                 },
                 [&](const RunTo& run) { run_to(run.time, gesture); },
                 [&](const StepBack&) {
                   if (!timeline.empty()) go_to_timeline_index(frame_history_.step_back_from(scene_.state.time), 0);
                 },
                 [&](const GoToTime& go) {
                   if (!timeline.empty()) go_to_timeline_index(timeline.find(go.time), gesture);
                 },
                 [&](const Watch& watch) { frame_history_.watch(watch.quantities, scene_.system); },
                 [&](const SetAccuracy& set) { measuring_.meter.set_mode(set.mode); },
                 [&](const SetCompanions& set) { companions_.set(set.companions); },
                 [&](const GoToStart&) { go_to_start(); },
                 [&](const SetStart&) { set_start(); },
                 [&](const ResetParameters&) { reset_parameters(); },
                 [&](const ReleaseNails&) { release_nails(); },
                 [&](const Open& what) {
                   open(what.scene);
                   recorder_.record_scene(scene_);
                   if (what.unsaved) history_.record_unsaved_change("restored from an autosave");
                 },
                 [&](const MarkSaved&) {
                   start_.keep_edits(scene_);
                   history_.mark_saved();
                 },
                 [&](const SetDevice& set) {
                   drop_frame();
                   frame_.device = set.device;
                   // the runs beside the run, too
                   companions_.restart();
                   measuring_.meter.note_edit();
                 },
                 [&](const Record& what) { record(what); },
                 [&](const Play& what) { play(what); },
             },
             control);
}

}  // namespace hooke
