#include "edit/resume_state.h"

#include <algorithm>
#include <cmath>

#include "edit/command.h"
#include "edit/text_form.h"
#include "formats/texture.h"
#include "sim/control/automatic.h"

namespace hooke {
namespace {

// The ids in the order of the list; nothing when they equal the indices.
template <class List, class Item = typename List::value_type, class Id = decltype(Item::id)>
std::optional<std::vector<Id>> ids_of(const List& items) {
  std::vector<Id> ids;
  bool are_places = true;
  for (const Item& item : items) {
    are_places = are_places && static_cast<std::size_t>(item.id) == ids.size();
    ids.push_back(item.id);
  }
  if (are_places) return std::nullopt;
  return ids;
}

template <class Id>
void check_ids(const JsonField& field, const std::optional<std::vector<Id>>& ids, std::size_t count) {
  if (!ids) return;
  std::vector<Id> sorted = *ids;
  std::ranges::sort(sorted);
  if (sorted.size() != count || std::ranges::adjacent_find(sorted) != sorted.end())
    field.refuse("ids: must be as many as in the scene, all different");
}

// Values by index, rearranged to be found by id.
template <class Value, class Id>
std::vector<Value> by_id(const std::vector<Value>& listed, const std::vector<Id>& ids, const Value& none) {
  std::vector<Value> list;
  for (std::size_t i = 0; i < ids.size() && i < listed.size(); ++i) {
    const auto id = static_cast<std::size_t>(ids[i]);
    if (id >= list.size()) list.resize(id + 1, none);
    list[id] = listed[i];
  }
  return list;
}

// Restores the ids of points and springs, which a file numbers from 0.
void restore_ids(const ResumeState& rest, Scene& scene) {
  System& system = scene.system;
  const auto id_of = [&](PointId number) { return rest.point_ids ? (*rest.point_ids)[static_cast<std::size_t>(number)] : number; };
  std::vector<Point> points = system.points();
  std::vector<Spring> springs = system.springs();
  for (Point& point : points) point.id = id_of(point.id);
  for (Spring& spring : springs) {
    if (rest.spring_ids) spring.id = (*rest.spring_ids)[static_cast<std::size_t>(spring.id)];
    spring.first = id_of(spring.first);
    spring.second = id_of(spring.second);
  }
  for (std::size_t f = 0; f < system.faces.size(); ++f) {
    std::array<PointId, 3> corners = system.faces[f].points;
    for (PointId& corner : corners) corner = id_of(corner);
    system.faces.set_points(f, corners);
  }
  if (system.scripted_hand) system.scripted_hand->point = id_of(system.scripted_hand->point);
  if (system.center_point) system.center_point = id_of(*system.center_point);

  if (scene.cloth_texture.cloth_coordinates && rest.point_ids)
    scene.cloth_texture.cloth_coordinates =
        std::make_shared<const ClothCoordinates>(by_id(*scene.cloth_texture.cloth_coordinates, *rest.point_ids, no_cloth_coordinates));
  if (scene.sheet) {
    SheetWeights sheet = *scene.sheet;
    const auto plain = [](const NumberList& list) { return std::vector<double>(list.begin(), list.end()); };
    if (rest.point_ids) sheet.area = by_id(plain(sheet.area), *rest.point_ids, 0.0);
    if (rest.spring_ids) sheet.spring_weight = by_id(plain(sheet.spring_weight), *rest.spring_ids, 0.0);
    scene.sheet = std::make_shared<const SheetWeights>(std::move(sheet));
  }
  system.set_springs({});
  system.set_points(std::move(points));
  system.set_springs(springs);
  while (system.next_point_id() < rest.next_point_id) system.new_point_id();
  while (system.next_spring_id() < rest.next_spring_id) system.new_spring_id();
}

}  // namespace

ResumeState resume_state_of(const Scene& scene) {
  const Hand& hand = scene.state.hand;
  std::optional<GrabPoint::Item> grab;
  if (const auto& held = scene.system.grab) grab = {held->point, held->patch, held->kind, hand.target, held->stiffness};
  std::optional<GrabCollider::Item> collider_grab;
  if (hand.collider) collider_grab = {hand.collider->collider, hand.collider->target};
  return {.point_ids = ids_of(scene.system.points()),
          .spring_ids = ids_of(scene.system.springs()),
          .next_point_id = scene.system.next_point_id(),
          .next_spring_id = scene.system.next_spring_id(),
          .grab = grab,
          .collider_grab = collider_grab,
          .hand = hand.position,
          .supply = scene.state.supply,
          .memory = scene.state.memory,
          .torn = scene.state.torn,
          .tears = scene.tears};
}

void write_resume_state(JsonWriter& out, const ResumeState& rest) { write(out, rest); }

void restore_resume_state(const JsonField& field, Scene& scene) {
  const auto rest = read<ResumeState>(field);
  check_ids(field, rest.point_ids, scene.system.points().size());
  check_ids(field, rest.spring_ids, scene.system.springs().size());
  // the largest id sizes a lookup table
  if (std::max(rest.next_point_id, rest.next_spring_id) > max_id) field.refuse("next ids: must be at most " + std::to_string(max_id));
  for (std::size_t i = 0; i < rest.tears.size(); ++i)
    if (rest.tears[i]->before > i) field.refuse("tears: each must come after an earlier one");
  if (rest.torn > rest.tears.size()) field.refuse("torn: must be one of the tears");
  const EnergySupply& supply = rest.supply;
  for (const double value : {supply.net_input, supply.scale, supply.hand_stretch, supply.extent.value_or(0.0), supply.speed.value_or(0.0),
                             supply.reversible.value_or(0.0), supply.min_reversible.value_or(0.0), supply.max_reversible.value_or(0.0)})
    if (!std::isfinite(value)) field.refuse("ledger: must be numbers below 1.8e308");
  if (!is_valid(rest.memory))
    field.refuse("memory: choice: must be a method with fixed steps, and 1 to " + std::to_string(max_substeps) + " substeps");
  restore_ids(rest, scene);
  scene.state.torn = rest.torn;
  scene.tears = rest.tears;
  scene.state.hand.position = rest.hand;
  scene.state.supply = rest.supply;
  scene.state.memory = rest.memory;
  Effect effect;
  if (rest.collider_grab) apply(scene, GrabCollider{*rest.collider_grab}, effect);
  if (!rest.grab) return;
  apply(scene, GrabPoint{*rest.grab}, effect);
  scene.state.hand.position = rest.hand;
}

}  // namespace hooke
