#include "sim/system.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hooke {
namespace {

template <class Item>
void renumber(const std::vector<Item>& items, std::vector<Index>& index_by_id, Index from) {
  for (Index i = from; i < static_cast<Index>(items.size()); ++i) index_by_id[static_cast<std::uint32_t>(items[i].id)] = i;
}

template <class Item>
void insert(std::vector<Item>& items, std::vector<Index>& index_by_id, std::uint32_t& next_id, Index at, const Item& item) {
  const auto id = static_cast<std::uint32_t>(item.id);
  assert(at >= 0 && at <= static_cast<Index>(items.size()));
  next_id = std::max(next_id, id + 1);
  if (index_by_id.size() <= id) index_by_id.resize(id + 1, no_index);
  assert(index_by_id[id] == no_index);
  items.insert(items.begin() + at, item);
  renumber(items, index_by_id, at);
}

template <class Item>
void set(std::vector<Item>& items, std::vector<Index>& index_by_id, std::uint32_t& next_id, std::vector<Item> list) {
  for (const Item& item : list) next_id = std::max(next_id, static_cast<std::uint32_t>(item.id) + 1);
  index_by_id.assign(next_id, no_index);
  items = std::move(list);
  renumber(items, index_by_id, 0);
}

Index look_up(const std::vector<Index>& index_by_id, std::uint32_t id) {
  return id < index_by_id.size() ? index_by_id[id] : no_index;
}

}  // namespace

Index System::index_of(PointId id) const { return look_up(point_index_, static_cast<std::uint32_t>(id)); }
Index System::index_of(SpringId id) const { return look_up(spring_index_, static_cast<std::uint32_t>(id)); }

void System::insert_point(Index at, const Point& point) { insert(points_, point_index_, next_point_id_, at, point); }
void System::insert_spring(Index at, const Spring& spring) { insert(springs_, spring_index_, next_spring_id_, at, spring); }
void System::set_points(std::vector<Point> points) { set(points_, point_index_, next_point_id_, std::move(points)); }
void System::set_springs(std::vector<Spring> springs) { set(springs_, spring_index_, next_spring_id_, std::move(springs)); }

void System::reserve(Index points, Index springs) {
  points_.reserve(points);
  springs_.reserve(springs);
  point_index_.reserve(points);
  spring_index_.reserve(springs);
}

}  // namespace hooke
