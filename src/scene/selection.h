// The selection of the user. Ids in ascending order without duplicates.
#pragma once

#include <optional>
#include <vector>

#include "sim/model/system.h"

namespace hooke {

struct Selection {
  std::vector<PointId> points;
  std::vector<SpringId> springs;
  std::optional<Index> collider{};  // alone

  bool has_parts() const { return !points.empty() || !springs.empty(); }
  bool empty() const { return !has_parts() && !collider; }
  bool contains(PointId id) const;
  bool contains(SpringId id) const;
  void toggle(PointId id);
  void toggle(SpringId id);
  void add(const Selection& other);
  bool operator==(const Selection&) const = default;
};

Selection select_all(const System& system);

// Everything that is not selected.
Selection invert_selection(const System& system, const Selection& selection);

// The selection and everything connected to it through springs and faces.
Selection select_connected(const System& system, const Selection& selection);

// These points, and the springs between them.
Selection select_with_springs_between(const System& system, std::vector<PointId> points);

// The part of the selection that still exists in the system.
Selection existing_part_of(const System& system, const Selection& selection);

// The springs that an edit of the selection affects: selected springs, and those between selected points.
std::vector<SpringId> affected_springs(const System& system, const Selection& selection);

}  // namespace hooke
