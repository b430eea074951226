// Contact between faces and springs during a frame.
#pragma once

#include <memory>
#include <span>

#include "sim/contact/obstacle.h"
#include "sim/contact/pair_search.h"
#include "sim/forces/motion.h"

namespace hooke {

class SurfaceStep;

// Impulses act at the start of a substep.
inline constexpr int surface_contact_order = 1;

// Corrects a step of any method, after all else that moves points in it: their path within it is taken to be straight. Impulses keep what
// comes closer than the thickness from approaching (surface_response.h). What would pass through each other nevertheless has an inelastic
// impact, found by continuous collision detection on the paths that result, again until there is none; after some passes, what hits each
// other moves together. Hence nothing that is apart at the start of a step meets within it, unless nailed or held points force it to.
// Positions are not changed after that.
//
// What a substep does depends neither on those before it in the frame nor on the margin with which pairs of features are searched.
class SurfaceSolver {
 public:
  // [1], of the length of the edges. Results do not depend on it.
  explicit SurfaceSolver(double relative_margin = 0.25);
  ~SurfaceSolver();
  SurfaceSolver(SurfaceSolver&& other) noexcept;
  SurfaceSolver& operator=(SurfaceSolver&& other) noexcept;

  // Points may have been edited. What passes through each other now is left alone until the next frame.
  void begin_frame();

  // Before other contacts: remembers where the method leads, with its velocities before the strain limit changed them, if it did.
  void begin_substep(const Plan& plan, double velocity_lag, bool kicks_last, const Field* unlimited, const Motion& motion);
  // Corrects the step of h that led from (x0, v0) to the motion. Returns whether anything touched. `near`: pairs of points that may touch
  // each other in it; what features do to them does not press them into each other.
  bool resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Field& x0, const Field& v0,
               double h, Motion& motion);
  // Whether the last call gave up: there are more than PairSolver::max_pairs pairs.
  bool has_failed() const;

  // In this frame, for tests and measurements.
  long searches() const;    // of pairs
  long impacts() const;     // found by continuous collision detection
  long candidates() const;  // pairs

 private:
  double relative_margin_;
  std::unique_ptr<SurfaceStep> step_;  // none: nothing touched yet
};

}  // namespace hooke
