#include "sim/model/system.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numbers>
#include <utility>

#include "base/overloaded.h"
#include "sim/model/constants.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// The number of the id.
template <class Item>
std::uint32_t number_of(const Item& item) {
  return static_cast<std::uint32_t>(item.id);
}

template <class List>
bool is_numbered(const List& items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (number_of(items[i]) != i) return false;
  return true;
}

template <class List>
void fill_indices(IdTable& ids, const List& items) {
  ids.index_by_id.assign(ids.next_id, no_index);
  for (std::size_t i = 0; i < items.size(); ++i) ids.index_by_id[number_of(items[i])] = static_cast<Index>(i);
}

template <class List>
void append(List& items, IdTable& ids, const typename List::value_type& item) {
  const std::uint32_t id = number_of(item);
  ids.next_id = std::max(ids.next_id, id + 1);
  if (ids.index_by_id.empty() && id != items.size()) fill_indices(ids, items);
  if (!ids.index_by_id.empty()) {
    if (ids.index_by_id.size() <= id) ids.index_by_id.resize(id + 1, no_index);
    assert(ids.index_by_id[id] == no_index);
    ids.index_by_id[id] = static_cast<Index>(items.size());
  }
  items.push_back(item);
}

template <class List>
void set(List& items, IdTable& ids, List list) {
  items = std::move(list);
  for (const auto& item : items) ids.next_id = std::max(ids.next_id, number_of(item) + 1);
  ids.index_by_id = std::vector<Index>();
  if (!is_numbered(items)) fill_indices(ids, items);
}

}  // namespace

std::string axes_text(std::uint8_t fixed_axes) {
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
    if ((fixed_axes >> axis & 1) != 0) text += "xyz"[axis];
  return text;
}

std::optional<std::uint8_t> axes_of(std::string_view text) {
  for (std::uint8_t axes = 0; axes < 8; ++axes)
    if (axes_text(axes) == text) return axes;
  return std::nullopt;
}

Vec3 ColliderPath::offset(double time) const {
  return amplitude == Vec3(0.0) ? amplitude : portable::sin(2.0 * std::numbers::pi * frequency * time + phase) * amplitude;
}

Vec3 ColliderPath::velocity(double time) const {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return amplitude == Vec3(0.0) ? amplitude : omega * portable::cos(omega * time + phase) * amplitude;
}

Vec3 ColliderPath::acceleration(double time) const {
  const double omega = 2.0 * std::numbers::pi * frequency;
  return -omega * omega * offset(time);
}

double ColliderPath::resolving_step() const {
  if (amplitude == Vec3(0.0) || frequency == 0.0) return std::numeric_limits<double>::infinity();
  return 1.0 / (steps_per_period * frequency);
}

ColliderShape translated(ColliderShape shape, const Vec3& displacement) {
  std::visit(Overloaded{
                 [&](Plane& plane) { plane.point += displacement; },
                 [&](Sphere& sphere) { sphere.center += displacement; },
                 [&](Box& box) {
                   box.min += displacement;
                   box.max += displacement;
                 },
             },
             shape);
  return shape;
}

Collider translated(Collider collider, const Vec3& displacement) {
  collider.shape = translated(collider.shape, displacement);
  return collider;
}

Collider collider_at_time(const Collider& collider, double time) { return translated(collider, collider.path.offset(time)); }

Vec3 anchor_of(const ColliderShape& shape) {
  return std::visit(Overloaded{
                        [](const Plane& plane) { return plane.point; },
                        [](const Sphere& sphere) { return sphere.center; },
                        [](const Box& box) { return 0.5 * (box.min + box.max); },
                    },
                    shape);
}

void System::append_point(const Point& point) { append(points_, ids_.points, point); }
void System::append_spring(const Spring& spring) {
  append(springs_, ids_.springs, spring);
  ++family_count_[static_cast<std::size_t>(spring.family)];
}
void System::set_points(std::vector<Point> points) { set(points_, ids_.points, std::move(points)); }
void System::set_springs(SpringList springs) {
  set(springs_, ids_.springs, std::move(springs));
  family_count_ = {};
  for (const Spring& spring : springs_) ++family_count_[static_cast<std::size_t>(spring.family)];
}

bool System::any_spring_breaks() const {
  if (break_strain > 0.0) return spring_count() > 0;
  return std::ranges::any_of(springs_, [](const Spring& spring) { return spring.break_strain != never_breaks; });
}

void System::reserve(Index points, Index springs) {
  points_.reserve(points);
  springs_.reserve(springs);
}

bool has_contact(const System& system) { return system.contact.any() || std::ranges::any_of(system.colliders, &Collider::solid); }

}  // namespace hooke
