#include "app/work/ghost_runs.h"

#include <algorithm>

#include "base/file_limits.h"
#include "study/companion_settings.h"

namespace hooke {

void GhostRuns::set(const SetGhosts& wish, const Status& status, LabThread& lab) {
  const bool had_none = !wish_.with_reference && wish_.settings.empty();
  wish_ = wish;
  if (had_none && !wish_.with_reference && wish_.settings.empty()) return;
  submit(status, lab);
}

void GhostRuns::follow(const Status& status, LabThread& lab) {
  if ((wish_.with_reference || !wish_.settings.empty()) && status.history.edits != edits_) submit(status, lab);
}

void GhostRuns::submit(const Status& status, LabThread& lab) {
  edits_ = status.history.edits;
  std::vector<Companion> companions;
  const Snapshot& snapshot = *status.snapshot;
  if (wish_.with_reference) companions.push_back(reference_companion(snapshot.state, snapshot.settings));
  for (const Settings& settings : wish_.settings) companions.push_back(companion_of(settings));
  lab.submit(SetCompanions{std::move(companions)});
}

Settings first_ghost(Settings now) {
  now.substeps = std::min(4 * now.substeps, max_substeps);
  return now;
}

}  // namespace hooke
