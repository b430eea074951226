#include "scene/selection.h"

#include <algorithm>
#include <iterator>

#include "base/disjoint_sets.h"

namespace hooke {
namespace {

template <class Id>
bool holds(const std::vector<Id>& ids, Id id) {
  return std::ranges::binary_search(ids, id);
}

template <class Id>
void flip(std::vector<Id>& ids, Id id) {
  const auto at = std::ranges::lower_bound(ids, id);
  if (at != ids.end() && *at == id)
    ids.erase(at);
  else
    ids.insert(at, id);
}

template <class Id>
std::vector<Id> union_of(const std::vector<Id>& a, const std::vector<Id>& b) {
  std::vector<Id> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

template <class List>
auto ids_of(const List& items) {
  std::vector<decltype(List::value_type::id)> ids;
  ids.reserve(items.size());
  for (const auto& item : items) ids.push_back(item.id);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace

bool Selection::contains(PointId id) const { return holds(points, id); }
bool Selection::contains(SpringId id) const { return holds(springs, id); }
void Selection::toggle(PointId id) { flip(points, id), collider.reset(); }
void Selection::toggle(SpringId id) { flip(springs, id), collider.reset(); }

void Selection::add(const Selection& other) {
  points = union_of(points, other.points);
  springs = union_of(springs, other.springs);
  if (has_parts()) collider.reset();
}

Selection select_all(const System& system) { return {ids_of(system.points()), ids_of(system.springs())}; }

Selection invert_selection(const System& system, const Selection& selection) {
  const Selection all = select_all(system);
  Selection result;
  std::ranges::set_difference(all.points, selection.points, std::back_inserter(result.points));
  std::ranges::set_difference(all.springs, selection.springs, std::back_inserter(result.springs));
  return result;
}

Selection select_connected(const System& system, const Selection& selection) {
  DisjointSets sets(system.points().size());
  const auto root_of = [&](PointId id) { return sets.root(system.index_of(id)); };
  const auto join = [&](PointId first, PointId second) { sets.join(system.index_of(first), system.index_of(second)); };
  for (const Spring& spring : system.springs()) join(spring.first, spring.second);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) join(id, face.points[0]);

  std::vector<bool> is_reached(system.points().size(), false);
  const Selection start = existing_part_of(system, selection);
  for (const PointId id : start.points) is_reached[root_of(id)] = true;
  for (const SpringId id : start.springs) is_reached[root_of(system.springs()[system.index_of(id)].first)] = true;

  Selection found;
  for (const Point& point : system.points())
    if (is_reached[root_of(point.id)]) found.points.push_back(point.id);
  for (const Spring& spring : system.springs())
    if (is_reached[root_of(spring.first)]) found.springs.push_back(spring.id);
  std::ranges::sort(found.points);
  std::ranges::sort(found.springs);
  return found;
}

Selection select_with_springs_between(const System& system, std::vector<PointId> points) {
  std::ranges::sort(points);
  Selection selection{std::move(points), {}};
  for (const Spring& spring : system.springs())
    if (selection.contains(spring.first) && selection.contains(spring.second)) selection.springs.push_back(spring.id);
  std::ranges::sort(selection.springs);
  return selection;
}

Selection existing_part_of(const System& system, const Selection& selection) {
  Selection result;
  std::ranges::copy_if(selection.points, std::back_inserter(result.points), [&](PointId id) { return system.index_of(id) != no_index; });
  std::ranges::copy_if(selection.springs, std::back_inserter(result.springs), [&](SpringId id) { return system.index_of(id) != no_index; });
  if (selection.collider && *selection.collider < static_cast<Index>(system.colliders.size())) result.collider = selection.collider;
  return result;
}

std::vector<SpringId> affected_springs(const System& system, const Selection& selection) {
  return union_of(selection.springs, select_with_springs_between(system, selection.points).springs);
}

}  // namespace hooke
