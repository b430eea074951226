#include "lab/lab.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "lab/bounds.h"
#include "lab/parameters.h"
#include "lab/printable.h"
#include "lab/tears.h"
#include "sim/errors.h"
#include "sim/overloaded.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// Real seconds that one call may ask for: what is beyond is dropped, or a hidden window would come back with a jump.
constexpr double most_real_seconds = 0.25;

// Weight of the newest value in the displayed time per frame.
constexpr double smoothing = 0.1;

// [s] over which the displayed speed is measured.
constexpr double speed_window = 1.0;

// What tears without a hand in it, one frame after another: a step of undo, until something else is done.
constexpr Gesture tearing = std::numeric_limits<Gesture>::max();

void smooth(double& shown, double value) { shown = shown == 0.0 ? value : shown + smoothing * (value - shown); }

}  // namespace

Lab::Lab(Scene scene, KeepStart keep) {
  if (keep == KeepStart::No) {
    scene_ = std::move(scene);
    start_afresh();
    return;
  }
  open(std::make_shared<const Scene>(std::move(scene)));
  publish();
}

void Lab::submit(Command command, Gesture gesture) { queue_.emplace_back(std::move(command), gesture); }
void Lab::submit(Control control, Gesture gesture) { queue_.emplace_back(std::move(control), gesture); }

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
  playing_.reset();
  run_to_.reset();
  timeline_.clear();
  traces_.clear();
  difference_.clear();
  owed_ = simulate_ms_ = recent_simulated_ = recent_real_ = 0.0;
  frames_ = 0;
  limit_work_ = last_limit_work_ = hand_lag_ = 0.0;
  take_over({.structure = true});
  open_ledger(scene_.system, scene_.state);
}

// Makes the Plan agree with the System again.
void Lab::take_over(Effect effect) {
  if (effect.structure) forget_other_points();
  if (effect.structure)
    plan_ = make_plan(scene_.system);
  else if (effect.values)
    refresh_values(plan_, scene_.system);
  else
    drop_frame();
  frame_in_progress_ = false;
  energy_ = compute_energy(scene_.system, scene_.state);
  published_system_.reset();
}

// The past is that of the points it was computed with.
void Lab::forget_other_points() {
  std::vector<PointId> points;
  for (const Point& point : scene_.system.points()) points.push_back(point.id);
  if (points == timeline_points_) return;
  timeline_.clear();
  traces_.clear();
  timeline_points_ = std::move(points);
}

// A frame that is not finished has broken no spring.
void Lab::drop_frame() {
  if (frame_in_progress_ && !frame_.broken().empty()) refresh_values(plan_, scene_.system);
  frame_in_progress_ = false;
}

void Lab::edit(const Command& command, Gesture gesture) {
  // the hand only moves: no edit, no energy, nothing to undo
  if (std::holds_alternative<MoveHand>(command)) {
    Effect effect;
    apply(scene_, command, effect);
    published_system_.reset();
    record([&](RecordingWriter& writer) { writer.note(command, scene_); });
    return;
  }

  const double before = compute_energy(scene_.system, scene_.state).total();
  Effect effect;
  std::vector<Command> inverse = apply(scene_, command, effect);
  take_over(effect);
  if (std::holds_alternative<Replace>(command))
    open_ledger(scene_.system, scene_.state);
  else
    book_edit(scene_.system, before, scene_.state);
  record([&](RecordingWriter& writer) { writer.note(command, scene_); });
  divergence_.reset();
  if (std::holds_alternative<GrabPoint>(command) || std::holds_alternative<GrabCollider>(command)) grab_gesture_ = gesture;
  if (inverse.empty()) return;
  history_.note(describe(command), std::move(inverse), gesture);
  unsaved_ = edited_ = true;
  ++edits_;
}

