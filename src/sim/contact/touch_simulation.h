// The paths of points that may touch each other through one substep, with their impacts in the order of time.
#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "sim/contact/touch.h"
#include "sim/forces/motion.h"

namespace hooke {

// What touches without approaching at the start of the substep exerts constant forces during it (`settle`). Impacts follow at their times
// on the parabolas: restitution along the normal, and the Coulomb impulse. An impact so slow that all its further bounces would fall within
// the substep has no restitution; what is pushed into others slowly waits for the next substep. Where impacts follow one another without
// end, they lose their restitution first, and then wait for the next substep, too. Overlaps are removed as those of surfaces, but without a
// velocity.
class TouchSimulation {
 public:
  void clear() {
    paths.clear();
    touches.clear();
  }
  // In ascending order, of points and of pairs: filled before `begin`.
  std::vector<PointPath> paths;
  std::vector<Touch> touches;
  // The path of a point through a step of h [s] from (x0, v0) to (x1, v1), with its mean acceleration.
  void add_point(const Plan& plan, Index i, const Vec3& x0, const Vec3& v0, const Vec3& x1, const Vec3& v1, double h);
  // Those of obstacles, after all points; and what a path and one of them may touch.
  void add_obstacles(std::span<const Obstacle> obstacles, double h);
  void add_touch(std::size_t path, std::span<const Obstacle> obstacles, std::size_t obstacle, double radius);

  // Moves points out of obstacles, each along the normal.
  void leave_obstacles();

  // Forgets the forces of the last substep, from which those of the next are found.
  void begin_frame() { memory_.last.clear(); }
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
  double time() const { return time_; }  // [s], since the start
  // Since `begin`: touches that were examined, and impulses.
  long tests() const { return tests_; }
  long impulses() const { return impulses_; }
  long work() const { return tests_ + impulses_; }
  bool any_touched() const { return any_touched_; }
  double first_touch() const { return first_touch_; }    // [s], since the start
  double first_impact() const { return first_impact_; }  // [s], since the start; infinity: there was none

 private:
  // The forces of a touch at rest in the last substep, as impulses.
  struct Load {
    std::array<Index, 2> points{};
    ContactImpulse impulse;
  };

  void start(double h);
  void find_resting();
  void rest();
  void settle(std::span<Touch> some, std::span<const std::size_t> active, double tolerance, std::span<Vec3> v);
  enum class Settled { Starts, Corrections, Ends };
  void settle_velocities(Settled what, double tolerance);
  void leave_corrections();
  void leave_balls();
  void follow_balls();
  void recall_loads();
  void separate(double tolerance);
  void predict(Touch& touch) const;
  void respond();
  void adhere(const Touch& touch);
  void remove_correction(const Touch& touch, const Vec3& normal);
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
  long max_impacts() const { return contact::max_impacts * static_cast<long>(paths.size()); }

  double h_ = 0.0, time_ = 0.0, first_touch_ = 0.0, first_impact_ = 0.0;
  double start_ = 0.0;     // [s], of what counts as the substep, since that of the substep
  bool is_alone_ = false;  // there is one point
  SoftConstraint soft_;
  std::size_t first_obstacle_ = 0;  // path
  long impacts_ = 0;
  mutable long tests_ = 0;
  long impulses_ = 0;
  bool any_touched_ = false;
  struct Memory {
    std::vector<Load> last, now;  // in ascending order
    double last_h = 0.0;
  };
  Memory memory_;
  // The next impact of a touch: obsolete if the time of the touch is another one by now.
  struct Impact {
    double time = 0.0;  // [s], since the start
    std::size_t touch = 0;
    auto operator<=>(const Impact&) const = default;
  };
  std::vector<Impact> queue_;  // a heap, the earliest first
  // Per path: its touches are those from `first` on to that of the next path. Empty before the first impact.
  struct TouchesOfPaths {
    std::vector<std::size_t> first, touches, end;
  };
  TouchesOfPaths of_paths_;
  std::vector<std::size_t> active_;  // touches at rest at the start
  // Impacts at the same time.
  struct Together {
    std::vector<Touch> touches;
    std::vector<std::size_t> of, all;  // the touches that these are, and 0, 1, 2, ...
  };
  Together together_;
  std::vector<std::size_t> changed_;
  std::vector<char> is_listed_;               // per path: in changed_
  std::vector<Vec3> velocity_;                // per path, while they settle
  std::vector<Vec3> separation_;              // [m], per path, of what overlaps; empty: nothing does
  mutable Collider ball_{.shape = Sphere{}};  // the second point of a pair
};

}  // namespace hooke
