// How a scene is stepped: method, frame rate, substeps and speed.
#pragma once

#include <optional>

namespace hooke {

struct Integrator;

// The default method, `velocity_verlet` (integrator.cpp).
const Integrator& default_integrator();

struct Settings {
  const Integrator* integrator = &default_integrator();
  double frame_rate = 60.0;  // [1/s], > 0: a frame is 1 / frame_rate of simulated time
  int substeps = 20;         // per frame, >= 1
  int iterations = 10;       // per substep, >= 1, of methods whose iterations are a parameter
  double speed = 1.0;        // simulated seconds per real second, > 0
  // [m], > 0: local error allowed a step of an adaptive method; with `auto`, the error that a simulated second may add
  std::optional<double> tolerance;
  double budget_ms = 0.0;  // [ms], of a frame, by the model of the cost of `auto` (control/cost_model.h); 0: no limit
  // In a frame that is computed again to measure its error: substeps end where a spring is about to break. In no file.
  bool locates_breaks = false;
  // Drag and dashpots are in the energy ledger of the frame, at the cost of about a force evaluation for each substep. In no file.
  bool measures_damping = false;
  bool operator==(const Settings&) const = default;

  double substep() const { return 1.0 / (frame_rate * substeps); }
};

}  // namespace hooke
