// What a Lab says of itself, once a frame.
#include <algorithm>
#include <limits>

#include "base/printable.h"
#include "lab/lab.h"
#include "scene/parameters.h"

namespace hooke {

std::shared_ptr<const Snapshot> Lab::snapshot() {
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
    snapshot->min_strain = std::min(snapshot->min_strain, value);
    snapshot->max_strain = std::max(snapshot->max_strain, value);
  }
  snapshot->omega = plan_.spectrum.omega;
  snapshot->largest_stable_step = largest_stable_step(*scene_.settings.integrator, plan_.spectrum);
  snapshot->divergence = divergence_;
  return snapshot;
}

void Lab::publish() {
  auto status = std::make_shared<Status>();
  status->snapshot = snapshot();
  status->scene_name = scene_.name;
  status->scene_description = scene_.description;
  status->view = scene_.view;
  status->cloth_texture = scene_.cloth_texture;
  status->defaults = scene_.defaults;
  status->sheet = scene_.sheet;
  status->controls = scene_.controls;
  for (const Parameter& parameter : parameters()) {
    const bool applies = parameter.applies == nullptr || parameter.applies(scene_);
    status->parameter_values.push_back(applies ? parameter.read(scene_) : std::numeric_limits<double>::quiet_NaN());
  }
  status->hand_lag = scene_.system.hand_speed > 0.0 && (scene_.system.grab || scene_.state.hand.collider) ? hand_lag_ : 0.0;
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
  status->speed = running_ ? frame_pacer_.speed() : 0.0;
  status->frames = frames_;
  const Timeline& timeline = frame_history_.timeline();
  status->timeline_start = timeline.empty() ? scene_.state.time : timeline.first_time();
  status->timeline_end = timeline.empty() ? scene_.state.time : timeline.last_time();
  status->traces = frame_history_.traces();
  if (run_to_) {
    status->run_from = run_from_;
    status->run_to = *run_to_;
  }
  if (recorder_.file() != nullptr) status->recording = printable(recorder_.file()->native());
  status->recording_error = recorder_.error();
  if (playback_.is_on()) status->playback_progress = playback_.progress();
  status->difference = playback_.difference();
  status->next_point_id = scene_.system.next_point_id();
  status->next_spring_id = scene_.system.next_spring_id();
  status_ = std::move(status);
}

}  // namespace hooke
