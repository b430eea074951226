// Tears of a run: how broken springs are removed and restored, and the tears between two states.
#pragma once

#include <span>
#include <vector>

#include "edit/command.h"

namespace hooke {

// Removes broken springs of the System and the faces that have one of them as an edge.
Remove removal_of_broken(const System& system, std::span<const SpringId> broken);

// The tears between two indices (State::torn): those to undo, latest first, then those to repeat, earliest first. Both indices must be
// valid or 0.
struct TearPath {
  std::vector<std::uint32_t> undone, torn;
  bool empty() const { return undone.empty() && torn.empty(); }
};
TearPath path_between(const Scene& scene, std::uint32_t from, std::uint32_t to);

Insert restored_by_undo(const Tear& tear);
Remove removal_of_tear(const Tear& tear);

}  // namespace hooke
