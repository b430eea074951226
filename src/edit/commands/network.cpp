#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <span>

#include "base/file_limits.h"
#include "base/finite.h"
#include "base/text_lines.h"
#include "edit/command.h"
#include "edit/commands/validity.h"
#include "edit/in_plane.h"
#include "scene/parameter_groups.h"
#include "scene/parameters.h"

namespace hooke {
namespace {

bool is_sheet_weight(double sheet_weight) { return sheet_weight >= 0.0 && std::isfinite(sheet_weight); }

template <class Item>
std::vector<Item> select(const std::vector<Item>& list, std::span<const Index> indices) {
  std::vector<Item> selected;
  selected.reserve(indices.size());
  for (const Index i : indices) selected.push_back(list[i]);
  return selected;
}
SpringList select(const SpringList& list, std::span<const Index> indices) { return list.select(indices); }
FaceList select(const FaceList& list, std::span<const Index> indices) { return list.select(indices); }

// Inserts each item at its index, indices ascending; no_index and indices beyond the end append.
template <class List, class Item = typename List::value_type>
List merged(List list, const std::vector<std::pair<Index, Item>>& inserted) {
  const auto size = static_cast<Index>(list.size());
  std::vector<Index> indices;
  indices.reserve(list.size() + inserted.size());
  auto next = inserted.begin();
  for (Index i = 0; i < size; ++i) {
    for (; next != inserted.end() && next->first == static_cast<Index>(indices.size()); ++next)
      indices.push_back(size + static_cast<Index>(next - inserted.begin()));
    indices.push_back(i);
  }
  const bool is_appended = next == inserted.begin();
  for (; next != inserted.end(); ++next) indices.push_back(size + static_cast<Index>(next - inserted.begin()));
  for (const auto& [at, item] : inserted) list.push_back(item);
  if (is_appended) return list;
  return select(list, indices);
}

// The items whose flag is not set.
template <class List>
List without(const List& list, const std::vector<bool>& removed) {
  std::vector<Index> indices;
  indices.reserve(list.size());
  for (Index i = 0; i < static_cast<Index>(list.size()); ++i)
    if (!removed[i]) indices.push_back(i);
  return select(list, indices);
}

std::string count_all(std::size_t points, std::size_t springs) {
  if (springs == 0) return pluralize(points, "point", "points");
  if (points == 0) return pluralize(springs, "spring", "springs");
  return pluralize(points, "point", "points") + " and " + pluralize(springs, "spring", "springs");
}

// The contact of the scene becomes this one. Returns what restores it.
Inverse set_contact(Scene& scene, const PairContact& contact) {
  const Scene before = scene;
  scene.system.contact = contact;
  Inverse inverse;
  for (const Parameter& row : parameters())
    if (row.group == parameter_group::contact && row.read(before) != row.read(scene))
      inverse.emplace_back(RestoreParameter{&row, row.read(before)});
  return inverse;
}

}  // namespace

std::string Insert::describe() const {
  if (points.empty() && springs.size() == 1) return "attach";
  return "add " + count_all(points.size(), springs.size());
}

Inverse Insert::apply(Scene& scene, Effect& effect) const {
  System& system = scene.system;
  State& state = scene.state;
  Remove inverse;
  SheetEdit sheet(scene.sheet);

  std::vector<std::pair<Index, Point>> new_points;
  std::vector<std::pair<Index, Vec3>> positions, velocities;
  std::set<PointId> point_ids;
  for (const PlacedPoint& placed : points) {
    if (system.points().size() + new_points.size() == max_points) break;
    if (system.index_of(placed.point.id) != no_index || point_ids.contains(placed.point.id) || !is_valid(placed.point) ||
        !is_finite(placed.position) || !is_finite(placed.velocity))
      continue;
    point_ids.insert(placed.point.id);
    new_points.emplace_back(placed.at, placed.point);
    positions.emplace_back(placed.at, in_plane(system, placed.position));
    velocities.emplace_back(placed.at, in_plane(system, placed.velocity));
    inverse.points.push_back(placed.point.id);
    if (is_sheet_weight(placed.area)) sheet.set(placed.point.id, placed.area);
  }
  if (!new_points.empty()) {
    system.set_points(merged(system.points(), new_points));
    state.position = merged(state.position, positions);
    state.velocity = merged(state.velocity, velocities);
  }

  std::vector<std::pair<Index, Spring>> new_springs;
  std::set<SpringId> spring_ids;
  for (const PlacedSpring& placed : springs) {
    if (system.springs().size() + new_springs.size() == max_springs) break;
    const Spring& spring = placed.spring;
    const bool has_ends = system.index_of(spring.first) != no_index && system.index_of(spring.second) != no_index;
    if (system.index_of(spring.id) != no_index || spring_ids.contains(spring.id) || !has_ends || !is_valid(spring)) continue;
    spring_ids.insert(spring.id);
    new_springs.emplace_back(placed.at, spring);
    inverse.springs.push_back(spring.id);
    if (is_sheet_weight(placed.sheet_weight)) sheet.set(spring.id, placed.sheet_weight);
  }
  if (!new_springs.empty()) system.set_springs(merged(system.springs(), new_springs));

  std::vector<std::pair<Index, Face>> new_faces;
  for (const PlacedFace& placed : faces) {
    if (system.faces.size() + new_faces.size() == max_faces) break;
    const auto& corners = placed.face.points;
    if (is_valid(placed.face) && std::all_of(corners.begin(), corners.end(), [&](PointId id) { return system.index_of(id) != no_index; }))
      new_faces.emplace_back(placed.at, placed.face);
  }
  for (const auto& [at, face] : new_faces) inverse.faces.push_back(face);
  if (!new_faces.empty()) system.faces = merged(system.faces, new_faces);

  Inverse all{inverse};
  if (contact && is_valid(*contact) && system.contact == PairContact{})
    for (Command& restore : set_contact(scene, *contact)) all.push_back(std::move(restore));

  effect.structure = true;
  return all;
}

std::string Remove::describe() const {
  if (points.empty() && springs.empty()) return "delete " + pluralize(faces.size(), "face", "faces");
  if (!faces.empty()) return "cut";
  return "delete " + count_all(points.size(), springs.size());
}

Inverse Remove::apply(Scene& scene, Effect& effect) const {
  System& system = scene.system;
  State& state = scene.state;
  Insert inverse;
  const std::shared_ptr<const SheetWeights> before = scene.sheet;
  SheetEdit sheet(scene.sheet);

  std::vector<bool> is_point_removed(system.points().size(), false), is_spring_removed(system.springs().size(), false);
  for (const PointId id : points)
    if (const Index i = system.index_of(id); i != no_index) is_point_removed[i] = true;
  for (const SpringId id : springs)
    if (const Index s = system.index_of(id); s != no_index) is_spring_removed[s] = true;
  const auto is_removed = [&](PointId id) { return !points.empty() && is_point_removed[system.index_of(id)]; };

  for (Index s = 0; s < system.spring_count(); ++s) {
    const Spring& spring = system.springs()[s];
    is_spring_removed[s] = is_spring_removed[s] || is_removed(spring.first) || is_removed(spring.second);
    if (!is_spring_removed[s]) continue;
    inverse.springs.push_back({s, spring, sheet_weight_of(before.get(), spring.id)});
    sheet.set(spring.id, 0.0);
  }
  // of equal faces, remove as many as are named, last ones first
  std::map<std::array<PointId, 3>, long> named;
  for (const Face& face : faces) ++named[face.points];
  std::vector<bool> is_face_removed(system.faces.size(), false);
  for (std::size_t f = system.faces.size(); f-- > 0 && !named.empty();) {
    const auto found = named.find(system.faces[f].points);
    is_face_removed[f] = found != named.end() && found->second-- > 0;
  }
  for (std::size_t f = 0; f < system.faces.size(); ++f) {
    const auto& corners = system.faces[f].points;
    is_face_removed[f] = is_face_removed[f] || std::any_of(corners.begin(), corners.end(), is_removed);
    if (is_face_removed[f]) inverse.faces.push_back({static_cast<Index>(f), system.faces[f]});
  }
  for (Index i = 0; i < system.point_count(); ++i) {
    if (!is_point_removed[i]) continue;
    const Point& point = system.points()[i];
    inverse.points.push_back({i, point, state.position[i], state.velocity[i], area_of(before.get(), point.id)});
    sheet.set(point.id, 0.0);
  }

  if (system.grab && std::ranges::any_of(points_of(*system.grab), is_removed)) system.grab.reset();
  if (!inverse.faces.empty()) system.faces = without(system.faces, is_face_removed);
  if (!inverse.springs.empty()) system.set_springs(without(system.springs(), is_spring_removed));
  if (!inverse.points.empty()) {
    system.set_points(without(system.points(), is_point_removed));
    state.position = without(state.position, is_point_removed);
    state.velocity = without(state.velocity, is_point_removed);
  }

  effect.structure = true;
  return {inverse};
}

}  // namespace hooke
