#include "lab/lab.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>
#include <limits>

#include "lab/tears.h"

namespace hooke {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// Weight of the newest value in the displayed time per frame.
constexpr double smoothing = 0.1;

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

// Makes the Plan agree with the System again.
void Lab::take_over(Effect effect) {
  if (effect.structure) past_.keep_to(scene_.system);
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
    recorder_.note(command, scene_);
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
  recorder_.note(command, scene_);
  divergence_.reset();
  if (std::holds_alternative<GrabPoint>(command) || std::holds_alternative<GrabCollider>(command)) grab_gesture_ = gesture;
  if (inverse.empty()) return;
  history_.note(describe(command), std::move(inverse), gesture);
  unsaved_ = edited_ = true;
  ++edits_;
}

void Lab::apply_queue() {
  // moved out first: obeying may queue more
  auto queue = std::exchange(queue_, {});
  for (const auto& [request, gesture] : queue) {
    if (const auto* command = std::get_if<Command>(&request)) {
      playback_.stop();
      edit(*command, gesture);
    } else {
      obey(std::get<Control>(request), gesture);
    }
  }
}

// What was done before the next frame of the recording, or after its last one.
void Lab::play_edits() {
  while (const Recording::Item* item = playback_.next_edit()) {
    if (const auto* command = std::get_if<Command>(item)) {
      edit(*command, 0);
    } else {
      const auto& scene = std::get<std::shared_ptr<const Scene>>(*item);
      edit(Replace{scene}, 0);
      scene_.state.ledger = scene->state.ledger;
    }
  }
}

// Compares the frame just taken over with the recorded one.
void Lab::judge_played_frame() {
  playback_.judge(scene_.state, scene_.system.point_count());
  if (playback_.is_on() && !playback_.is_past_the_last_frame()) return;
  play_edits();
  running_ = false;
}

// A frame that can be gone back to; kept for people, not for runs without a start to go back to.
void Lab::note_moment() {
  if (!start_) return;
  past_.note(scene_.system, scene_.state);
}

void Lab::begin_frame() {
  play_edits();
  keep_start();
  if (past_.timeline().empty() || past_.timeline().last_time() != scene_.state.time) note_moment();
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
    playback_.note_divergence();
    run_to_.reset();
    running_ = false;
    real_time_.forgive();
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
  recorder_.note_frame(scene_.state);
  if (playback_.is_on()) judge_played_frame();
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
    const double frame = 1.0 / scene_.settings.frame_rate;
    real_time_.ask(real_seconds, scene_.settings.speed);
    long stepped = 0;
    bool in_time = true;
    while (running_ && in_time && (frame_in_progress_ || run_to_ || real_time_.owes(frame))) {
      if (!frame_in_progress_) begin_frame();
      const auto start = Clock::now();
      while (!frame_.done() && in_time) {
        frame_.substep(plan_);
        in_time = may_go_on();
      }
      frame_ms_ += milliseconds_since(start);
      if (frame_.done()) {
        real_time_.pay(frame);
        stepped += finish_frame() ? 1 : 0;
      }
    }
    real_time_.settle(real_seconds, static_cast<double>(stepped) * frame, frame);
  }
  publish();
}

std::chrono::duration<double> Lab::time_to_next_frame() const {
  const double due = real_time_.time_to_next(1.0 / scene_.settings.frame_rate);
  return std::chrono::duration<double>(frame_in_progress_ || run_to_ ? 0.0 : std::clamp(due / scene_.settings.speed, 0.0, 0.05));
}

}  // namespace hooke