void Lab::obey(const Control& control, Gesture gesture) {
  const auto go_in_history = [this](std::size_t done) {
    if (done == history_.done() || done > history_.done() + history_.undone()) return;
    playing_.reset();
    const double before = compute_energy(scene_.system, scene_.state).total();
    take_over(history_.go_to(done, scene_));
    book_edit(scene_.system, before, scene_.state);
    record([&](RecordingWriter& writer) { writer.note_scene(scene_); });
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
                   owed_ = recent_simulated_ = recent_real_ = 0.0;
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
                   if (timeline_.empty()) return;
                   const std::size_t here = timeline_.find(scene_.state.time);
                   const bool is_at_one = timeline_.at(here)->time == scene_.state.time;
                   go_to_moment(here - (is_at_one && here > 0 ? 1 : 0), 0);
                 },
                 [&](const Watch& watch) { traces_.watch(watch.quantities, timeline_, scene_.system); },
                 [&](const GoToTime& go) {
                   if (!timeline_.empty()) go_to_moment(timeline_.find(go.time), gesture);
                 },
                 [&](const GoToStart&) {
                   if (!start_) return;
                   playing_.reset();
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
                 [&](const Record& what) { start_or_stop_recording(what.file.get()); },
                 [&](const Play& play) {
                   open(play.recording->start);
                   scene_.state.ledger = start_->state.ledger;
                   playing_ = Playing{.recording = play.recording};
                   if (play.recording->frames == 0) play_edits();
                 },
             },
             control);
}

void Lab::apply_queue() {
  // moved out first: obeying may queue more
  auto queue = std::exchange(queue_, {});
  for (const auto& [request, gesture] : queue) {
    if (const auto* command = std::get_if<Command>(&request)) {
      playing_.reset();
      edit(*command, gesture);
    } else {
      obey(std::get<Control>(request), gesture);
    }
  }
}

// The start is what was built before it ran: edits until then belong to it.
void Lab::keep_start() {
  if (start_ && edited_ && scene_.state.time == start_->state.time) start_ = std::make_shared<const Scene>(scene_);
  edited_ = false;
}

void Lab::start_or_stop_recording(const std::filesystem::path* file) {
  drop_frame();
  recording_error_.clear();
  record([](RecordingWriter& writer) { writer.close(); });
  recorder_.reset();
  if (file == nullptr) return;
  try {
    recorder_.emplace(*file, scene_);
  } catch (const FileError& error) {
    recording_error_ = error.what();
  }
}

// A recording that cannot be written ends; what it recorded of is not disturbed.
void Lab::record(const std::function<void(RecordingWriter&)>& note) {
  if (!recorder_) return;
  try {
    note(*recorder_);
  } catch (const FileError& error) {
    recording_error_ = error.what();
    recorder_.reset();
  }
}

// What was done before the next frame of the recording, or after its last one.
void Lab::play_edits() {
  const auto& items = playing_->recording->items;
  while (playing_->next < items.size() && !std::holds_alternative<Fingerprint>(items[playing_->next])) {
    const Recording::Item& item = items[playing_->next++];
    if (const auto* command = std::get_if<Command>(&item)) {
      edit(*command, 0);
    } else {
      const auto& scene = std::get<std::shared_ptr<const Scene>>(item);
      edit(Replace{scene}, 0);
      scene_.state.ledger = scene->state.ledger;
    }
  }
  if (playing_->next == items.size()) playing_.reset();
}

// Compares the frame just taken over with the recorded one.
void Lab::judge_played_frame() {
  const Fingerprint& recorded = std::get<Fingerprint>(playing_->recording->items[playing_->next++]);
  const Fingerprint now = fingerprint_of(scene_.state);
  ++playing_->frames;
  if (now == recorded) {
    if (playing_->frames == playing_->recording->frames) {
      play_edits();
      running_ = false;
    }
    return;
  }
  difference_ = "frame " + std::to_string(playing_->frames) + ", at " + shortest(scene_.state.time) + " s: ";
  if (const auto points = first_difference(now, recorded, scene_.system.point_count())) {
    const auto& [first, last] = *points;
    difference_ += first == last ? "point " + std::to_string(first) + " is"
                                 : "points " + std::to_string(first) + " to " + std::to_string(last) + " are";
    difference_ += " not where recorded";
  } else {
    difference_ += "not the state that was recorded";
  }
  playing_.reset();
  running_ = false;
}

// A frame that can be gone back to; kept for people, not for runs without a start to go back to.
void Lab::note_moment() {
  if (!start_) return;
  timeline_.note(scene_.state);
  traces_.note(timeline_, scene_.system, scene_.state);
}

void Lab::go_to_moment(std::size_t moment, Gesture gesture) {
  running_ = false;
  run_to_.reset();
  playing_.reset();
  if (timeline_.at(moment)->time != scene_.state.time) edit(GoToState{timeline_.at(moment)}, gesture);
}

