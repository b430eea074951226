// The paths of points that may touch each other through one substep, with their impacts in the order of time.
#pragma once

#include <array>
#include <compare>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "sim/contact/gap.h"
#include "sim/contact/impulse.h"
#include "sim/contact/obstacle.h"
#include "sim/forces/motion.h"

namespace hooke {

inline constexpr std::size_t no_path = std::numeric_limits<std::size_t>::max();
inline constexpr double never = std::numeric_limits<double>::infinity();  // [s]

// The path of a point, or of an obstacle, through a substep: a parabola from `time` on.
struct PointPath {
  Index point = no_index;         // of an obstacle, from -2 down: the same in every substep
  double inverse_mass = 0.0;      // [1/kg]; 0: it follows its path whatever it touches
  double time = 0.0;              // [s], since the start of the substep
  Vec3 x{0.0}, v{0.0}, a{0.0};    // [m], [m/s], [m/s^2]
  Vec3 velocity_correction{0.0};  // [m/s], of the method's path, contained in v (contact.cpp)
  Vec3 free_correction{0.0};      // [m/s], of that path without contact
  Vec3 free_acceleration{0.0};    // [m/s^2], without contact
  double velocity_change = 0.0;   // [m/s], of the whole substep without contact
  double drag = 0.0;              // [1/s]
  double work_of_forces = 0.0;    // [m^2/s^2], per mass, up to start_x
  // [m/s^2], by which a sticky plane holds it after an impact without a rebound (forces/terms/sticking.h); 0: it does not
  double adhesion = 0.0;
  Vec3 held{0.0};  // [m/s^2], that it balances
  // [m], [m/s], at the start of the substep, or at the last impact; v with the part of the correction that contacts at rest leave, without
  // work, at the start
  Vec3 start_x{0.0}, start_v{0.0};
  bool is_changed = false;  // by contact
  Vec3 displaced{0.0};      // [m], until the end of the substep, by the changes of velocity of impacts with a rebound
  bool is_listed = false;   // among the paths of TouchSimulation::changed

  Vec3 position(double t) const { return x + (t - time) * (v + 0.5 * (t - time) * a); }
  Vec3 velocity(double t) const { return v + (t - time) * a; }
  void advance(double t) {
    x = position(t);
    v = velocity(t);
    time = t;
  }
  // An impact changes the velocity, and with it the drag until the end of the substep.
  void rebound(const Vec3& velocity, double end) {
    if (drag > 0.0) {
      work_of_forces += glm::dot(free_acceleration, x - start_x);
      start_x = x;
      const Vec3 change = change_of_drag(drag, end - time, velocity - v);
      a += change;
      free_acceleration += change;
    }
    v = velocity;
  }
  // [J], of contact so far, in addition to that of the forces: m (v^2 - v0^2) / 2 - m a (x - x0).
  double contact_work() const {
    const double kinetic = 0.5 * (glm::dot(v, v) - glm::dot(start_v, start_v));
    return (kinetic - work_of_forces - glm::dot(free_acceleration, x - start_x)) / inverse_mass;
  }
};

// A point and another point or an obstacle, which it touches where their distance is `distance`.
struct Touch {
  std::size_t first = no_path, second = no_path;  // paths, the second perhaps that of an obstacle
  const Obstacle* obstacle = nullptr;
  double distance = 0.0;                     // [m]: for a pair, the sum of both radii and the thickness; for an obstacle, the radius
  double restitution = 0.0;                  // [1]
  double time = never;                       // [s], of the next impact
  bool is_near = false, is_at_rest = false;  // at the start of the substep; and since then
  bool waits = false;                        // for the next substep, unless it approaches fast
  bool rebounds = false;                     // from the impact in progress

  // for the impulses of contacts at rest and of impacts
  ContactLaw law;
  double gap = 0.0;        // [m]
  double curvature = 0.0;  // [1/m], of the path of the first about the second, and its axes, as in Gap
  Vec3 curved{1.0};
  Vec3 surface{0.0};  // [m/s], of the surface of an obstacle relative to its shape

  // [m], by which the shape is inflated: pairs are a point and a ball of the distance
  double inflation() const { return obstacle != nullptr ? distance : 0.0; }
};

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
  // Adds what two paths may touch at this distance [m]; the paths of obstacles, after all points; then what a path and an obstacle may.
  void add_pair(std::size_t first, std::size_t second, double distance, double restitution, double friction);
  void add_obstacles(std::span<const Obstacle> obstacles, double h);
  void add_touch(std::size_t path, const Obstacle& obstacle, std::size_t number, double radius);

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

  std::array<Index, 2> points_of(const Touch& touch) const { return {paths[touch.first].point, paths[touch.second].point}; }
  const Collider& shape_of(const Touch& touch) const;
  Parabola relative_path(const Touch& touch, double t) const;
  Vec3 relative_surface_velocity(const Touch& touch, const Vec3& normal, const Vec3& relative_position) const;
  double velocity_change(const Touch& touch) const;
  double quiet_speed(const Touch& touch) const;
  double rest_speed(const Touch& touch, const Gap& gap, const Parabola& path) const;
  double ignored_speed(const Touch& touch) const;
  bool is_alone() const { return first_obstacle_ == 1; }  // there is one point
  long max_impacts() const { return contact::max_impacts * (is_alone() ? 1 : static_cast<long>(paths.size())); }

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
