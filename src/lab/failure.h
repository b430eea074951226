// Why a run stopped, and what may have caused it: the divergence, the edits shortly before it, and a state from before the energy grew.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edit/history.h"
#include "lab/start.h"
#include "lab/status.h"
#include "lab/timeline.h"
#include "sim/plan/plan.h"

namespace hooke {

class Failure {
 public:
  // Forgets everything at the start of a run, at a time of the scene [s].
  void restart(double time);

  // Whether the last frame diverged and nothing has resolved it since.
  bool is_known() const { return divergence_.has_value(); }
  const std::optional<Divergence>& divergence() const { return divergence_; }
  // The frame from `scene` diverged.
  void set(const Divergence& divergence, const Scene& scene, const Plan& plan, const Timeline& timeline);
  void resolve() { divergence_.reset(); }
  // Whether the step was beyond the limit of the method and, after an edit, no longer is.
  bool is_step_mended(const Scene& scene, const Plan& plan) const;

  // A frame did not diverge: whether its energy was supplied to the scene decides what a later failure may be due to.
  void add_frame(const Scene& scene, double energy);
  // `before`: the value that the command sets, before it was applied. The commands of one drag are one change.
  void add_change(const Command& command, const std::string& before, const std::vector<Command>& inverse, Gesture gesture,
                  const Scene& scene);

  // For panels. `edits`: of the scene; the start of the failed run is computed once for each.
  DiagnosisStatus status(const Start& start, const Scene& scene, std::shared_ptr<const System> system, long edits);

 private:
  // An edit that affects the motion, with the gesture that it is part of and the time [s] of the run.
  struct RecordedChange {
    RecentChange change;
    std::string before;
    Gesture gesture = 0;
    double time = 0.0;
  };

  std::optional<Divergence> divergence_;  // why the last frame failed, until an edit or a good frame resolves it
  bool was_unstable_ = false;             // its step was beyond the limit of the method
  std::shared_ptr<const State> before_;   // a recorded state from before the energy grew; null: none
  std::shared_ptr<const Scene> start_;    // the start of the failed run, with later edits applied; null: not computed
  long start_edits_ = 0;                  // the number of edits in it
  std::vector<RecordedChange> changes_;   // since the energy was last explained, oldest first
  double explained_until_ = 0.0;          // [s], the last frame whose energy was supplied to the scene
};

}  // namespace hooke
