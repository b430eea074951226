// Contact between faces, springs and spheres during a frame.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/obstacle.h"
#include "sim/contact/pair_search.h"
#include "sim/contact/surface/surface_contacts.h"
#include "sim/contact/surface/surface_impacts.h"
#include "sim/forces/motion.h"

namespace hooke {

// Impulses act at the start of a substep.
inline constexpr int surface_contact_order = 1;

// Corrects a step of any method, after all else that moves points in it, as if impulses acted at its start, on the mean velocity
// u = (x1 - x0) / h with which its points move: x1 = x0 + h u', v1 = v + u' - u. What is apart at the start of a substep does not meet
// within it, unless nailed or held points force it to. What a substep does depends on its start and on the impulses of the last one in the
// frame.
class SurfaceSolver {
 public:
  // [1], of the length of the edges: with which pairs of features are searched. Results do not depend on it.
  explicit SurfaceSolver(double relative_margin = 0.25) : detection_(relative_margin) {}

  // Points may have been edited. What passes through each other now is left alone until the next frame.
  void begin_frame();
  // A substep without this contact: where it started, and velocities to which the method led, without any contact and strain limit.
  struct Start {
    const Field &x, &v, &free_v;
    double velocity_lag = 0.0;  // [1], of the method (integrator.h)
  };
  // Corrects the step of h that led from the start to the motion. `near`: pairs of points that may touch each other in it; what features do
  // to them does not press them into each other. Returns whether anything touched.
  bool resolve(const Plan& plan, std::span<const Obstacle> obstacles, std::span<const PointPair> near, const Start& start, double h,
               Motion& motion);
  // [J], of contact in the substep, in addition to that of the forces: as the state has it, and what it does more, because its impulses act
  // at the velocity that belongs to the position.
  double work() const { return work_; }
  double lag_work() const { return lag_work_; }
  // Whether the last call gave up: there are too many pairs, or impacts.
  bool has_failed() const { return has_failed_; }

  // Searches of pairs in this frame, for tests and measurements.
  long searches() const { return detection_.searches(); }

 private:
  bool load(const Plan& plan, const Field& x0, double h, const Motion& motion);
  void start_frame(const Plan& plan);
  void mark_points();
  void add_obstacle(const Plan& plan, const Obstacle& obstacle, Index number, double h, const Motion& motion);
  bool prevent_impacts(const Plan& plan, std::span<const Obstacle> obstacles, double h);
  bool stop_lowest(const Plan& plan, std::span<const Obstacle> obstacles, double h);
  void find_rebounds(const Plan& plan, const Start& start, double h, const Motion& motion);
  void write(const Plan& plan, const Start& start, double h, Motion& motion);

  SurfaceDetection detection_;
  SurfaceContacts contacts_;
  SurfaceImpacts impacts_;
  double work_ = 0.0, lag_work_ = 0.0;  // [J]
  bool has_failed_ = false;
  Index held_ = no_index;             // the held point
  std::vector<Index> local_;          // per point of the scene: of the surface; no_index: not on it
  std::vector<double> inverse_mass_;  // [1/kg], per point of the surface, as all of the following; and of obstacles that they touch
  std::vector<Vec3> x_, arm_;         // [m], at the start of the substep, and x1 - h v1
  std::vector<Vec3> free_u_, u_;      // [m/s], of the path without and with this contact; the latter of obstacles, too
  std::vector<Vec3> velocity_;        // [m/s], at the end, of obstacles, too
  std::vector<char> is_marked_;
  std::vector<Index> stopped_;  // points at obstacles, which impacts do not move any more
  struct Inside {
    Index k = 0;
    double start = 0.0;  // [m], the distance from the obstacle at the start
    Vec3 change{0.0};    // [m/s], of its path, to its surface
  };
  std::vector<Inside> inside_;  // points in obstacles
};

}  // namespace hooke
