#include "lab/failure.h"

#include <algorithm>
#include <utility>

#include "lab/change_text.h"
#include "lab/divergence_message.h"
#include "sim/methods/step_limits.h"

namespace hooke {
namespace {

bool is_beyond_limit(const Scene& scene, const Plan& plan) {
  return scene.settings.substep() > StepLimits(plan.spectrum).stable_step(*scene.settings.integrator);
}

}  // namespace

void Failure::restart(double time) {
  *this = {};
  explained_until_ = time;
}

void Failure::set(const Divergence& divergence, const Scene& scene, const Plan& plan, const Timeline& timeline) {
  constexpr double margin = 0.5;  // [s]
  divergence_ = divergence;
  was_unstable_ = is_beyond_limit(scene, plan);
  before_ = timeline.empty() ? nullptr : timeline.at(timeline.find(std::min(explained_until_, scene.state.time) - margin));
  start_.reset();
}

bool Failure::is_step_mended(const Scene& scene, const Plan& plan) const {
  return divergence_ && was_unstable_ && !is_beyond_limit(scene, plan);
}

void Failure::add_frame(const Scene& scene, double energy) {
  divergence_.reset();
  constexpr double explained_fraction = 0.02;
  const EnergySupply& supply = scene.state.supply;
  if (energy - supply.net_input <= explained_fraction * supply.scale) explained_until_ = scene.state.time;
}

void Failure::add_change(const Command& command, const std::string& before, const std::vector<Command>& inverse, Gesture gesture,
                         const Scene& scene) {
  constexpr std::size_t max_changes = 100;
  constexpr double margin = 1.0;  // [s]
  std::erase_if(changes_, [&](const RecordedChange& each) { return each.time < explained_until_ - margin; });
  if (changes_.size() >= max_changes) changes_.erase(changes_.begin());
  if (gesture != 0 && !changes_.empty() && changes_.back().gesture == gesture &&
      std::ranges::equal(changes_.back().change.restore, inverse,
                         [](const Command& first, const Command& later) { return is_undone_with(later, first); })) {
    changes_.back().change.text = change_text(command, changes_.back().before, scene);
    changes_.back().time = scene.state.time;
    return;
  }
  changes_.push_back(
      {.change = {change_text(command, before, scene), inverse}, .before = before, .gesture = gesture, .time = scene.state.time});
}

DiagnosisStatus Failure::status(const Start& start, const Scene& scene, std::shared_ptr<const System> system, long edits) {
  DiagnosisStatus status;
  if (!divergence_) return status;
  status.message = describe(*divergence_, scene.system);
  status.is_too_large = divergence_->kind == Divergence::Kind::MatrixTooLarge;
  if (start.scene() == nullptr) return status;
  if (start_ == nullptr || start_edits_ != edits) {
    start_ = std::make_shared<const Scene>(start.return_from(scene));
    start_edits_ = edits;
  }
  status.failed = FailedRun{.start = start_,
                            .system = std::move(system),
                            .before = before_,
                            .settings = scene.settings,
                            .time = divergence_->time,
                            .changes = {}};
  for (auto recorded = changes_.rbegin(); recorded != changes_.rend(); ++recorded) status.failed->changes.push_back(recorded->change);
  return status;
}

}  // namespace hooke
