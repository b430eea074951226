#include "edit/copy_selection.h"

#include <algorithm>

namespace hooke {

Scene copy_selection(const Snapshot& snapshot, const std::shared_ptr<const SheetWeights>& sheet, const Selection& selection) {
  const System& system = *snapshot.system;
  const Selection existing = existing_part_of(system, selection);

  std::vector<bool> is_selected(system.points().size(), false);
  for (const PointId id : existing.points) is_selected[system.index_of(id)] = true;
  for (const SpringId id : existing.springs) {
    const Spring& spring = system.springs()[system.index_of(id)];
    is_selected[system.index_of(spring.first)] = is_selected[system.index_of(spring.second)] = true;
  }
  const auto is_point_selected = [&](PointId id) { return is_selected[system.index_of(id)]; };

  // in the order of the scene, so that a copy is computed in the same order
  Scene part;
  part.name = "Part of a scene";
  part.system.dimensions = system.dimensions;
  part.sheet = sheet;  // by id, so it applies unchanged
  for (Index i = 0; i < system.point_count(); ++i) {
    if (!is_selected[i]) continue;
    part.system.append_point(system.points()[i]);
    part.state.position.push_back(snapshot.state.position[i]);
    part.state.velocity.push_back(snapshot.state.velocity[i]);
  }
  // a spring between two selected points is included, selected or not
  for (const Spring& spring : system.springs()) {
    const bool is_included = existing.contains(spring.id) || (existing.contains(spring.first) && existing.contains(spring.second));
    if (is_included) part.system.append_spring(spring);
  }
  for (const Face& face : system.faces)
    if (std::ranges::all_of(face.points, is_point_selected)) part.system.faces.push_back(face);
  return part;
}

Insert make_insert(const Scene& part, const Vec3& displacement, const IdSource& ids) {
  Insert insert;
  std::vector<PointId> new_id(part.system.points().size());
  for (Index i = 0; i < part.system.point_count(); ++i) {
    Point point = part.system.points()[i];
    point.id = new_id[i] = ids.point();
    const double area = area_of(part.sheet.get(), part.system.points()[i].id);
    insert.points.push_back({no_index, point, part.state.position[i] + displacement, part.state.velocity[i], area});
  }
  const auto new_id_of = [&](PointId id) { return new_id[part.system.index_of(id)]; };
  for (Spring spring : part.system.springs()) {
    const double sheet_weight = sheet_weight_of(part.sheet.get(), spring.id);
    spring.id = ids.spring();
    spring.first = new_id_of(spring.first);
    spring.second = new_id_of(spring.second);
    insert.springs.push_back({no_index, spring, sheet_weight});
  }
  for (Face face : part.system.faces) {
    for (PointId& id : face.points) id = new_id_of(id);
    insert.faces.push_back({no_index, face});
  }
  return insert;
}

}  // namespace hooke