void Lab::begin_frame() {
  if (playing_) play_edits();
  keep_start();
  if (timeline_.empty() || timeline_.last_time() != scene_.state.time) note_moment();
  frame_.begin(plan_, scene_.system, scene_.settings, scene_.state);
  frame_in_progress_ = true;
  frame_ms_ = 0.0;
}

// Takes away what broke in the frame just computed; what puts it back is returned.
std::optional<Insert> Lab::tear() {
  if (frame_.broken().empty()) return std::nullopt;
  std::vector<SpringId> broken;
  for (const Index s : frame_.broken()) broken.push_back(scene_.system.springs()[s].id);
  Effect effect;
  const std::vector<Command> mending = apply(scene_, torn_by(scene_.system, broken), effect);
  plan_ = make_plan(scene_.system);
  published_system_.reset();
  return std::get<Insert>(mending.front());
}

// Keeps what was taken away, so that the moments before it can be gone back to.
void Lab::note_tear(Insert pieces) {
  const std::uint32_t before = scene_.state.torn;
  scene_.tears.push_back(std::make_shared<const Tear>(Tear{before, std::move(pieces.springs), std::move(pieces.faces)}));
  scene_.state.torn = static_cast<std::uint32_t>(scene_.tears.size());
  history_.note("tear", {SetTorn{before}}, scene_.system.grab || scene_.system.collider_grab ? grab_gesture_ : tearing);
}

// Puts the collider in the hand where the frame took it, and sees how far the hand is behind.
void Lab::follow_hand() {
  const auto& grab = scene_.system.grab;
  const auto& carried = scene_.system.collider_grab;
  hand_lag_ = grab ? glm::distance(grab->target, scene_.state.hand) : 0.0;
  if (!carried) return;
  Collider& collider = scene_.system.colliders[carried->collider];
  collider = moved_by(collider, frame_.way_of_collider());
  refresh_colliders(plan_, scene_.system);
  published_system_.reset();
  hand_lag_ = glm::distance(carried->target, anchor_of(collider));
}

// Judges the frame just computed and takes it over, or keeps the one before and stops.
bool Lab::finish_frame() {
  next_ = scene_.state;
  frame_.end(plan_, next_);
  book_forces_work(plan_, scene_.state, next_);
  frame_in_progress_ = false;
  std::optional<Insert> torn = tear();

  const Energy energy = compute_energy(scene_.system, next_);
  divergence_ = find_divergence(scene_.system, next_, energy);
  if (divergence_) {
    Effect effect;
    if (torn) apply(scene_, *torn, effect);
    if (effect.structure) take_over(effect);
    if (playing_) difference_ = "frame " + std::to_string(playing_->frames + 1) + " diverges, and did not when it was recorded";
    playing_.reset();
    run_to_.reset();
    running_ = false;
    owed_ = 0.0;
    return false;
  }
  std::swap(scene_.state, next_);
  energy_ = energy;
  ++frames_;
  if (torn) note_tear(*std::move(torn));
  follow_hand();
  last_limit_work_ = frame_.motion().limit_work;
  limit_work_ += last_limit_work_;
  note_moment();
  // the clock is a sum of frames: half a frame decides
  if (run_to_ && scene_.state.time + 0.5 / scene_.settings.frame_rate > *run_to_) {
    running_ = false;
    run_to_.reset();
  }
  record([&](RecordingWriter& writer) { writer.note_frame(scene_.state); });
  if (playing_) judge_played_frame();
  smooth(simulate_ms_, frame_ms_);
  return true;
}

bool Lab::step_frame() {
  begin_frame();
  const auto start = Clock::now();
  while (!frame_.done()) frame_.substep(plan_);
  frame_ms_ = milliseconds_since(start);
  return finish_frame();
}

bool Lab::step() {
  apply_queue();
  return step_frame();
}

