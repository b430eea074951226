// What a Lab publishes: once per frame, and with an edit.
#include <algorithm>
#include <limits>

#include "base/printable.h"
#include "lab/divergence_message.h"
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
  if (!published_system_ || published_system_revision_ != scene_.revision)
    published_system_ = std::make_shared<const System>(scene_.system);
  published_system_revision_ = scene_.revision;
  return published_system_;
}

const std::shared_ptr<const DocumentStatus>& Lab::published_document() {
  if (!published_document_ || published_document_revision_ != scene_.revision)
    published_document_ = std::make_shared<const DocumentStatus>(document_of(scene_, opened_.get()));
  published_document_revision_ = scene_.revision;
  return published_document_;
}

std::shared_ptr<const Snapshot> Lab::snapshot() {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->system = published_system();
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
  snapshot->divergence = divergence_;
  return snapshot;
}

RunStatus Lab::run_status() const {
  const bool has_hand = scene_.system.grab || scene_.state.hand.collider;
  return {.running = running_,
          .simulate_ms = simulate_ms_,
          .speed = running_ ? frame_pacer_.speed() : 0.0,
          .frames = frames_,
          .from = run_to_ ? run_from_ : 0.0,
          .to = run_to_.value_or(0.0),
          .hand_lag = scene_.system.hand_speed > 0.0 && has_hand ? hand_lag_ : 0.0,
          .limit_power = running_ ? last_limit_work_ * scene_.settings.frame_rate : 0.0,
          .limit_work = limit_work_,
          .gas_releases = gas_releases_.size(),
          .crossings = last_frame().motion().crossings};
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
  if (running_) {
    frame_pacer_.accumulate(real_seconds, scene_.settings.speed);
    frame_pacer_.update_speed(real_seconds, 0.0, 1.0 / scene_.settings.frame_rate);
  }
  publish();
}

void Lab::publish() {
  auto status = std::make_shared<Status>();
  status->snapshot = snapshot();
  status->document = published_document();
  status->run = run_status();
  status->history = {.unsaved = history_.has_unsaved_changes(),
                     .edits = edits_,
                     .undo_name = history_.undo_name(),
                     .redo_name = history_.redo_name(),
                     .list = history_.list()};
  status->timeline = timeline_status();
  status->accuracy = accuracy();
  if (recorder_.file() != nullptr) status->recording.file = printable(recorder_.file()->native());
  status->recording.error = recorder_.error();
  if (playback_.is_on()) status->recording.playback_progress = playback_.progress();
  status->recording.difference = playback_.difference();
  if (divergence_) {
    status->diagnosis.message = describe(*divergence_, scene_.system);
    status->diagnosis.is_too_large = divergence_->kind == Divergence::Kind::MatrixTooLarge;
    if (start_.scene() != nullptr) {
      // a copy of the scene, made once for each edit
      if (failed_start_ == nullptr || failed_start_edits_ != edits_) {
        failed_start_ = std::make_shared<const Scene>(start_.return_from(scene_));
        failed_start_edits_ = edits_;
      }
      status->diagnosis.failed = FailedRun{.start = failed_start_,
                                           .system = published_system(),
                                           .before = before_failure_,
                                           .settings = scene_.settings,
                                           .time = divergence_->time,
                                           .changes = {}};
      for (auto recorded = changes_.rbegin(); recorded != changes_.rend(); ++recorded)
        status->diagnosis.failed->changes.push_back(recorded->change);
    }
  }
  status->companions = companions_.status();
  status->next_point_id = scene_.system.next_point_id();
  status->next_spring_id = scene_.system.next_spring_id();
  status_ = std::move(status);
}

}  // namespace hooke
