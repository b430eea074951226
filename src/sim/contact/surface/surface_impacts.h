// Continuous collision detection: what would pass through each other within a substep nevertheless has an impact.
#pragma once

#include <span>
#include <vector>

#include "sim/contact/surface/surface_detection.h"

namespace hooke {

class SurfaceImpacts {
 public:
  void begin_frame() { excess_ = 0; }
  void begin_substep() {
    distances_ = 0;
    has_failed_ = false;
  }
  // Changes the velocities u [m/s] of the paths from x that lead through each other in h [s]: by inelastic impacts, again until there is
  // none; after some passes, what meets moves together. The paths that remain are free of impacts, unless points that are fixed or `held`
  // force features through each other.
  void prevent(const SurfacePlan& plan, SurfaceDetection& detection, std::span<const double> inverse_mass, std::span<const Vec3> x,
               double h, Index held, std::span<Vec3> u);
  // Whether the last call gave up: it takes too much work, or there are too many pairs.
  bool has_failed() const { return has_failed_; }
  long distances() const { return distances_; }  // computed in this substep

 private:
  void respond(const MeetingFeatures& pair, std::span<const double> inverse_mass, std::span<const Vec3> x, double time, Index held,
               std::span<Vec3> u);
  bool join(const std::array<Index, 4>& points, std::span<const double> inverse_mass, std::span<Vec3> u);

  std::vector<Index> zone_;  // per point: the first of those that move together; empty: none do
  bool has_failed_ = false;
  long distances_ = 0;
  long excess_ = 0;  // distances of earlier substeps of the frame, beyond what is usual
};

}  // namespace hooke
