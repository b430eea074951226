#include "lab/excerpt.h"

#include <algorithm>
#include <cassert>
#include <glm/common.hpp>

namespace hooke {

Scene excerpt(const Snapshot& snapshot, const std::shared_ptr<const SheetShares>& sheet, const Selection& selection) {
  const System& system = *snapshot.system;
  const Selection meant = still_there(system, selection);

  std::vector<bool> wanted(system.points().size(), false);
  for (const PointId id : meant.points) wanted[system.index_of(id)] = true;
  for (const SpringId id : meant.springs) {
    const Spring& spring = system.springs()[system.index_of(id)];
    wanted[system.index_of(spring.first)] = wanted[system.index_of(spring.second)] = true;
  }
  const auto is_wanted = [&](PointId id) { return wanted[system.index_of(id)]; };

  // in the order of the scene, so that what is put in again is computed in the same order
  Scene part;
  part.name = "Part of a scene";
  part.system.dimensions = system.dimensions;
  part.sheet = sheet;  // by id: the same
  for (Index i = 0; i < system.point_count(); ++i) {
    if (!wanted[i]) continue;
    part.system.append_point(system.points()[i]);
    part.state.position.push_back(snapshot.state.position[i]);
    part.state.velocity.push_back(snapshot.state.velocity[i]);
  }
  // a spring between two selected points comes along, whether it was selected or not
  for (const Spring& spring : system.springs()) {
    const bool chosen = meant.contains(spring.id) || (meant.contains(spring.first) && meant.contains(spring.second));
    if (chosen) part.system.append_spring(spring);
  }
  for (const Face& face : system.faces)
    if (std::ranges::all_of(face.points, is_wanted)) part.system.faces.push_back(face);
  return part;
}

Insert insertion_of(const Scene& part, const Vec3& way, const NewIds& ids) {
  Insert insert;
  std::vector<PointId> renamed(part.system.points().size());
  for (Index i = 0; i < part.system.point_count(); ++i) {
    Point point = part.system.points()[i];
    point.id = renamed[i] = ids.point();
    const double area = area_of(part.sheet.get(), part.system.points()[i].id);
    insert.points.push_back({no_index, point, part.state.position[i] + way, part.state.velocity[i], area});
  }
  const auto new_name = [&](PointId id) { return renamed[part.system.index_of(id)]; };
  for (Spring spring : part.system.springs()) {
    const double share = share_of(part.sheet.get(), spring.id);
    spring.id = ids.spring();
    spring.first = new_name(spring.first);
    spring.second = new_name(spring.second);
    insert.springs.push_back({no_index, spring, share});
  }
  for (Face face : part.system.faces) {
    for (PointId& id : face.points) id = new_name(id);
    insert.faces.push_back({no_index, face});
  }
  return insert;
}

Vec3 middle_of(const Scene& part) {
  const auto& positions = part.state.position;
  assert(!positions.empty());
  Vec3 least = positions.front(), most = least;
  for (const Vec3& position : positions) {
    least = glm::min(least, position);
    most = glm::max(most, position);
  }
  return 0.5 * (least + most);
}

}  // namespace hooke
