#include "sim/system.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/overloaded.h"

namespace hooke {
namespace {

template <class Item>
void append(std::vector<Item>& items, std::vector<Index>& index_by_id, std::uint32_t& next_id, const Item& item) {
  const auto id = static_cast<std::uint32_t>(item.id);
  next_id = std::max(next_id, id + 1);
  if (index_by_id.size() <= id) index_by_id.resize(id + 1, no_index);
  assert(index_by_id[id] == no_index);
  index_by_id[id] = static_cast<Index>(items.size());
  items.push_back(item);
}

template <class Item>
void set(std::vector<Item>& items, std::vector<Index>& index_by_id, std::uint32_t& next_id, std::vector<Item> list) {
  for (const Item& item : list) next_id = std::max(next_id, static_cast<std::uint32_t>(item.id) + 1);
  index_by_id.assign(next_id, no_index);
  items = std::move(list);
  for (std::size_t i = 0; i < items.size(); ++i) index_by_id[static_cast<std::uint32_t>(items[i].id)] = static_cast<Index>(i);
}

Index look_up(const std::vector<Index>& index_by_id, std::uint32_t id) { return id < index_by_id.size() ? index_by_id[id] : no_index; }

}  // namespace

Vec3 ColliderPath::offset(double time) const {
  return amplitude == Vec3(0.0) ? amplitude : std::sin(2.0 * std::numbers::pi * frequency * time + phase) * amplitude;
}

Vec3 ColliderPath::velocity(double time) const {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return amplitude == Vec3(0.0) ? amplitude : omega * std::cos(omega * time + phase) * amplitude;
}

Collider translated(Collider collider, const Vec3& displacement) {
  std::visit(Overloaded{
                 [&](Plane& plane) { plane.point += displacement; },
                 [&](Sphere& sphere) { sphere.center += displacement; },
                 [&](Box& box) {
                   box.min += displacement;
                   box.max += displacement;
                 },
             },
             collider.shape);
  return collider;
}

Collider collider_at_time(const Collider& collider, double time) { return translated(collider, collider.path.offset(time)); }

Vec3 anchor_of(const Collider& collider) {
  return std::visit(Overloaded{
                        [](const Plane& plane) { return plane.point; },
                        [](const Sphere& sphere) { return sphere.center; },
                        [](const Box& box) { return 0.5 * (box.min + box.max); },
                    },
                    collider.shape);
}

Index System::index_of(PointId id) const { return look_up(point_index_, static_cast<std::uint32_t>(id)); }
Index System::index_of(SpringId id) const { return look_up(spring_index_, static_cast<std::uint32_t>(id)); }

void System::append_point(const Point& point) { append(points_, point_index_, next_point_id_, point); }
void System::append_spring(const Spring& spring) {
  append(springs_, spring_index_, next_spring_id_, spring);
  ++family_count_[static_cast<std::size_t>(spring.family)];
}
void System::set_points(std::vector<Point> points) { set(points_, point_index_, next_point_id_, std::move(points)); }
void System::set_springs(std::vector<Spring> springs) {
  set(springs_, spring_index_, next_spring_id_, std::move(springs));
  family_count_ = {};
  for (const Spring& spring : springs_) ++family_count_[static_cast<std::size_t>(spring.family)];
}

void System::reserve(Index points, Index springs) {
  points_.reserve(points);
  springs_.reserve(springs);
  point_index_.reserve(points);
  spring_index_.reserve(springs);
}

bool System::operator==(const System& other) const {
  const auto scalars = [](const System& s) {
    return std::tie(s.dimensions, s.gravity, s.drag, s.drag_on, s.dashpots_on, s.family_on, s.wind, s.hand_speed, s.break_strain,
                    s.strain_limit);
  };
  return scalars(*this) == scalars(other) && faces == other.faces && colliders == other.colliders && forces == other.forces &&
         grab == other.grab && collider_grab == other.collider_grab && scripted_hand == other.scripted_hand && points_ == other.points_ &&
         springs_ == other.springs_;
}

}  // namespace hooke
