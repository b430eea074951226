// The arrows of velocities and forces at the points.
#pragma once

#include <memory>
#include <optional>

#include "draw/marks.h"
#include "draw/view.h"
#include "sim/plan/plan.h"
#include "sim/step/snapshot.h"

namespace hooke {

// [s]: the arrow of a velocity leads to where the point would be after this time. A round number for which free fall across a view of this
// height [m] gives arrows of a part of it.
double velocity_arrow_seconds(double view_height);

class ForceArrows {
 public:
  // The sum of the forces on each free point, and on each nail what its support must hold; without contact. The largest arrow is up to
  // `longest` [m]. Of a very large scene, none.
  std::optional<Arrows> at(const Snapshot& snapshot, double longest);

 private:
  std::shared_ptr<const System> system_;  // of the plan
  Plan plan_;
};

// The loads of points, and what the options show, for a view of this height [m].
std::vector<Arrows> make_arrows(const Snapshot& snapshot, const ViewOptions& options, double view_height, ForceArrows& forces);

}  // namespace hooke
