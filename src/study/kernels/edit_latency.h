// How long an edit of a running cloth takes to be seen: `bench --edits`.
#pragma once

#include <span>
#include <string_view>

#include "edit/command.h"
#include "scene/scene.h"

namespace hooke {

struct EditCase {
  std::string_view name;
  // The edit number k of this scene, of a point, a spring or a value that none before concerns.
  Command (*command)(const Scene& scene, int k);
};
std::span<const EditCase> edit_cases();

// A cloth of n x n points that hangs from two corners, with velocity_verlet and 2.25 n substeps per frame, within the limit of any
// deformation.
Scene make_edited_cloth(int n);

// From the moment when the window passes an edit on until the state that it draws next contains it [s], the median of `count` edits of the
// running scene, each at another time of a frame.
double measure_edit(const EditCase& row, const Scene& scene, int count);

}  // namespace hooke
