// Shapes that a scene file and the window's menu make from a few numbers: sheets, curtains, bridges and others. From a row of
// the table follow the type in scene files, its fields there and in the panel, and its lines in the manual.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "sim/system.h"

namespace hooke {

struct Network;
struct ElementCount;
struct Shape;

// A number by which a shape is set.
struct ShapeNumber {
  std::string_view name;   // in files
  std::string_view label;  // on the slider
  std::string_view unit;
  double min, max, default_value;  // of the slider; a file may go beyond `most`
  bool integer = false;
  bool is_3d_only = false;  // 0 in a 2-D scene
};

inline constexpr std::size_t max_shape_numbers = 9;

struct ShapeKind {
  std::string_view id;           // in files
  std::string_view label;        // in the menu
  std::string_view description;  // one sentence
  std::span<const ShapeNumber> numbers;
  std::span<const std::string_view> supports;  // what it can be nailed by; the first is usual
  bool is_3d_only;                             // has no place in a 2-D scene
  ElementCount (*element_count)(const Shape& shape);
  // Appends it with its middle at the origin, upright: y is up.
  void (*make)(const Shape& shape, Network& network);
};

std::span<const ShapeKind> shape_kinds();

// The row with this id, or null.
const ShapeKind* find_shape_kind(std::string_view id);

// One as a scene has it.
struct Shape {
  const ShapeKind* kind = nullptr;
  Vec3 at{0.0};                   // [m], of its middle
  double turn = 0.0, tilt = 0.0;  // [degrees], about the vertical axis after about the x axis
  std::optional<Color> color;
  std::size_t support = 0;                         // one of the kind's holds
  std::array<double, max_shape_numbers> values{};  // as many as the row has, in its order

  // By its name; the kind must have it.
  double operator[](std::string_view name) const;
  std::int64_t count(std::string_view name) const { return static_cast<std::int64_t>((*this)[name]); }
  std::string_view support_name() const { return kind->supports[support]; }
};

// With the usual numbers.
Shape default_shape(const ShapeKind& kind);

ElementCount element_count_of(const Shape& shape);
// Appends it, turned and put in its place.
void generate(const Shape& shape, Network& network);

}  // namespace hooke
