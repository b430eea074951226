// Parts of a scene to be put in again: duplicated, or carried as text through the clipboard.
#pragma once

#include <functional>
#include <string>

#include "edit/command.h"
#include "scene/selection.h"
#include "sim/snapshot.h"

namespace hooke {

// The selected points, the ends of the selected springs, the springs between selected points and the faces on all these;
// as a scene of its own. `sheet` is what the scene's cloths are made of; null: it has none.
Scene copy_selection(const Snapshot& snapshot, const std::shared_ptr<const SheetWeights>& sheet, const Selection& selection);

// Where new things get their ids from.
struct IdSource {
  std::function<PointId()> point;
  std::function<SpringId()> spring;
};

// Puts points, springs and faces of `part` in, moved by `way` [m], all with new ids.
Insert make_insert(const Scene& part, const Vec3& displacement, const IdSource& ids);

// The middle of the box around its points [m]; it must have some.
Vec3 bounding_box_center(const Scene& part);

}  // namespace hooke
