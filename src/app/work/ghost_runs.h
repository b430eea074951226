// Keeps the runs beside the run on screen as wished: after an edit they start again from its present state.
#pragma once

#include "lab/lab_thread.h"
#include "ui/requests.h"

namespace hooke {

class GhostRuns {
 public:
  void set(const SetGhosts& wish, const Status& status, LabThread& lab);
  // Once per frame.
  void follow(const Status& status, LabThread& lab);

 private:
  void submit(const Status& status, LabThread& lab);

  SetGhosts wish_;
  long edits_ = 0;  // of the scene when they were last submitted
};

// The settings that a comparison starts with: four times the substeps.
Settings first_ghost(Settings now);

}  // namespace hooke
