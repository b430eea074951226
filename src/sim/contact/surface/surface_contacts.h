// The contacts of surfaces in a substep, and the impulses that they exert.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "sim/contact/impulse.h"
#include "sim/contact/surface/surface_detection.h"

namespace hooke {

// The sum of weight times vector over these points: of the first of two features, as seen from the second.
inline Vec3 relative_vector(const std::array<Index, 4>& points, const std::array<double, 4>& w, std::span<const Vec3> field) {
  return w[0] * field[points[0]] + w[1] * field[points[1]] + w[2] * field[points[2]] + w[3] * field[points[3]];
}

// Two features that touch or may do so within the substep. Velocities are relative: of the first as seen from the second. Two points are
// a contact with the weights 1 and -1, and so are a point and an obstacle, which counts as a nailed point with the velocity of its surface.
struct SurfaceContact {
  std::array<Index, 4> points{};
  std::array<double, 4> weight{};
  ContactLaw law;          // its impulse: so far in the substep; from an obstacle in addition to earlier ones
  double thickness = 0.0;  // [m], the distance at which they touch
  double gap = 0.0;        // [m], at the start, distance less thickness
  Index pair = 0;          // of the detection, or from `obstacle` on, that of the obstacle
  Index last = no_index;   // in the memory of the last substep
  FeaturePair kind = FeaturePair::PointFace;

  static constexpr Index two_points = SurfaceDetection::max_pairs, obstacle = two_points + 1;
  bool is_on_obstacle() const { return pair >= obstacle; }

  Vec3 relative(std::span<const Vec3> field) const { return relative_vector(points, weight, field); }
  void apply(const Vec3& impulse, std::span<const double> inverse_mass, std::span<Vec3> velocity) const {
    for (int c = 0; c < 4; ++c) velocity[points[c]] += inverse_mass[points[c]] * weight[c] * impulse;
  }
  // Sets the mass. False: nothing can move these points.
  bool weigh(std::span<const double> inverse_mass);
  // [1/kg], the velocity per impulse of the point that moves fastest.
  double fastest(std::span<const double> inverse_mass) const;
  // Limits the impulse, once the target is set, if one of these points is held: it moves others by a lever. `u`: velocities.
  void limit(std::span<const double> inverse_mass, Index held, std::span<const Vec3> u);
};

// What a contact has in common with that of the last substep, and the impulses of that.
struct SurfaceKey {
  FeaturePair kind = FeaturePair::PointFace;
  Index pair = 0;
  std::array<Index, 4> points{};
};
struct SurfaceMemory {
  SurfaceKey key;
  ContactImpulse path, end;
};

// One projected Gauss-Seidel, first on the velocities with which points are about to move, then on those at the end of the substep.
class SurfaceContacts {
 public:
  // What a substep is about.
  struct Step {
    const SurfacePlan& plan;
    std::span<const double> inverse_mass;  // [1/kg], per point of the surface, as all of the following, and of obstacles
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

  // Changes the velocities of the paths so that nothing gets closer than the thickness within the substep, and removes overlaps: starts
  // from the impulses of the last substep.
  void solve_paths(const Step& step, std::span<Vec3> u);
  // Changes the velocities at the end: what has touched does not approach, what has been pushed apart stops, and what had an impact leaves
  // with its target. `u`: of the paths that result.
  void solve_ends(const Step& step, std::span<const Vec3> u, std::span<Vec3> velocity);

  // For the next substep; solve_ends does so, too.
  void remember(const Step& step);

  // Those of obstacles after all others, in ascending order; after solve_paths, those alone that exert impulses or may touch at the end.
  std::vector<SurfaceContact> all;
  long impulses = 0;  // computed, since it was set

 private:
  void add(const Step& step, SurfaceContact& contact);
  void recall(const Step& step);
  void move(const Step& step, std::span<const Vec3> u);
  void sweep(const Step& step, std::span<SurfaceContact> contacts, std::span<Vec3> velocity);

  std::vector<SurfaceMemory> last_;            // those that exerted impulses
  std::vector<ContactImpulse> path_impulses_;  // per contact that touches
  std::vector<Vec3> end_x_;                    // [m], at the end of the paths
  FeatureBlock block_;
  long list_ = 0, last_list_ = 0;  // SurfaceDetection::list_number
  double last_h_ = 0.0;            // [s]; 0: there are none
};

}  // namespace hooke
