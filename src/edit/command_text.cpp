#include "edit/command_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/file_limits.h"
#include "edit/apply.h"
#include "edit/field_names.h"
#include "formats/texture.h"
#include "scene/parameters.h"
#include "sim/integrator.h"

namespace hooke {
namespace {

using Layout = JsonWriter::Layout;

// The largest id determines the size of a lookup table.
constexpr std::int64_t max_id = max_springs;

// Serialization of one type. Aggregates follow from their field names; the other types are below.
template <class T>
struct Text;

template <class T>
void write(JsonWriter& out, const T& value) {
  Text<T>::write(out, value);
}
template <class T>
T read(const JsonField& field) {
  return Text<T>::read(field);
}

template <>
struct Text<bool> {
  static void write(JsonWriter& out, bool value) { out.boolean(value); }
  static bool read(const JsonField& field) { return field.boolean(); }
};

// JSON has only finite numbers; the others are strings.
template <>
struct Text<double> {
  static void write(JsonWriter& out, double value) {
    if (std::isfinite(value))
      out.number(value);
    else
      out.text(std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf");
  }
  static double read(const JsonField& field) {
    if (field.is_number()) return field.number();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (field.text() == "inf") return infinity;
    if (field.text() == "-inf") return -infinity;
    if (field.text() == "nan") return std::numeric_limits<double>::quiet_NaN();
    field.refuse("must be a number, \"inf\", \"-inf\" or \"nan\"");
  }
};

template <class T>
requires(std::is_integral_v<T> && !std::is_same_v<T, bool>) struct Text<T> {
  static void write(JsonWriter& out, T value) { out.integer(value); }
  static T read(const JsonField& field) {
    return static_cast<T>(
        field.integer(static_cast<std::int64_t>(std::numeric_limits<T>::min()), static_cast<std::int64_t>(std::numeric_limits<T>::max())));
  }
};

template <class T>
requires(std::is_same_v<T, PointId> || std::is_same_v<T, SpringId>) struct Text<T> {
  static void write(JsonWriter& out, T id) { out.integer(static_cast<std::uint32_t>(id)); }
  static T read(const JsonField& field) { return T{static_cast<std::uint32_t>(field.integer(0, max_id))}; }
};

template <HasValueNames T>
struct Text<T> {
  static void write(JsonWriter& out, T value) { out.text(value_names<T>[static_cast<std::size_t>(value)]); }
  static T read(const JsonField& field) {
    for (std::size_t i = 0; i < value_names<T>.size(); ++i)
      if (field.text() == value_names<T>[i]) return static_cast<T>(i);
    field.refuse("is unknown");
  }
};

template <>
struct Text<std::string> {
  static void write(JsonWriter& out, const std::string& value) { out.text(value); }
  static std::string read(const JsonField& field) { return std::string(field.text()); }
};

template <>
struct Text<Vec3> {
  static void write(JsonWriter& out, const Vec3& value) {
    out.begin_list(Layout::Line);
    for (int c = 0; c < 3; ++c) hooke::write(out, value[c]);
    out.end();
  }
  static Vec3 read(const JsonField& field) {
    const auto items = field.items(3, 3);
    return {hooke::read<double>(items[0]), hooke::read<double>(items[1]), hooke::read<double>(items[2])};
  }
};

template <class T>
struct Text<std::optional<T>> {
  static void write(JsonWriter& out, const std::optional<T>& value) {
    if (value)
      hooke::write(out, *value);
    else
      out.null();
  }
  static std::optional<T> read(const JsonField& field) {
    if (field.is_null()) return std::nullopt;
    return hooke::read<T>(field);
  }
};

template <class T>
struct Text<std::vector<T>> {
  static void write(JsonWriter& out, const std::vector<T>& list) {
    out.begin_list(Layout::Line);
    for (const T& item : list) hooke::write(out, item);
    out.end();
  }
  static std::vector<T> read(const JsonField& field) {
    const auto items = field.items(0, max_springs);
    std::vector<T> list;
    list.reserve(items.size());
    for (const JsonField item : items) list.push_back(hooke::read<T>(item));
    return list;
  }
};

template <class T, std::size_t count>
struct Text<std::array<T, count>> {
  static void write(JsonWriter& out, const std::array<T, count>& list) {
    out.begin_list(Layout::Line);
    for (const T& item : list) hooke::write(out, item);
    out.end();
  }
  static std::array<T, count> read(const JsonField& field) {
    const auto items = field.items(count, count);
    std::array<T, count> list{};
    for (std::size_t i = 0; i < count; ++i) list[i] = hooke::read<T>(items[i]);
    return list;
  }
};

template <class First, class Second>
struct Text<std::pair<First, Second>> {
  static void write(JsonWriter& out, const std::pair<First, Second>& pair) {
    out.begin_list(Layout::Line);
    hooke::write(out, pair.first);
    hooke::write(out, pair.second);
    out.end();
  }
  static std::pair<First, Second> read(const JsonField& field) {
    const auto items = field.items(2, 2);
    return {hooke::read<First>(items[0]), hooke::read<Second>(items[1])};
  }
};

// {"name of the alternative": value}
template <HasAlternatives T>
struct Text<T> {
  static_assert(alternative_names<T>.size() == std::variant_size_v<T>);
  static void write(JsonWriter& out, const T& value) {
    out.begin_object(Layout::Line);
    out.key(alternative_names<T>[value.index()]);
    std::visit([&](const auto& alternative) { hooke::write(out, alternative); }, value);
    out.end();
  }
  static T read(const JsonField& field) {
    const auto members = field.members();
    if (members.size() != 1) field.refuse("must have one member");
    return read_alternative(members[0]);
  }
  static T read_alternative(const JsonField& field) { return read_from<0>(field); }

