#include "lab/selection.h"

#include <algorithm>
#include <iterator>
#include <numeric>

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
std::vector<Id> united(const std::vector<Id>& a, const std::vector<Id>& b) {
  std::vector<Id> both;
  std::ranges::set_union(a, b, std::back_inserter(both));
  return both;
}

template <class Item>
auto ids_of(const std::vector<Item>& items) {
  std::vector<decltype(Item::id)> ids;
  ids.reserve(items.size());
  for (const Item& item : items) ids.push_back(item.id);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace

bool Selection::contains(PointId id) const { return holds(points, id); }
bool Selection::contains(SpringId id) const { return holds(springs, id); }
void Selection::toggle(PointId id) { flip(points, id); }
void Selection::toggle(SpringId id) { flip(springs, id); }

void Selection::add(const Selection& other) {
  points = united(points, other.points);
  springs = united(springs, other.springs);
}

Selection everything(const System& system) { return {ids_of(system.points()), ids_of(system.springs())}; }

Selection inverted(const System& system, const Selection& selection) {
  const Selection all = everything(system);
  Selection rest;
  std::ranges::set_difference(all.points, selection.points, std::back_inserter(rest.points));
  std::ranges::set_difference(all.springs, selection.springs, std::back_inserter(rest.springs));
  return rest;
}

Selection connected(const System& system, const Selection& selection) {
  // every piece of the net under one of its points: union by the way to it, shortened as it is walked
  std::vector<Index> piece(static_cast<std::size_t>(system.point_count()));
  std::iota(piece.begin(), piece.end(), 0);
  const auto piece_of = [&](PointId id) {
    Index i = system.index_of(id);
    while (piece[i] != i) i = piece[i] = piece[piece[i]];
    return i;
  };
  for (const Spring& spring : system.springs()) piece[piece_of(spring.first)] = piece_of(spring.second);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) piece[piece_of(id)] = piece_of(face.points[0]);

  std::vector<bool> wanted(piece.size(), false);
  const Selection start = still_there(system, selection);
  for (const PointId id : start.points) wanted[piece_of(id)] = true;
  for (const SpringId id : start.springs) wanted[piece_of(system.springs()[system.index_of(id)].first)] = true;

  Selection found;
  for (const Point& point : system.points())
    if (wanted[piece_of(point.id)]) found.points.push_back(point.id);
  for (const Spring& spring : system.springs())
    if (wanted[piece_of(spring.first)]) found.springs.push_back(spring.id);
  std::ranges::sort(found.points);
  std::ranges::sort(found.springs);
  return found;
}

Selection with_springs_between(const System& system, std::vector<PointId> points) {
  std::ranges::sort(points);
  Selection selection{std::move(points), {}};
  for (const Spring& spring : system.springs())
    if (selection.contains(spring.first) && selection.contains(spring.second)) selection.springs.push_back(spring.id);
  std::ranges::sort(selection.springs);
  return selection;
}

Selection still_there(const System& system, const Selection& selection) {
  Selection rest;
  std::ranges::copy_if(selection.points, std::back_inserter(rest.points), [&](PointId id) { return system.index_of(id) != no_index; });
  std::ranges::copy_if(selection.springs, std::back_inserter(rest.springs), [&](SpringId id) { return system.index_of(id) != no_index; });
  return rest;
}

std::vector<SpringId> springs_meant(const System& system, const Selection& selection) {
  return united(selection.springs, with_springs_between(system, selection.points).springs);
}

}  // namespace hooke
