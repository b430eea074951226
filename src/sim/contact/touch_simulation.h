// The paths of points that may touch each other through one substep, with their impacts in the order of time.
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <span>
#include <vector>

#include "sim/contact/touch.h"
#include "sim/forces/motion.h"

namespace hooke {

// Touches examined, and impulses between two, those of each sweep.
struct TouchCounts {
  long tests = 0, impulses = 0;
  long work() const { return tests + impulses; }
};

// The forces of touches at rest in a substep and in the one before it, as impulses, in ascending order of the points.
struct TouchLoads {
  struct Load {
    std::array<Index, 2> points{};
    ContactImpulse impulse;
  };
  std::vector<Load> last, now;
  double last_h = 0.0;  // [s]
};

// The next impact of a touch: obsolete if the time of the touch has changed since.
struct NextImpact {
  double time = 0.0;  // [s], since the start
  std::size_t touch = 0;
  auto operator<=>(const NextImpact&) const = default;
};

// The touches of path p are touches[first[p]] .. touches[first[p + 1] - 1]. Empty before the first impact.
struct TouchesOfPaths {
  std::vector<std::size_t> first, touches;
};

// What touches without approaching at the start of the substep exerts constant forces during it (`rest`). Impacts follow at their times
// on the parabolas: restitution along the normal, and the Coulomb impulse. An impact so slow that all its further bounces would fall within
// the substep has no restitution; what is pushed into others slowly waits for the next substep. Where impacts follow one another without
// end, they lose their restitution first, and then wait for the next substep, too. Overlaps are removed as those of surfaces, but without a
// velocity.
class TouchSimulation {
 public:
  void clear() {
    paths.clear();
    touches.clear();
    changed_.clear();
  }
  // In ascending order, of points and of pairs: filled before `begin`.
  std::vector<PointPath> paths;
  std::vector<Touch> touches;
  // The path of a point through a step of h [s] from (x0, v0) to (x1, v1), with its mean acceleration.
  void add_point(const Plan& plan, Index i, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double h);
  // Adds the paths of obstacles, after all points; then what a path and an obstacle may touch.
  void add_obstacles(std::span<const Obstacle> obstacles, double h);
  void add_touch(std::size_t path, std::span<const Obstacle> obstacles, std::size_t obstacle, double radius);

  // Moves points out of obstacles, each along the normal.
  void leave_obstacles();

  // Forgets the forces of the last substep, from which those of the next are found.
  void begin_frame() { loads_.last.clear(); }
  // Starts a substep of h [s], in which overlaps are removed as `plan` says.
  void begin(const SurfacePlan& plan, double h);
  // The whole substep of one point among obstacles. What touches is at rest if it neither approaches nor leaves, and after each impact the
  // rest of the substep counts as one of its own: exact for all impacts, and for rest after them.
  void run_alone(const SurfacePlan& plan, double h);
  // Allocates all that this takes.
  void reserve_alone(std::size_t obstacles);
  // Handles the next impact. False: there is none in this substep, and all points are at its end.
  bool advance();
  // The paths that begin, or the last advance, changed.
  std::span<const std::size_t> changed() const { return changed_; }
  double time() const { return time_; }                  // [s], since the start
  const TouchCounts& counts() const { return counts_; }  // since `begin`
  bool any_touched() const { return first_touch_ < never; }
  // [s], since the start; infinity: there was none
  double first_touch() const { return first_touch_; }
  double first_impact() const { return first_impact_; }

 private:
  void start(double h);
  void find_resting();
  void rest();
  void solve_impulses(std::span<const std::size_t> together, double tolerance, std::span<Vec3> v);
  void solve_velocities(std::optional<double> time, double tolerance);
  void leave_corrections();
  void leave_balls();
  void follow_balls();
  void recall_loads();
  void separate(double tolerance);
  void predict(Touch& touch) const;
  void respond();
  void adhere(const Touch& touch);
  void remove_correction(const Touch& touch);
  void find_impacts_with(std::size_t touch);
  void queue_impacts();
  void predict_changed();
  void list_touches_of_paths();
  void change(std::size_t path);
  void change_pushed();
  void clear_changed();

  const Collider& shape_of(const Touch& touch) const;
  Parabola relative_path(const Touch& touch, double t) const;
  Vec3 relative_surface_velocity(const Touch& touch, const Vec3& normal, const Vec3& relative_position) const;
  double velocity_change(const Touch& touch) const;
  double quiet_speed(const Touch& touch) const;
  double rest_speed(const Touch& touch, const Gap& gap, const Parabola& path) const;
  double ignored_speed(const Touch& touch) const;
  bool is_alone() const { return first_obstacle_ == 1; }  // there is one point
  long max_impacts() const { return contact::max_impacts * static_cast<long>(paths.size()); }

  double h_ = 0.0, time_ = 0.0, first_touch_ = never, first_impact_ = never;  // [s]
  double start_ = 0.0;  // [s], of what counts as the substep, since that of the substep
  SoftConstraint soft_;
  std::size_t first_obstacle_ = 0;  // path
  long impacts_ = 0;
  mutable TouchCounts counts_;
  TouchLoads loads_;
  std::vector<NextImpact> queue_;  // a heap, the earliest first
  TouchesOfPaths of_paths_;
  std::vector<std::size_t> active_;           // touches at rest at the start
  std::vector<std::size_t> together_;         // touches with an impact at the same time
  std::vector<std::size_t> changed_;          // paths
  std::vector<Vec3> velocity_;                // [m/s], per path, that impulses change
  std::vector<Vec3> separation_;              // [m], per path, of what overlaps; empty: nothing does
  mutable Collider ball_{.shape = Sphere{}};  // the second point of a pair
};

}  // namespace hooke
