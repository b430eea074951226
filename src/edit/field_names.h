// The names of the members of the types that commands consist of, in the order of declaration. Serialization in recordings follows from
// them. Commands have theirs as `fields`; those of types of other modules are below. A member without a name does not compile.
#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "edit/command.h"
#include "edit/resume_state.h"

namespace hooke {

// clang-format off
template <class T> inline constexpr auto field_names = [] {
  if constexpr (requires { T::fields; }) return T::fields;
  else return nullptr;
}();

template <> inline constexpr std::array<std::string_view, 7> field_names<Point> =
    {"id", "nailed", "fixed_axes", "color", "mass", "radius", "load"};
template <> inline constexpr std::array<std::string_view, 9> field_names<Spring> =
    {"id", "first", "second", "family", "stiffness", "damping", "rest_length", "break_strain", "law"};
template <> inline constexpr std::array<std::string_view, 8> field_names<SpringLaw> =
    {"force", "k3", "amplitude", "frequency", "phase", "rate", "min_rest_length", "max_rest_length"};
template <> inline constexpr std::array<std::string_view, 2> field_names<Face> = {"points", "rest_angle"};
template <> inline constexpr std::array<std::string_view, 8> field_names<PairContact> =
    {"points", "springs", "faces", "thickness", "restitution", "friction", "frequency", "damping_ratio"};
template <> inline constexpr std::array<std::string_view, 3> field_names<Color> = {"red", "green", "blue"};
template <> inline constexpr std::array<std::string_view, 2> field_names<Plane> = {"point", "normal"};
template <> inline constexpr std::array<std::string_view, 2> field_names<Sphere> = {"center", "radius"};
template <> inline constexpr std::array<std::string_view, 2> field_names<Box> = {"min", "max"};
template <> inline constexpr std::array<std::string_view, 5> field_names<ColliderPath> = {"oscillate", "frequency", "phase", "spin", "belt"};
template <> inline constexpr std::array<std::string_view, 6> field_names<Collider> = {"shape", "restitution", "friction", "solid", "one_way", "path"};
template <> inline constexpr std::array<std::string_view, 3> field_names<Force> = {"type", "on", "values"};
template <> inline constexpr std::array<std::string_view, 2> field_names<Patch> = {"points", "shares"};
template <> inline constexpr std::array<std::string_view, 8> field_names<EnergySupply> = {
    "given", "scale", "hand_stretch", "extent", "speed", "reversible", "min_reversible", "max_reversible"};
template <> inline constexpr std::array<std::string_view, 3> field_names<MethodMemory> = {"step", "error", "choice"};
template <> inline constexpr std::array<std::string_view, 8> field_names<MethodChoice> = {
    "method", "substeps", "min_substeps", "error", "ratio", "next_substeps", "until_estimate", "selected_substeps"};

template <> inline constexpr std::array<std::string_view, 5> field_names<PlacedPoint> = {"at", "point", "position", "velocity", "area"};
template <> inline constexpr std::array<std::string_view, 3> field_names<PlacedSpring> = {"at", "spring", "share"};
template <> inline constexpr std::array<std::string_view, 2> field_names<PlacedFace> = {"at", "face"};
template <> inline constexpr std::array<std::string_view, 3> field_names<Tear> = {"before", "springs", "faces"};
template <> inline constexpr std::array<std::string_view, 7> field_names<State> =
    {"time", "position", "velocity", "hand", "ledger", "memory", "torn"};

// Names of the alternatives of a variant; commands have theirs as `name`.
template <class T> inline constexpr std::nullptr_t alternative_names = nullptr;
template <> inline constexpr std::array<std::string_view, 3> alternative_names<decltype(Collider::shape)> = {"plane", "sphere", "box"};

// Names of the values of an enumeration, from 0.
template <class T> inline constexpr std::nullptr_t value_names = nullptr;
template <> inline constexpr std::array<std::string_view, 2> value_names<PointProperty> = {"mass", "radius"};
template <> inline constexpr std::array<std::string_view, 4> value_names<SpringProperty> = {"stiffness", "damping", "rest_length", "break_strain"};
template <> inline constexpr std::array<std::string_view, 4> value_names<SpringFamily> = {"none", "structural", "shear", "bend"};
template <> inline constexpr std::array<std::string_view, 4> value_names<SpringForce> = {"linear", "cable", "strut", "cubic"};
template <> inline constexpr std::array<std::string_view, 2> value_names<GrabKind> = {"hold", "pull"};
// clang-format on

template <class T>
concept HasFields = !std::is_null_pointer_v<std::remove_cv_t<decltype(field_names<T>)>>;
template <class T>
concept HasAlternatives = !std::is_null_pointer_v<std::remove_cv_t<decltype(alternative_names<T>)>>;
template <class T>
concept HasValueNames = !std::is_null_pointer_v<std::remove_cv_t<decltype(value_names<T>)>>;

// References to all members of a value.
template <class T>
requires HasFields<std::remove_const_t<T>>
auto members_of(T& value) {
  constexpr std::size_t count = field_names<std::remove_const_t<T>>.size();
  static_assert(count <= 9 || count == 11);
  if constexpr (count == 0) {
    return std::tuple<>();
  } else if constexpr (count == 1) {
    auto& [a] = value;
    return std::tie(a);
  } else if constexpr (count == 2) {
    auto& [a, b] = value;
    return std::tie(a, b);
  } else if constexpr (count == 3) {
    auto& [a, b, c] = value;
    return std::tie(a, b, c);
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = value;
    return std::tie(a, b, c, d);
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = value;
    return std::tie(a, b, c, d, e);
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = value;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    return std::tie(a, b, c, d, e, f, g);
  } else if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = value;
    return std::tie(a, b, c, d, e, f, g, h);
  } else if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    return std::tie(a, b, c, d, e, f, g, h, i);
  } else {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    return std::tie(a, b, c, d, e, f, g, h, i, j, k);
  }
}

}  // namespace hooke
