// What a Lab publishes: once per frame, and with an edit.
#include <algorithm>
#include <limits>

#include "base/printable.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "scene/step_advice.h"

namespace hooke {
namespace {

DocumentStatus document_of(const Scene& scene, const Scene* opened) {
  DocumentStatus document{.name = scene.name,
                          .description = scene.description,
                          .notes = scene.notes,
                          .view = scene.view,
                          .cloth_texture = scene.cloth_texture,
                          .defaults = scene.defaults,
                          .sheet = scene.sheet,
                          .controls = scene.controls,
                          .opened_forces = opened != nullptr ? opened->system.forces : std::vector<Force>(),
                          .parameter_values = {}};
  for (const Parameter& parameter : parameters()) {
    const bool applies = parameter.applies == nullptr || parameter.applies(scene);
    document.parameter_values.push_back(applies ? parameter.read(scene) : std::numeric_limits<double>::quiet_NaN());
  }
  return document;
}

}  // namespace

// Copies for readers are made once per revision, because a System is large and reading the parameters visits all springs.
const std::shared_ptr<const System>& Lab::published_system() {
  if (!published_.system || published_.system_revision != scene_.revision)
    published_.system = std::make_shared<const System>(scene_.system);
  published_.system_revision = scene_.revision;
  return published_.system;
}

const std::shared_ptr<const DocumentStatus>& Lab::published_document() {
  if (!published_.document || published_.document_revision != scene_.revision)
    published_.document = std::make_shared<const DocumentStatus>(document_of(scene_, start_.opened().get()));
  published_.document_revision = scene_.revision;
  return published_.document;
}

std::shared_ptr<const Snapshot> Lab::snapshot() {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->system = published_system();
  snapshot->state = scene_.state;
  snapshot->settings = scene_.settings;
  snapshot->energy = energy_;
  snapshot->momentum = compute_momentum(scene_.system, scene_.state);
  bool any_strain = false;
  for (const Spring& spring : scene_.system.springs()) {
    if (!scene_.system.is_on(spring)) continue;
    const double value = strain(scene_.system, scene_.state, spring);
    snapshot->min_strain = any_strain ? std::min(snapshot->min_strain, value) : value;
    snapshot->max_strain = any_strain ? std::max(snapshot->max_strain, value) : value;
    any_strain = true;
  }
  snapshot->omega = plan_.spectrum.omega;
  const Integrator& method = *scene_.settings.integrator;
  const StepLimits now(plan_.spectrum);
  snapshot->largest_stable_step = now.stable_step(method);
  snapshot->step_limit = now.limit_text(method, scene_.settings.frame_rate);
  snapshot->is_limited_by_contact = now.is_set_by_contact(method);
  if (scene_.settings.substep() > snapshot->largest_stable_step) {
    const Scene& start = start_.scene() ? *start_.scene() : scene_;
    const StepLimits limits(plan_.spectrum, step_needs(start.system, start.state));
    snapshot->recommended_margin = limits.needs().margin;
    snapshot->recommended_substeps = limits.recommended_substeps(method, scene_.settings.frame_rate).value_or(0);
  }
  snapshot->divergence = failure_.divergence();
  return snapshot;
}

RunStatus Lab::run_status() const {
  const bool has_hand = scene_.system.grab || scene_.state.hand.collider;
  return {.running = clock_.is_running(),
          .phase_ms = measuring_.phase_ms,
          .speed = clock_.speed(),
          .frames = tallies_.frames,
          .from = clock_.from(),
          .to = clock_.to(),
          .hand_lag = scene_.system.hand_speed > 0.0 && has_hand ? drag_.lag : 0.0,
          .limit_power = clock_.is_running() ? tallies_.last_limit_work * scene_.settings.frame_rate : 0.0,
          .limit_work = tallies_.limit_work,
          .gas_releases = tallies_.gas_releases.size(),
          .crossings = last_frame().motion().crossings,
          .on_device = frame_.device != nullptr,
          .device_refusal = device_refusal()};
}

TimelineStatus Lab::timeline_status() const {
  const Timeline& timeline = frame_history_.timeline();
  const double now = scene_.state.time;
  return {.start = timeline.empty() ? now : timeline.first_time(),
          .end = timeline.empty() ? now : timeline.last_time(),
          .traces = frame_history_.traces()};
}

void Lab::show_edits(double real_seconds) {
  apply_queue();
  clock_.accumulate(real_seconds, scene_.settings.speed);
  if (clock_.is_running()) clock_.update_speed(real_seconds, 0.0, 1.0 / scene_.settings.frame_rate);
  publish();
}

void Lab::publish() {
  auto status = std::make_shared<Status>();
  status->snapshot = snapshot();
  status->document = published_document();
  status->run = run_status();
  status->history = {.unsaved = history_.has_unsaved_changes(),
                     .edits = tallies_.edits,
                     .undo_name = history_.undo_name(),
                     .redo_name = history_.redo_name(),
                     .list = history_.list()};
  status->timeline = timeline_status();
  status->accuracy = accuracy();
  if (recorder_.file() != nullptr) status->recording.file = printable(recorder_.file()->native());
  status->recording.error = recorder_.error();
  if (playback_.is_on()) status->recording.playback_progress = playback_.progress();
  status->recording.difference = playback_.difference();
  status->diagnosis = failure_.status(start_, scene_, published_system(), tallies_.edits);
  status->companions = companions_.status();
  status->next_point_id = scene_.system.next_point_id();
  status->next_spring_id = scene_.system.next_spring_id();
  published_.status = std::move(status);
}

}  // namespace hooke
