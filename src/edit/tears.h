// What tore in a run: how it is taken away, put back, and how one gets from as torn as it was at one moment to another.
#pragma once

#include <span>
#include <vector>

#include "edit/command.h"

namespace hooke {

// What goes when springs of the System break: they, and the faces that have one of them for an edge.
Remove removal_of_broken(const System& system, std::span<const SpringId> broken);

// The tears between two of them (State::torn): those to be mended, the latest first, and then those to be torn again, the
// earliest first. Both must be of the scene, or 0.
struct TearPath {
  std::vector<std::uint32_t> undone, torn;
  bool empty() const { return undone.empty() && torn.empty(); }
};
TearPath path_between(const Scene& scene, std::uint32_t from, std::uint32_t to);

Insert restored_by_undo(const Tear& tear);
Remove removal_of_tear(const Tear& tear);

}  // namespace hooke