void Lab::advance(double real_seconds, const std::function<bool()>& may_go_on) {
  // a frame cut short goes on, unless something else than the hand's place is to change
  const bool only_hand = std::all_of(queue_.begin(), queue_.end(), [](const auto& queued) {
    const auto* command = std::get_if<Command>(&queued.first);
    return command != nullptr && std::holds_alternative<MoveHand>(*command);
  });
  if (!frame_in_progress_ || !only_hand) apply_queue();

  if (running_) {
    const double asked = std::min(real_seconds, most_real_seconds) * scene_.settings.speed;
    const double frame = 1.0 / scene_.settings.frame_rate;
    owed_ += asked;
    long stepped = 0;
    bool in_time = true;
    while (running_ && in_time && (frame_in_progress_ || run_to_ || owed_ >= frame)) {
      if (!frame_in_progress_) begin_frame();
      const auto start = Clock::now();
      while (!frame_.done() && in_time) {
        frame_.substep(plan_);
        in_time = may_go_on();
      }
      frame_ms_ += milliseconds_since(start);
      if (frame_.done()) {
        owed_ -= frame;
        stepped += finish_frame() ? 1 : 0;
      }
    }
    // what is still owed beyond a frame is not made up for: the scene runs slower, and says so
    owed_ = std::clamp(owed_, 0.0, frame);
    const double fade = std::exp(-real_seconds / speed_window);
    recent_simulated_ = fade * recent_simulated_ + static_cast<double>(stepped) * frame;
    recent_real_ = fade * recent_real_ + real_seconds;
  }
  publish();
}

std::chrono::duration<double> Lab::time_to_next_frame() const {
  const double due = 1.0 / scene_.settings.frame_rate - owed_;
  return std::chrono::duration<double>(frame_in_progress_ || run_to_ ? 0.0 : std::clamp(due / scene_.settings.speed, 0.0, 0.05));
}

void Lab::publish() {
  if (!published_system_) published_system_ = std::make_shared<const System>(scene_.system);

  auto snapshot = std::make_shared<Snapshot>();
  snapshot->system = published_system_;
  snapshot->state = scene_.state;
  snapshot->settings = scene_.settings;
  snapshot->energy = energy_;
  snapshot->momentum = compute_momentum(scene_.system, scene_.state);
  for (const Spring& spring : scene_.system.springs()) {
    if (!scene_.system.is_on(spring)) continue;
    const double value = strain(scene_.system, scene_.state, spring);
    snapshot->least_strain = std::min(snapshot->least_strain, value);
    snapshot->most_strain = std::max(snapshot->most_strain, value);
  }
  snapshot->omega = plan_.spectrum.omega;
  snapshot->largest_stable_step = largest_stable_step(*scene_.settings.integrator, plan_.spectrum);
  snapshot->divergence = divergence_;

  auto status = std::make_shared<Status>();
  status->snapshot = std::move(snapshot);
  status->scene_name = scene_.name;
  status->scene_description = scene_.description;
  status->view = scene_.view;
  status->print = scene_.print;
  status->defaults = scene_.defaults;
  status->sheet = scene_.sheet;
  status->controls = scene_.controls;
  for (const Parameter& parameter : parameters()) {
    const bool applies = parameter.applies == nullptr || parameter.applies(scene_);
    status->parameter_values.push_back(applies ? parameter.read(scene_) : std::numeric_limits<double>::quiet_NaN());
  }
  status->hand_lag = scene_.system.hand_speed > 0.0 && (scene_.system.grab || scene_.system.collider_grab) ? hand_lag_ : 0.0;
  status->limit_power = running_ ? last_limit_work_ * scene_.settings.frame_rate : 0.0;
  status->limit_work = limit_work_;
  status->running = running_;
  status->unsaved = unsaved_;
  status->edits = edits_;
  status->undo_name = history_.undo_name();
  status->redo_name = history_.redo_name();
  status->history = history_.list();
  if (divergence_) {
    status->advice = advise(plan_.spectrum, scene_.settings);
    status->message = explain(*divergence_, scene_.system, scene_.settings, *status->advice);
  }
  status->simulate_ms = simulate_ms_;
  status->speed = running_ && recent_real_ > 0.0 ? recent_simulated_ / recent_real_ : 0.0;
  status->frames = frames_;
  status->first_moment = timeline_.empty() ? scene_.state.time : timeline_.first_time();
  status->last_moment = timeline_.empty() ? scene_.state.time : timeline_.last_time();
  status->traces = traces_.table();
  if (run_to_) {
    status->run_from = run_from_;
    status->run_to = *run_to_;
  }
  if (recorder_) status->recording = printable(recorder_->file().native());
  status->recording_error = recording_error_;
  if (playing_) status->playing = static_cast<double>(playing_->frames) / static_cast<double>(playing_->recording->frames);
  status->difference = difference_;
  status->next_point_id = scene_.system.next_point_id();
  status->next_spring_id = scene_.system.next_spring_id();
  status_ = std::move(status);
}

}  // namespace hooke
