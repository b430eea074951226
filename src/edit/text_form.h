// The text form of every type that commands consist of, as JSON and back, bit for bit. Aggregates follow from the names of their fields.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file_limits.h"
#include "base/json_field.h"
#include "base/json_writer.h"
#include "edit/field_names.h"
#include "scene/parameters.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke {

// The largest id determines the size of a lookup table.
inline constexpr std::int64_t max_id = max_springs;

// Of one type.
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
    out.list(JsonWriter::Layout::Line, std::array{value.x, value.y, value.z}, [&](double component) { hooke::write(out, component); });
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
    out.list(JsonWriter::Layout::Line, list, [&](const T& item) { hooke::write(out, item); });
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
    out.list(JsonWriter::Layout::Line, list, [&](const T& item) { hooke::write(out, item); });
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
    out.begin_list(JsonWriter::Layout::Line);
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
    out.begin_object(JsonWriter::Layout::Line);
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
    out.begin_object(JsonWriter::Layout::Line);
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
    if (std::is_same_v<Member, std::optional<PairContact>> || std::is_same_v<Member, decltype(Face::rest_angle)> ||
        std::is_same_v<Member, std::optional<double>> || std::is_same_v<Member, std::optional<SpringLaw>> ||
        std::is_same_v<Member, std::optional<MethodChoice>> ||
        (std::is_same_v<T, PairContact> && (name == "frequency" || name == "damping_ratio")) ||
        (std::is_same_v<T, Collider> && name == "one_way") || (std::is_same_v<T, Point> && (name == "fixed_axes" || name == "load")) ||
        std::is_same_v<T, MethodChoice>)
      return;  // added since the first version
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

}  // namespace hooke
