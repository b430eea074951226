// The path of one point through a step among obstacles: impacts, slides and rest.
#pragma once

#include <limits>
#include <span>

#include "sim/contact/gap.h"
#include "sim/contact/supports.h"

namespace hooke {

// A path ends after so many segments: under friction, a point may stop again and again in ever shorter times.
inline constexpr int max_path_segments = 64;

// The motion of one point through a step.
class PointContactSolver {
 public:
  Vec3 x, v;
  double first_touch = 0.0;  // [s], since the start, of the first impact on anything; 0 if something is touched at the start
  double first_impact = std::numeric_limits<double>::infinity();  // [s], since the start, whatever is touched before
  // [m/s^2], by which a plane holds the point after an impact without a rebound (forces/terms/sticking.h); 0: it does not. To be set before
  // `advance`.
  double adhesion = 0.0;
  Vec3 push_out{0.0};  // [m], out of obstacles in which the point was at the start: part of its displacement
  // [m^2/s^2], kinetic energy per mass along the path. A correction that supports balance from the start is no motion, nor is its end a
  // loss.
  double gained = 0.0;

  // `velocity_lag` [1]: of the method (integrator.h). `friction_lag` [1]: the same if its path is kept under friction, too; otherwise 0.
  PointContactSolver(std::span<const Obstacle> obstacles, double radius, const Vec3& x0, const Vec3& v0, double velocity_lag = 0.0,
                     double friction_lag = 0.0)
      : x(x0), v(v0), obstacles_(obstacles), radius_(radius), velocity_lag_(velocity_lag), friction_lag_(friction_lag) {}

  // Advances by `duration` with the acceleration `a`. `velocity_correction` [m/s]: of the method's path, relative to v at its start.
  // Returns whether anything was touched.
  bool advance(const Vec3& a, const Vec3& velocity_correction, double duration);

 private:
  // A part of the path with constant acceleration: supports and friction do not change.
  struct Segment {
    Vec3 acceleration;
    double time;               // [s]
    bool stops;                // at the end, under friction
    bool sticks;               // to its support, and moves with it
    Support support;           // that it rests on or slides on, the mean of several; none: no obstacle
    Vec3 velocity_correction;  // [m/s], at its start
  };

  bool resolve_penetration();
  Vec3 held_acceleration(const Vec3& a) const;
  Supports find_supports(const Vec3& a, double duration) const;
  bool apply_velocity_correction(const Vec3& velocity_correction, const Supports& supports);
  Segment plan_segment(Supports& supports, const Vec3& a, double remaining, double friction_lag) const;
  const Obstacle* advance_segment(Segment& segment, const Supports& supports);
  void follow_surface(const Segment& segment, const Vec3& start, const Vec3& a);
  bool project_onto_supports(const Supports& supports);
  void bounce(const Obstacle& obstacle, const Vec3& a, double remaining);

  Gap gap_to(const Obstacle& obstacle) const { return hooke::gap_to(*obstacle.collider, radius_, x - obstacle.offset_at(time_)); }
  // Of the shape, and of its surface where the point is.
  Vec3 velocity_of(const Obstacle& obstacle) const {
    return obstacle.velocity_at(time_) + (applies_correction_ ? obstacle.velocity_correction : Vec3(0.0));
  }
  Vec3 surface_velocity_of(const Obstacle& obstacle, const Vec3& normal) const {
    return velocity_of(obstacle) + relative_surface_velocity(obstacle, normal, x - obstacle.offset_at(time_));
  }

  std::span<const Obstacle> obstacles_;
  double radius_;
  double time_ = 0.0;              // [s], since the start of the step
  Vec3 velocity_correction_{0.0};  // [m/s], contained in v
  double velocity_lag_, friction_lag_;
  const Obstacle* sticks_to_ = nullptr;  // the plane that holds the point after an impact
  bool applies_correction_ = false;      // whether v and the velocities of obstacles contain their corrections
};

}  // namespace hooke
