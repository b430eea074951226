#include "lab/selection.h"

#include <algorithm>
#include <iterator>

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
