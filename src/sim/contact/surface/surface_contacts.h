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
  double gap = 0.0;                                              // [m], at the start, distance less thickness
  double response = 0.0;                                         // [1/kg], relative velocity per impulse
  double target = 0.0;                                           // [m/s], the minimum relative velocity along the normal
  double max_push = 0.0;                                         // [N s], the maximum impulse that separates what does not approach
  double max_impulse = std::numeric_limits<double>::infinity();  // [N s]
  double rebound = 0.0;                                          // [m/s], the relative velocity after an impact; 0: there is none
  ContactImpulse impulse;                                        // so far in the substep
  ContactImpulse path_impulse;                                   // the part of it that acts on the path
  Index pair = no_index;                                         // of the detection; no_index: of two points that touch each other
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
  // Changes the velocities at the end: nothing that touches approaches, what has been pushed apart stops, and what had an impact rebounds.
  // `u`: of the paths that result.
  void solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity);

  std::vector<SurfaceContact> surface;
  std::vector<ObstacleContact> obstacles;
  long impulses = 0;  // computed, since it was set

 private:
  struct ContactImpulses {
    ContactImpulse path, end;
  };
  struct Memory {
    FeaturePair kind = FeaturePair::PointFace;
    Index pair = no_index;
    std::array<Index, 4> points{};
    ContactImpulses impulses;
  };
  struct ObstacleMemory {
    std::pair<Index, Index> key;  // point and obstacle
    ContactImpulses impulses;
  };
  void add(const Step& step, SurfaceContact contact);
  void remember(const Step& step);
  void recall(const Step& step);
  void move(const Step& step, std::span<const Vec3> u);
  void sweep(const Step& step, int count, std::span<Vec3> velocity);

  // contacts of the last substep that exerted impulses: of features, of points that touch each other, and with obstacles
  std::vector<Memory> last_, last_points_;
  std::vector<ObstacleMemory> last_obstacles_;
  std::vector<ContactImpulse> end_;  // per contact, of the last substep: what solve_ends starts with
  std::vector<ContactImpulse> obstacle_end_;
  std::vector<Vec3> end_x_;  // [m], at the end of the paths
  FeatureBlock block_;
  long list_ = 0, last_list_ = 0;  // SurfaceDetection::list_number
  double last_h_ = 0.0;            // [s]; 0: there are none
};

}  // namespace hooke
