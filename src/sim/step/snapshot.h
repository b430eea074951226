// The result of a frame, published once per frame and never changed. Drawing and panels see nothing else of the
// simulation.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/forces/energy/energy.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"
#include "sim/step/divergence.h"

namespace hooke {

struct Snapshot {
  std::shared_ptr<const System> system;  // shared until the next edit
  State state;
  Settings settings;
  Energy energy;
  Momentum momentum;
  double min_strain = 0.0, max_strain = 0.0;  // [1], over all springs
  double omega = 0.0;                         // [rad/s], bound on the highest frequency
  double largest_stable_step = 0.0;           // [s], linear limit of this method on this scene; 0: none, infinity: any step
  std::string step_limit;                     // the same in words (StepLimits::limit_text)
  bool is_limited_by_contact = false;         // contact sets it, not the linear modes
  int recommended_margin = 0;                 // (integrator.h) of the start of the run; 0: the step is within the limit
  int recommended_substeps = 0;               // per frame, likewise, also for passages through the cores of forces, and colliders
  std::optional<Divergence> divergence;       // the last frame was rejected; state is the one before it

  const Vec3& position(PointId id) const { return state.position[system->index_of(id)]; }
};

}  // namespace hooke