 private:
  template <std::size_t i>
  static T read_from(const JsonField& field) {
    if constexpr (i == std::variant_size_v<T>)
      field.refuse("is unknown");
    else
      return field.is(alternative_names<T>[i]) ? T(hooke::read<std::variant_alternative_t<i, T>>(field)) : read_from<i + 1>(field);
  }
};

template <HasFields T>
struct Text<T> {
  static void write(JsonWriter& out, const T& value) {
    out.begin_object(Layout::Line);
    std::apply(
        [&, i = std::size_t{0}](const auto&... members) mutable { ((out.key(field_names<T>[i++]), hooke::write(out, members)), ...); },
        members_of(value));
    out.end();
  }
  static T read(const JsonField& field) {
    T value{};
    std::apply([&, i = std::size_t{0}](auto&... members) mutable { (read_member(field, field_names<T>[i++], members), ...); },
               members_of(value));
    return value;
  }

 private:
  template <class Member>
  static void read_member(const JsonField& field, std::string_view name, Member& member) {
    for (const JsonField part : field.members())
      if (part.is(name)) {
        member = hooke::read<Member>(part);
        return;
      }
    if (std::is_same_v<Member, std::optional<double>>) return;  // added since the first version
    field.refuse_missing(name, "must be given");
  }
};

// Rows of tables, by their ids.
template <class Row, const Row* (*find)(std::string_view), class Id>
struct RowText {
  static void write(JsonWriter& out, const Row* row) { out.text(Id{}(*row)); }
  static const Row* read(const JsonField& field) {
    if (const Row* row = find(field.text())) return row;
    field.refuse("is unknown");
  }
};
struct ById {
  std::string_view operator()(const auto& row) const { return row.id; }
};
struct ByName {
  std::string_view operator()(const auto& row) const { return row.name; }
};
template <>
struct Text<const Integrator*> : RowText<Integrator, find_integrator, ById> {};
template <>
struct Text<const ForceTerm*> : RowText<ForceTerm, find_force_term, ById> {};
template <>
struct Text<const Parameter*> : RowText<Parameter, find_parameter, ByName> {};

// Only the position of the hand: a grab ends with a jump to another state.
template <>
struct Text<Hand> {
  static void write(JsonWriter& out, const Hand& hand) { hooke::write(out, hand.position); }
  static Hand read(const JsonField& field) { return {.position = hooke::read<Vec3>(field)}; }
};

// The image of a texture is not recorded: it does not affect motion.
template <>
struct Text<TextureImage> {
  static void write(JsonWriter& out, const TextureImage&) { out.null(); }
  static TextureImage read(const JsonField&) { return {}; }
};

template <HasFields T>
struct Text<std::shared_ptr<const T>> {
  static void write(JsonWriter& out, const std::shared_ptr<const T>& value) { hooke::write(out, *value); }
  static std::shared_ptr<const T> read(const JsonField& field) { return std::make_shared<const T>(hooke::read<T>(field)); }
};

// A whole scene is not part of the text of a command.
template <>
struct Text<std::shared_ptr<const Scene>> {
  static void write(JsonWriter& out, const std::shared_ptr<const Scene>&) { out.null(); }
  static std::shared_ptr<const Scene> read(const JsonField& field) { field.refuse("must be a scene on a line of its own"); }
};

// The ids in the order of the list; nothing when they equal the indices.
template <class Item, class Id = decltype(Item::id)>
std::optional<std::vector<Id>> ids_of(const std::vector<Item>& items) {
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
  for (Face& face : system.faces)
    for (PointId& corner : face.points) corner = id_of(corner);
  if (system.scripted_hand) system.scripted_hand->point = id_of(system.scripted_hand->point);

  if (scene.cloth_texture.cloth_coordinates && rest.point_ids)
    scene.cloth_texture.cloth_coordinates =
        std::make_shared<const ClothCoordinates>(by_id(*scene.cloth_texture.cloth_coordinates, *rest.point_ids, no_cloth_coordinates));
  if (scene.sheet) {
    SheetWeights sheet = *scene.sheet;
    if (rest.point_ids) sheet.area = by_id(sheet.area, *rest.point_ids, 0.0);
    if (rest.spring_ids) sheet.spring_weight = by_id(sheet.spring_weight, *rest.spring_ids, 0.0);
    scene.sheet = std::make_shared<const SheetWeights>(std::move(sheet));
  }
  system.set_springs({});
  system.set_points(std::move(points));
  system.set_springs(std::move(springs));
  while (system.next_point_id() < rest.next_point_id) system.new_point_id();
  while (system.next_spring_id() < rest.next_spring_id) system.new_spring_id();
}

}  // namespace

void write_command(JsonWriter& out, const Command& command) { write(out, command); }

bool is_command(const JsonField& member) {
  return std::ranges::any_of(alternative_names<Command>, [&](std::string_view name) { return member.is(name); });
}

Command read_command(const JsonField& member) { return Text<Command>::read_alternative(member); }

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
          .ledger = scene.state.ledger,
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
  restore_ids(rest, scene);
  scene.state.torn = rest.torn;
  scene.tears = rest.tears;
  scene.state.hand.position = rest.hand;
  scene.state.ledger = rest.ledger;
  scene.state.memory = rest.memory;
  Effect effect;
  if (rest.collider_grab) apply(scene, GrabCollider{*rest.collider_grab}, effect);
  if (!rest.grab) return;
  apply(scene, GrabPoint{*rest.grab}, effect);
  scene.state.hand.position = rest.hand;
}

}  // namespace hooke
