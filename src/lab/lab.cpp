#include "lab/lab.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "base/overloaded.h"
#include "edit/tears.h"
#include "lab/change_text.h"

namespace hooke {
namespace {

// So that a frame repeated with half the step, of twice the substeps, is done before the next one is, 40 frames later; or 10, where what
// is shown is no longer true.
constexpr long substeps_per_repeated = 20, substeps_per_urgent = 5;

// Tears in consecutive frames without a grab are one step of the history.
constexpr Gesture tearing_gesture = std::numeric_limits<Gesture>::max();

}  // namespace

Lab::Lab(Scene scene, KeepStart keep) : measuring_{.at_once = keep == KeepStart::No} {
  if (keep == KeepStart::No) {
    scene_ = std::move(scene);
    reset_session();
    return;
  }
  plan_.execution.phases = &measuring_.times;
  measuring_.meter.set_mode(AccuracyMode::Full);
  open(std::make_shared<const Scene>(std::move(scene)));
  publish();
}

void Lab::submit(Command command, Gesture gesture, std::string name) { queue_.push_back({std::move(command), gesture, std::move(name)}); }
void Lab::submit(Control control, Gesture gesture) { queue_.push_back({std::move(control), gesture}); }

// Brings the Plan and the energy up to date, and discards the frame in progress unless the edit does not affect it.
void Lab::update_plan(Effect effect) {
  if (!effect.invalidates_frame()) return;
  // the plan is made again where the structure changes
  drop_frame(!effect.structure);
  frame_.runner.expect_change();
  companions_.restart();
  if (effect.structure) {
    frame_history_.clear_if_points_changed(scene_.system);
    rebuild_plan();
  } else if (effect.values) {
    refresh_values(plan_, scene_.system);
  }
  energy_ = compute_energy(scene_.system, scene_.state);
}

// Discards the frame in progress, and restores the springs that it broke.
void Lab::drop_frame(bool restores_springs) {
  if (restores_springs && frame_.is_in_progress && !frame_.runner.broken().empty()) refresh_values(plan_, scene_.system);
  frame_.is_in_progress = false;
  record_held_edits();
}

// An edit that does not affect the frame in progress takes effect after it, and is recorded there.
void Lab::record_edit(const Command& command) {
  if (frame_.is_in_progress)
    frame_.held_edits.push_back(command);
  else
    recorder_.record(command, scene_);
}

void Lab::record_held_edits() {
  for (const Command& command : std::exchange(frame_.held_edits, {})) recorder_.record(command, scene_);
}

void Lab::edit(const Command& command, Gesture gesture, const std::string& name, std::optional<History::Of> known) {
  // a moving hand changes no energy and leaves nothing to undo
  if (std::holds_alternative<MoveHand>(command)) {
    Effect effect;
    apply(scene_, command, effect);
    record_edit(command);
    return;
  }

  const bool was_in_progress = frame_.is_in_progress;
  const Settings settings = scene_.settings;
  if (const auto* set = std::get_if<SetForces>(&command)) start_.record_leaks(scene_.system.forces, set->forces);
  if (std::holds_alternative<GoToState>(command) || std::holds_alternative<Replace>(command)) start_.keep_edits(scene_);
  const History::Of of = known.value_or(changed_by(command));
  const double before = energy_.total();
  const std::string value = value_before(command, scene_);
  const std::shared_ptr<const State> state = known ? nullptr : state_before_drag(command, gesture, of);
  Effect effect;
  std::vector<Command> inverse = apply(scene_, command, effect);
  update_plan(effect);
  if (can_cause_failure(command) && start_.scene()) failure_.add_change(command, value, inverse, gesture, scene_);
  if (was_in_progress && !frame_.is_in_progress) frame_.must_finish = true;
  if (std::holds_alternative<Replace>(command))
    initialize_supply(scene_.system, scene_.state);
  else
    record_edit_energy(scene_.system, effect.invalidates_frame() ? energy_.total() - before : 0.0, scene_.state);
  record_edit(command);
  pass_edit_to_meter(effect, settings);
  if (effect.structure || effect.motion || is_grab(command)) resolve_divergence();
  check_divergence();
  if (is_grab(command)) drag_.grab = gesture;
  // a drag is one step, and its end is not a separate one
  if (inverse.empty() || std::holds_alternative<ReleaseHand>(command)) return;
  if (state) return_to_state(state, inverse);
  history_.record(name.empty() ? describe(command) : name, std::move(inverse), gesture, of);
  if (of == History::Of::Document && is_at_start()) start_.record_edit();
  if (const auto* insert = std::get_if<Insert>(&command); insert != nullptr && !is_at_start()) start_.record_added(*insert);
  if (const auto* set = std::get_if<SetNailed>(&command))
    for (const SetNailed::Item& item : set->items)
      if (item.nailed) start_.forget_release(item.point);
  ++tallies_.edits;
}

// The scene has not run yet, or is back at its start: what is moved now is moved at the start too.
bool Lab::is_at_start() const { return start_.scene() && !clock_.is_running() && scene_.state.time == start_.scene()->state.time; }

// Interaction with a running scene does not change the document: going back to the start restores what the hand dragged, tore or released.
History::Of Lab::changed_by(const Command& command) const {
  using Of = History::Of;
  const Of of_places = is_at_start() || !start_.scene() ? Of::Document : Of::Run;
  return std::visit(Overloaded{
                        [&](const Move&) { return of_places; },
                        [&](const SetVelocity&) { return of_places; },
                        [&](const SetNailed& set) {
                          const auto changes = [&](const SetNailed::Item& item) {
                            if (item.nailed) return !start_.is_nailed(item.point);
                            return of_places == Of::Document && !start_.is_released(item.point);
                          };
                          return std::ranges::any_of(set.items, changes) ? Of::Document : Of::Run;
                        },
                        [&](const SetColliders& set) {
                          const auto same_shape = [](const Collider& a, const Collider& b) { return a.shape == b.shape; };
                          return std::ranges::equal(set.colliders, scene_.system.colliders, same_shape) ? Of::Document : of_places;
                        },
                        []<class Other>(const Other&) {
                          constexpr bool is_of_run =
                              is_one_of<Other, GrabPoint, GrabCollider, MoveHand, ReleaseHand, GoToState, SetTorn, MarkTorn, Replace>;
                          return is_of_run ? Of::Run : Of::Document;
                        },
                    },
                    command);
}

// A change of parameters does not hide why a run stopped, unless it resolves the cause: the step was beyond the limit of the method and no
// longer is.
void Lab::check_divergence() {
  if (failure_.is_step_mended(scene_, plan_)) resolve_divergence();
}

// What is measured of the run that failed says nothing about the one that follows.
void Lab::resolve_divergence() {
  if (failure_.is_known()) measuring_.meter.restart();
  failure_.resolve();
}

// Edits that discard every frame in progress would stop the clock: after one discarded frame, edits wait until the next is finished.
bool Lab::must_wait_for_frame() const {
  return frame_.is_in_progress && frame_.must_finish &&
         std::ranges::all_of(queue_, [](const Queued& queued) { return std::holds_alternative<Command>(queued.what); });
}

// A drag in a run moves what the point touches and is attached to as well, and the run goes on: a point that is put back alone may be
// on the other side of a sheet. Undo returns to the state before the drag. Null: the command is no such drag.
std::shared_ptr<const State> Lab::state_before_drag(const Command& command, Gesture gesture, History::Of of) {
  if (of != History::Of::Run || !(is_grab(command) || std::holds_alternative<Move>(command))) return nullptr;
  if (gesture == 0 || gesture != drag_.gesture) drag_.before = std::make_shared<const State>(scene_.state);
  drag_.gesture = gesture;
  return drag_.before;
}

void Lab::return_to_state(const std::shared_ptr<const State>& state, std::vector<Command>& inverse) {
  if (inverse.empty()) return;
  std::erase_if(inverse, [](const Command& command) { return std::holds_alternative<Move>(command); });
  inverse.push_back(GoToState{state});
}

void Lab::apply_queue() {
  // moved to a local variable, because a handler may submit more
  auto queue = std::exchange(queue_, {});
  for (const auto& [what, gesture, name] : queue) {
    if (const auto* command = std::get_if<Command>(&what)) {
      playback_.stop();
      edit(*command, gesture, name);
    } else {
      handle(std::get<Control>(what), gesture);
    }
  }
}

// Applies the edits recorded before the next frame, or after the last one.
void Lab::play_edits() {
  while (const Recording::Item* item = playback_.next_edit()) {
    if (const auto* command = std::get_if<Command>(item)) {
      edit(*command, 0, {}, History::Of::Run);
    } else {
      const auto& scene = std::get<std::shared_ptr<const Scene>>(*item);
      edit(Replace{scene}, 0);
      scene_.state.supply = scene->state.supply;
    }
  }
}

// Compares the frame just computed with the recorded one.
void Lab::check_played_frame() {
  playback_.compare(scene_.state, scene_.system.point_count());
  if (playback_.is_on() && !playback_.is_after_last_frame()) return;
  play_edits();
  clock_.set_running(false);
}

// States are kept only for interactive use: not for runs without a start.
void Lab::add_to_timeline(bool continues) {
  if (!start_.scene()) return;
  frame_history_.record(scene_.system, scene_.state, accuracy(), continues);
}

void Lab::begin_frame() {
  play_edits();
  start_.keep_edits(scene_);
  if (frame_history_.timeline().empty() || frame_history_.timeline().last_time() != scene_.state.time) add_to_timeline(false);
  Settings settings = scene_.settings;
  plan_.execution.device = device_refusal().empty() ? frame_.device : nullptr;
  settings.measures_damping = measuring_.meter.mode() != AccuracyMode::Off;
  frame_.runner.begin(plan_, scene_.system, settings, scene_.state);
  frame_.is_in_progress = true;
}

// Removes the springs that broke in the frame just computed, and returns the command that restores them.
std::optional<Insert> Lab::tear() {
  if (frame_.runner.broken().empty()) return std::nullopt;
  std::vector<SpringId> broken;
  for (const Index s : frame_.runner.broken()) broken.push_back(scene_.system.springs()[s].id);
  Effect effect;
  const std::vector<Command> inverse = apply(scene_, removal_of_broken(scene_.system, broken), effect);
  rebuild_plan();
  return std::get<Insert>(inverse.front());
}

// Keeps what a tear removed, so that earlier states can be returned to.
void Lab::record_tear(Insert pieces) {
  const std::uint32_t before = scene_.state.torn;
  scene_.tears.push_back(std::make_shared<const Tear>(Tear{before, std::move(pieces.springs), std::move(pieces.faces)}));
  scene_.state.torn = static_cast<std::uint32_t>(scene_.tears.size());
  history_.record("tear", {SetTorn{before}}, scene_.system.grab || scene_.state.hand.collider ? drag_.grab : tearing_gesture,
                  History::Of::Run);
}

// Distance from the hand to its target [m].
double Lab::hand_lag() const {
  const Hand& hand = scene_.state.hand;
  if (hand.collider) return glm::distance(hand.collider->target, anchor_of(hand.collider->shape));
  return scene_.system.grab ? glm::distance(hand.target, hand.position) : 0.0;
}

// Checks the frame just computed and adopts it; if it diverged, keeps the previous state and stops.
bool Lab::finish_frame() {
  frame_.end = scene_.state;
  frame_.runner.end(plan_, frame_.end);
  frame_.is_in_progress = frame_.must_finish = false;
  // until springs that broke are removed, System and plan are those with which the frame began
  if (!frame_.runner.broken().empty()) refresh_values(plan_, scene_.system);

  const Energy energy = energy_after_frame();
  if (const auto divergence = find_divergence(scene_.system, frame_.end, energy, frame_.runner.failure())) {
    failure_.set(*divergence, scene_, plan_, frame_history_.timeline());
    playback_.record_divergence();
    clock_.set_running(false);
    clock_.clear_backlog();
    record_held_edits();
    return false;
  }
  meter_frame(energy.total());
  companions_.add_frame(plan_, scene_.system, scene_.settings, scene_.state, frame_.end);
  const std::size_t filled = plan_.force_data.enclosures.enclosures.size();
  std::optional<Insert> torn = tear();
  if (torn) companions_.restart();
  std::swap(scene_.state, frame_.end);
  if (!start_.scene() && frame_.end.position.size() >= min_points_of_large_run) frame_.end = {};
  energy_ = torn ? compute_energy(scene_.system, scene_.state) : energy;
  failure_.add_frame(scene_, energy.total());
  ++tallies_.frames;
  if (torn) record_tear(*std::move(torn));
  for (std::size_t left = plan_.force_data.enclosures.enclosures.size(); left < filled; ++left)
    tallies_.gas_releases.push_back(scene_.state.time);
  drag_.lag = hand_lag();
  tallies_.last_limit_work =
      explained(frame_.runner.motion().energy, plan_.hand.held || plan_.collider_paths.any_moves)[EnergyCause::StrainLimit];
  tallies_.limit_work += tallies_.last_limit_work;
  add_to_timeline(true);
  measuring_.end_frame();
  clock_.end_frame(scene_.state.time, 1.0 / scene_.settings.frame_rate);
  recorder_.record_frame(scene_.state);
  record_held_edits();
  if (playback_.is_on()) check_played_frame();
  return true;
}

// Of `frame_.end`, without the springs that broke.
Energy Lab::energy_after_frame() const {
  Energy energy = compute_energy(scene_.system, frame_.end);
  for (const Index s : frame_.runner.broken()) energy.elastic -= elastic_energy(scene_.system, frame_.end, scene_.system.springs()[s]);
  return energy;
}

// Computes the companions of the last frame; false if `should_continue` ended it.
bool Lab::compute_companions(const std::function<bool()>& should_continue) {
  while (companions_.has_work()) {
    companions_.substep(scene_.system);
    if (!should_continue()) return false;
  }
  return true;
}

bool Lab::step_frame() {
  // `auto` computes frames when it chooses the method, at the beginning
  std::optional<InPhase> in(std::in_place, plan_.execution.phases, Phase::Forces);
  begin_frame();
  try {
    while (!frame_.runner.done()) {
      frame_.runner.substep(plan_);
      if (frame_.after_substep) frame_.after_substep();
    }
  } catch (...) {
    drop_frame();
    throw;
  }
  in.reset();
  return finish_frame();
}

bool Lab::step() {
  apply_queue();
  const bool finished = step_frame();
  compute_companions([] { return true; });
  return finished;
}

void Lab::advance(double real_seconds, const std::function<bool()>& should_continue) {
  if (!must_wait_for_frame()) apply_queue();

  bool in_time = compute_companions(should_continue);
  if (clock_.is_running()) {
    const double frame = 1.0 / scene_.settings.frame_rate;
    clock_.accumulate(real_seconds, scene_.settings.speed);
    long stepped = 0;
    while (clock_.is_running() && in_time && (frame_.is_in_progress || clock_.has_frame_due(frame))) {
      std::optional<InPhase> in(std::in_place, plan_.execution.phases, Phase::Forces);
      if (!frame_.is_in_progress) begin_frame();
      while (!frame_.runner.done() && in_time) {
        frame_.runner.substep(plan_);
        // without idle time, a frame is repeated beside the ones that follow
        const long per_repeated = measuring_.meter.is_urgent() ? substeps_per_urgent : substeps_per_repeated;
        const bool repeats = frame_.runner.done() || frame_.runner.substeps_done() % per_repeated == 0;
        if (repeats && measuring_.meter.is_repeating()) {
          const InPhase beside(plan_.execution.phases, Phase::Accuracy);
          measuring_.meter.repeat(scene_.system);
        }
        in_time = should_continue();
      }
      in.reset();
      if (frame_.runner.done()) {
        clock_.consume(frame);
        stepped += finish_frame() ? 1 : 0;
        in_time = in_time && compute_companions(should_continue);
      }
    }
    clock_.update_speed(real_seconds, static_cast<double>(stepped) * frame, frame);
  }
  publish();
}

std::chrono::duration<double> Lab::time_to_next_frame() const {
  const double due = clock_.time_to_next(1.0 / scene_.settings.frame_rate);
  return std::chrono::duration<double>(frame_.is_in_progress ? 0.0 : std::clamp(due / scene_.settings.speed, 0.0, 0.05));
}

}  // namespace hooke
