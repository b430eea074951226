// The contacts of surfaces in a substep, and the impulses that they exert.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "sim/contact/impulse.h"
#include "sim/contact/obstacle.h"
#include "sim/contact/pair_search.h"
#include "sim/contact/surface/surface_detection.h"

namespace hooke {

// Two features that touch or may do so within the substep. Velocities are relative: of the first as seen from the second.
struct SurfaceContact {
  std::array<Index, 4> points{};
  std::array<double, 4> weight{};
  Vec3 normal{0.0};                                              // from the second to the first
  double thickness = 0.0;                                        // [m], the distance at which they touch
  double mass = 0.0;                                             // [kg], impulse per relative velocity
  double target = 0.0;                                           // [m/s], the minimum relative velocity along the normal
  double max_push = std::numeric_limits<double>::infinity();     // [N s], the maximum impulse that separates what does not approach
  double max_impulse = std::numeric_limits<double>::infinity();  // [N s]
  ContactImpulse impulse;                                        // so far in the substep
  double gap = 0.0;                                              // [m], at the start, distance less thickness
  Index pair = 0;                                                // of the detection
  Index last = no_index;                                         // in the memory of the last substep
  FeaturePair kind = FeaturePair::PointFace;
};

// A point of a contact that may reach an obstacle. Impulses are in addition to those that it has had from the obstacle.
struct ObstacleContact {
  Index point = 0;
  Index obstacle = 0;
  Vec3 normal{0.0};
  double gap = 0.0;            // [m], at the end of the path, before it is changed
  double path_velocity = 0.0;  // [m/s], along the normal, of that path
  double end_velocity = 0.0;   // [m/s], along the normal, of the obstacle at the end
  double target = 0.0;         // [m/s]
  double friction = 0.0;       // [1]
  Vec3 surface{0.0};           // [m/s]
  ContactImpulse impulse, path_impulse;
};

// One projected Gauss-Seidel, first on the velocities with which points are about to move, then on those at the end of the substep.
class SurfaceContacts {
 public:
  // What a substep is about.
  struct Step {
    const SurfacePlan& plan;
    std::span<const double> inverse_mass;  // [1/kg], per point of the surface, as all of the following
    std::span<const Vec3> x;               // [m], at the start
    std::span<const Vec3> arm;             // [m], x1 - h v1 (SurfaceSolver)
    std::span<const Vec3> u;               // [m/s], of the paths without contact
    double h = 0.0;                        // [s]
    Index held = no_index;
  };

  // Forgets the impulses of the last substep.
  void begin_frame();
  // Of the pairs that are near, those that may touch, in their order.
  void make(const Step& step, const SurfaceDetection& detection);
  // Adds two points that touch each other at this distance [m].
  void add_points(const Step& step, Index i, Index j, double distance);
  void add_obstacle(const ObstacleContact& contact) { obstacles.push_back(contact); }

  // Changes the velocities of the paths so that nothing gets closer than the thickness within the substep, and removes overlaps: starts
  // from the impulses of the last substep.
  void solve_paths(const Step& step, std::span<Vec3> u);
  // Changes the velocities at the end: what has touched does not approach, what has been pushed apart stops, and what had an impact leaves
  // with its target. `u`: of the paths that result.
  void solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity);

  // For the next substep; solve_ends does so, too.
  void remember(const Step& step);
  // [N s], the sum of the normal impulses on this point by surfaces.
  double impulses_on(Index point) const;

  std::vector<SurfaceContact> surface;   // of the paths
  std::vector<SurfaceContact> touching;  // those of them that exert impulses or may touch at the end, and then those at the end
  std::vector<ObstacleContact> obstacles;
  long impulses = 0;  // computed, since it was set

 private:
  struct ContactImpulses {
    ContactImpulse path, end;
  };
  // A contact of the last substep. Those of points come after all pairs of features.
  struct Memory {
    FeaturePair kind = FeaturePair::PointFace;
    Index pair = 0;
    std::array<Index, 4> points{};
    ContactImpulses impulses;
  };
  struct ObstacleMemory {
    std::pair<Index, Index> key;  // point and obstacle
    ContactImpulses impulses;
  };
  void add(const Step& step, SurfaceContact& contact);
  void recall(const Step& step);
  void recall_obstacles(double factor);
  void move(const Step& step, std::span<const Vec3> u);
  void sweep(const Step& step, std::span<SurfaceContact> contacts, std::span<Vec3> velocity);

  std::vector<Memory> last_;  // those that exerted impulses
  std::vector<ObstacleMemory> last_obstacles_;
  std::vector<ContactImpulse> path_impulses_;  // per contact that touches
  std::vector<ContactImpulse> obstacle_end_;   // per contact with an obstacle, of the last substep: what solve_ends starts with
  std::vector<Vec3> end_x_;                    // [m], at the end of the paths
  FeatureBlock block_;
  long list_ = 0, last_list_ = 0;  // SurfaceDetection::list_number
  double last_h_ = 0.0;            // [s]; 0: there are none
};

}  // namespace hooke
