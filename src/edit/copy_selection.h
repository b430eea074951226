// Copies parts of a scene, to duplicate them or to pass them through the clipboard as text.
#pragma once

#include <functional>

#include "edit/command.h"
#include "scene/selection.h"
#include "sim/step/snapshot.h"

namespace hooke {

// The selected points, the ends of the selected springs, the springs between selected points and the faces between all these, as a separate
// scene. `sheet` describes the cloths of the scene; null: there are none.
Scene copy_selection(const Snapshot& snapshot, const std::shared_ptr<const SheetWeights>& sheet, const Selection& selection);

// The source of new ids.
struct IdSource {
  std::function<PointId()> point;
  std::function<SpringId()> spring;
};

// Inserts the points, springs and faces of `part`, moved by `displacement` [m], all with new ids.
Insert make_insert(const Scene& part, const Vec3& displacement, const IdSource& ids);

}  // namespace hooke
