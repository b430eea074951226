// The paths of points that may touch each other through one substep, with their impacts in the order of time.
#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "base/disjoint_sets.h"
#include "sim/contact/touch.h"

namespace hooke {

// What touches without approaching at the start of the substep exerts constant forces during it (`settle`). Impacts follow at their times
// on the parabolas: restitution along the normal, and the Coulomb impulse. An impact so slow that all its further bounces would fall within
// the substep has no restitution; what is pushed into others slowly waits for the next substep. Where impacts follow one another without
// end, they lose their restitution first, and then wait for the next substep, too.
class TouchSimulation {
 public:
  void clear() {
    paths.clear();
    touches.clear();
  }
  // In ascending order, of points and of pairs: filled before `begin`.
  std::vector<PointPath> paths;
  std::vector<Touch> touches;

  // Forgets the forces of the last substep, from which those of the next are found.
  void begin_frame() { memory_.last.clear(); }
  // Starts a substep of h [s] under `gravity` [m/s^2].
  void begin(double h, const Vec3& gravity);
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

  void find_resting();
  void rest();
  void settle(std::span<Touch> some, std::span<const std::size_t> active, double tolerance, std::span<Vec3> v);
  void settle_velocities(bool is_correction, double tolerance);
  void recall_loads();
  void find_separation(double tolerance);
  void limit_separation();
  void leave_obstacles();
  void predict(Touch& touch) const;
  void respond();
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
  double rest_speed(const Touch& touch) const;
  double ignored_speed(const Touch& touch) const;
  long max_impacts() const { return 64 + 32 * static_cast<long>(paths.size()); }

  double h_ = 0.0, time_ = 0.0, first_touch_ = 0.0, first_impact_ = 0.0;
  Vec3 gravity_{0.0};  // [m/s^2]
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
  std::vector<char> is_listed_;  // per path: in changed_
  std::vector<Vec3> velocity_;   // per path, while they settle
  // What overlaps.
  struct Separation {
    std::vector<Vec3> displacement;       // [m], per path
    bool any = false;                     // whether any of them is not zero
    DisjointSets groups;                  // paths that rest on each other
    std::vector<double> removed, needed;  // [J], per group, at its first path: energy that contact removes, and that this needs
  };
  Separation separation_;
  mutable Collider ball_{.shape = Sphere{}};  // the second point of a pair
};

}  // namespace hooke
