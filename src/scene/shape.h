// Shapes: cloths, ropes, sheets, bridges and others that are generated from a few parameters. The generators of a scene file and the Add
// menu follow from this table: a row defines the type in files, its fields there and on the panel, and its entry in
// docs/reference/scene-format.md.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/table.h"
#include "scene/network.h"

namespace hooke {

struct Shape;

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

// A parameter of a shape.
struct ShapeNumber {
  std::string_view name;   // in files
  std::string_view label;  // on the slider
  std::string_view unit;
  double min, max, default_value;  // range of the slider; a file may exceed `max`. `not_given`: has no default
  bool integer = false;
  bool is_3d_only = false;             // 0 in a 2-D scene
  bool is_required = false;            // in a file
  std::int64_t max_integer = 100'000;  // in a file; keeps the product of three counts within 64 bits
  std::span<const std::string_view> choices = {} /* the value is the index of one of these words */;
};

// A position or edge that a file must give, or a list of counts.
struct ShapeVector {
  std::string_view name;
  std::string_view format = "[x, y, z]";  // in messages
  std::size_t counts = 0;                 // 0: coordinates [m]; else this many integers of at least 2
};

// A keyword for points of the shape in its list of nails.
struct NailKeyword {
  std::string_view word;
  std::vector<Index> (*points)(const Shape& shape);  // indices within the shape
};

// A field whose value contradicts another or is missing; an empty field refers to the shape as a whole.
struct ShapeError {
  std::string_view field;
  std::string text;
};

inline constexpr std::size_t max_shape_numbers = 13, max_shape_vectors = 4;

// What of a shape touches, where users place it in a scene without contact.
enum class ShapeContact { None, Faces, Springs };

struct ShapeKind {
  std::string_view id;           // in files
  std::string_view label;        // in the menu; empty: only in files
  std::string_view description;  // one sentence
  std::string_view details;      // for the documentation: formulas and limits
  std::span<const ShapeNumber> numbers;
  std::span<const std::string_view> supports = {};  // how it can be nailed; the first is the default
  std::span<const ShapeVector> vectors = {};        // these define the position, instead of `at`, `turn` and `tilt`
  std::span<const NailKeyword> nail_keywords = {};  // a list of nails instead of a support; empty: takes no list
  bool is_3d_only = false;                          // not available in a 2-D scene
  ShapeContact contact = ShapeContact::None;
  std::optional<ShapeError> (*check)(const Shape& shape) = nullptr;
  ElementCount (*element_count)(const Shape& shape) = nullptr;
  // Appends the shape. Without vectors it is centered at the origin and upright (y is up).
  void (*make)(const Shape& shape, Network& network) = nullptr;

  bool is_placeable() const { return !label.empty(); }
};

// All rows, and those that the window offers.
Table<ShapeKind> shape_kinds();
Table<ShapeKind> placeable_shapes();

// The row with this id, or null.
const ShapeKind* find_shape_kind(std::string_view id);

// A shape of a scene.
struct Shape {
  const ShapeKind* kind = nullptr;
  Vec3 at{0.0};                   // [m], its center
  double turn = 0.0, tilt = 0.0;  // [degrees], about the vertical axis after about the x axis
  std::optional<Color> color;
  std::size_t support = 0;                         // index into the kind's supports
  std::array<double, max_shape_numbers> values{};  // in the order of the kind's numbers
  std::array<Vec3, max_shape_vectors> vectors{};   // in the order of the kind's vectors
  std::vector<Index> nails;                        // indices within the shape

  // A parameter by its name, which the kind must have; NaN if it was not given.
  double operator[](std::string_view name) const;
  bool has(std::string_view name) const;
  std::optional<double> find(std::string_view name) const { return has(name) ? std::optional((*this)[name]) : std::nullopt; }
  double value_or(std::string_view name, double otherwise) const { return find(name).value_or(otherwise); }
  std::int64_t count(std::string_view name) const { return static_cast<std::int64_t>((*this)[name]); }
  std::string_view support_name() const { return kind->supports[support]; }
};

// With default parameters.
Shape default_shape(const ShapeKind& kind);

// The number of elements, without generating them.
ElementCount element_count_of(const Shape& shape);

// Appends the shape, rotated and moved to its position. Masses and stiffnesses may overflow: the caller checks them.
void generate(const Shape& shape, Network& network);

}  // namespace hooke
