#include "formats/generator_fields.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <set>

#include "base/file_limits.h"
#include "base/json_text.h"

namespace hooke {
namespace {

MassModel read_mass_model(const JsonField& field) {
  const std::string_view text = field.text();
  if (text == "equal") return MassModel::Equal;
  if (text == "tributary") return MassModel::Tributary;
  field.refuse("must be \"equal\" or \"tributary\"");
}

bool has_member(const JsonField& field, std::string_view key) {
  for (const JsonField member : field.members())
    if (member.is(key)) return true;
  return false;
}

// Reads the fields that cloths and ropes share; false: not one of them.
bool read_fabric(const JsonField& field, SceneFields& fields, Fabric& fabric) {
  if (field.is("mass_model"))
    fabric.mass_model = read_mass_model(field);
  else if (field.is("density"))
    fabric.density = field.number(positive);
  else if (field.is("mass"))
    fabric.mass = field.number(positive);
  else if (field.is("stiffness"))
    fabric.stiffness = field.number(not_negative);
  else if (field.is("stiffness_per_strain"))
    fabric.stiffness_per_strain = field.number(not_negative);
  else if (field.is("damping"))
    fabric.damping = field.number(not_negative);
  else if (field.is("damping_per_length"))
    fabric.damping_per_length = field.number(not_negative);
  else if (field.is("point_radius"))
    fabric.point_radius = field.number(not_negative);
  else if (field.is("color"))
    fabric.color = fields.color(field);
  else
    return false;
  return true;
}

// What is said twice or not at all.
void check_fabric(const JsonField& field, Fabric& fabric, bool has_stiffness, bool has_damping) {
  if (fabric.density && fabric.mass) field.refuse("must have density or mass, not both");
  if (!fabric.density && !fabric.mass) fabric.mass = 1.0;
  if (has_stiffness && fabric.stiffness_per_strain) field.refuse("must have stiffness or stiffness_per_strain, not both");
  if (has_damping && fabric.damping_per_length) field.refuse("must have damping or damping_per_length, not both");
  if (!has_stiffness && !fabric.stiffness_per_strain) field.refuse_missing("stiffness", "must be a number of at least 0");
}

std::int64_t read_count(const JsonField& field) { return field.integer(2, static_cast<std::int64_t>(max_points)); }

// Words for points of a cloth: which of its edges they lie on.
struct Edges {
  bool top, bottom, left, right;
};
struct ClothNailRule {
  std::string_view keyword;
  bool (*matches)(const Edges&);
};
constexpr std::array cloth_nail_rules{
    ClothNailRule{"top", [](const Edges& e) { return e.top; }},
    ClothNailRule{"bottom", [](const Edges& e) { return e.bottom; }},
    ClothNailRule{"left", [](const Edges& e) { return e.left; }},
    ClothNailRule{"right", [](const Edges& e) { return e.right; }},
    ClothNailRule{"border", [](const Edges& e) { return e.top || e.bottom || e.left || e.right; }},
    ClothNailRule{"corners", [](const Edges& e) { return (e.top || e.bottom) && (e.left || e.right); }},
    ClothNailRule{"top_left", [](const Edges& e) { return e.top && e.left; }},
    ClothNailRule{"top_right", [](const Edges& e) { return e.top && e.right; }},
    ClothNailRule{"bottom_left", [](const Edges& e) { return e.bottom && e.left; }},
    ClothNailRule{"bottom_right", [](const Edges& e) { return e.bottom && e.right; }},
};

// Adds the points that the word stands for; false: no such word.
bool add_nails(const Cloth& cloth, std::string_view keyword, std::set<Index>& nails) {
  for (const ClothNailRule& nail : cloth_nail_rules) {
    if (nail.keyword != keyword) continue;
    for (std::int64_t row = 0; row < cloth.rows; ++row) {
      // only the first and last row have points between their ends to ask about
      const bool whole_row = row == 0 || row == cloth.rows - 1;
      for (std::int64_t column = 0; column < cloth.columns; column += whole_row ? 1 : cloth.columns - 1)
        if (nail.matches({row == 0, row == cloth.rows - 1, column == 0, column == cloth.columns - 1}))
          nails.insert(static_cast<Index>(row * cloth.columns + column));
    }
    return true;
  }
  return false;
}

bool add_nails(const Rope& rope, std::string_view keyword, std::set<Index>& nails) {
  if (keyword == "from")
    nails.insert(0);
  else if (keyword == "to")
    nails.insert(static_cast<Index>(rope.points - 1));
  else
    return false;
  return true;
}

std::string nail_keywords(const Cloth&) {
  std::string keywords;
  for (const ClothNailRule& nail : cloth_nail_rules) keywords += std::string(nail.keyword) + " ";
  return keywords;
}

std::string nail_keywords(const Rope&) { return "from to "; }

template <class Shape>
void read_nails(const JsonField& field, Shape& shape, std::int64_t points) {
  std::set<Index> nails;
  for (const JsonField item : field.items(0, max_values_per_item)) {
    const bool known = item.is_number() ? nails.insert(static_cast<Index>(item.integer(0, points - 1))),
               true                     : add_nails(shape, item.text(), nails);
    if (!known) item.refuse("must be a point number or one of " + nail_keywords(shape) + "here");
  }
  shape.fabric.nails.assign(nails.begin(), nails.end());
}

// A material says the stiffness and damping of all springs but those that bend.
void check_sheet(const JsonField& field, Cloth& cloth) {
  if (!cloth.sheet_stiffness) field.refuse("must have sheet_stiffness where it has sheet_damping");
  if (cloth.fabric.mass_model != MassModel::Tributary) field.refuse("must have the mass_model \"tributary\" for sheet_stiffness");
  for (const std::string_view key : {"stiffness", "stiffness_per_strain", "shear_stiffness", "damping", "damping_per_length"})
    if (has_member(field, key)) field.refuse("must have sheet_stiffness or " + std::string(key) + ", not both");
  check_fabric(field, cloth.fabric, true, false);
}

Cloth read_cloth(const JsonField& field, SceneFields& fields) {
  Cloth cloth;
  std::string unknown;
  for (const JsonField member : field.members()) {
    if (member.is("type") || member.is("nail") || read_fabric(member, fields, cloth.fabric)) continue;
    if (member.is("corner"))
      cloth.corner = fields.position(member);
    else if (member.is("across"))
      cloth.across = fields.position(member);
    else if (member.is("down"))
      cloth.down = fields.position(member);
    else if (member.is("points")) {
      const auto counts = member.items(2, 2);
      cloth.columns = read_count(counts[0]);
      cloth.rows = read_count(counts[1]);
    } else if (member.is("stencil")) {
      cloth.stencil = member.integer(4, 12);
      if (*cloth.stencil % 4 != 0) member.refuse("must be 4, 8 or 12");
    } else if (member.is("sheet_stiffness"))
      cloth.sheet_stiffness = member.number(not_negative);
    else if (member.is("sheet_damping"))
      cloth.sheet_damping = member.number(not_negative);
    else if (member.is("shear_stiffness"))
      cloth.shear_stiffness = member.number(not_negative);
    else if (member.is("bend_stiffness"))
      cloth.bend_stiffness = member.number(not_negative);
    else
      fields.preserve_unknown(member, unknown);
  }

  for (const std::string_view key : {"corner", "across", "down"})
    if (!has_member(field, key)) field.refuse_missing(key, "must be [x, y, z]");
  if (!has_member(field, "points")) field.refuse_missing("points", "must be [columns, rows]");
  if (cloth.sheet_stiffness || has_member(field, "sheet_damping"))
    check_sheet(field, cloth);
  else
    check_fabric(field, cloth.fabric, has_member(field, "stiffness"), has_member(field, "damping"));
  if (cloth.stencil.value_or(8) < 8 && cloth.shear_stiffness.value_or(0.0) > 0.0)
    field.refuse("must have a stencil of 8 or 12 for shear_stiffness");
  if (cloth.stencil.value_or(12) < 12 && cloth.bend_stiffness.value_or(0.0) > 0.0)
    field.refuse("must have a stencil of 12 for bend_stiffness");
  if (!(glm::length(glm::cross(cloth.across, cloth.down)) > 0.0)) field.refuse("must have across and down that span an area");
  return cloth;
}

Rope read_rope(const JsonField& field, SceneFields& fields) {
  Rope rope;
  std::string unknown;
  for (const JsonField member : field.members()) {
    if (member.is("type") || member.is("nail") || read_fabric(member, fields, rope.fabric)) continue;
    if (member.is("from"))
      rope.from = fields.position(member);
    else if (member.is("to"))
      rope.to = fields.position(member);
    else if (member.is("points"))
      rope.points = read_count(member);
    else
      fields.preserve_unknown(member, unknown);
  }

  for (const std::string_view key : {"from", "to"})
    if (!has_member(field, key)) field.refuse_missing(key, "must be [x, y, z]");
  if (!has_member(field, "points")) field.refuse_missing("points", "must be a whole number of at least 2");
  check_fabric(field, rope.fabric, has_member(field, "stiffness"), has_member(field, "damping"));
  if (!(glm::length(rope.to - rope.from) > 0.0)) field.refuse("must have from and to in two places");
  return rope;
}

// Counts are few enough that their product is a number of 64 bits.
constexpr std::int64_t max_shape_count = 100'000;

double read_shape_number(const JsonField& field, const ShapeNumber& number) {
  if (number.integer) return static_cast<double>(field.integer(static_cast<std::int64_t>(number.min), max_shape_count));
  return field.number(number.min > 0.0 ? positive : not_negative);
}

std::size_t read_support(const JsonField& field, const ShapeKind& kind) {
  std::string keywords;
  for (std::size_t i = 0; i < kind.supports.size(); ++i) {
    if (field.text() == kind.supports[i]) return i;
    keywords += (i == 0 ? "" : ", ") + std::string(kind.supports[i]);
  }
  field.refuse("must be one of " + keywords);
}

Generator read_shape(const JsonField& field, SceneFields& fields, const ShapeKind& kind) {
  Shape shape = default_shape(kind);
  std::string unknown;
  for (const JsonField member : field.members()) {
    const auto number = std::ranges::find_if(kind.numbers, [&](const ShapeNumber& row) { return member.is(row.name); });
    if (member.is("type")) continue;
    if (number != kind.numbers.end())
      shape.values[static_cast<std::size_t>(number - kind.numbers.begin())] = read_shape_number(member, *number);
    else if (member.is("at"))
      shape.at = fields.position(member);
    else if (member.is("turn"))
      shape.turn = member.number();
    else if (member.is("tilt"))
      shape.tilt = member.number();
    else if (member.is("color"))
      shape.color = fields.color(member);
    else if (member.is("held"))
      shape.support = read_support(member, kind);
    else
      fields.preserve_unknown(member, unknown);
  }
  const ElementCount element_count = element_count_of(shape);
  if (element_count.points > max_points)
    field.refuse(std::to_string(element_count.points) + " points: must be at most " + std::to_string(max_points));
  if (element_count.springs > max_springs)
    field.refuse(std::to_string(element_count.springs) + " springs: must be at most " + std::to_string(max_springs));
  return shape;
}

// Too many points are refused before nails are looked for among them.
void check_extent(const JsonField& field, const Generator& generator) {
  const ElementCount element_count = element_count_of(generator);
  for (const JsonField member : field.members()) {
    if (!member.is("points")) continue;
    if (element_count.points > max_points)
      member.refuse(std::to_string(element_count.points) + " points: must be at most " + std::to_string(max_points));
    if (element_count.springs > max_springs)
      member.refuse(std::to_string(element_count.springs) + " springs: must be at most " + std::to_string(max_springs));
  }
}

template <class ClothOrRope>
Generator with_nails(const JsonField& field, ClothOrRope cloth_or_rope, std::int64_t points) {
  check_extent(field, cloth_or_rope);
  for (const JsonField member : field.members())
    if (member.is("nail")) read_nails(member, cloth_or_rope, points);
  return cloth_or_rope;
}

std::string valid_types_message() {
  std::string list = "must be one of cloth, rope";
  for (const ShapeKind& kind : shape_kinds()) list += ", " + std::string(kind.id);
  return list;
}

}  // namespace

Generator read_generator(const JsonField& field, SceneFields& fields) {
  if (!has_member(field, "type")) field.refuse_missing("type", valid_types_message());
  Generator generator;
  for (const JsonField member : field.members()) {
    if (!member.is("type")) continue;
    if (member.text() == "cloth") {
      const Cloth cloth = read_cloth(field, fields);
      generator = with_nails(field, cloth, cloth.columns * cloth.rows);
    } else if (member.text() == "rope") {
      const Rope rope = read_rope(field, fields);
      generator = with_nails(field, rope, rope.points);
    } else if (const ShapeKind* kind = find_shape_kind(member.text())) {
      generator = read_shape(field, fields, *kind);
    } else {
      member.refuse(valid_types_message());
    }
  }
  return generator;
}

std::vector<Generator> parse_generators(const std::string& list) {
  std::vector<Generator> generators;
  JsonParser parser;
  SceneFields fields;
  const std::string name = "generators";
  const auto item = [&](std::string_view, std::size_t index, std::string_view text) {
    generators.push_back(read_generator({name, name, parser.parse(text), index}, fields));
  };
  walk_json("{\"generators\": " + list + "}", name,
            {.is_list = [](std::string_view) { return true; }, .item = item, .member = [](std::string_view, std::string_view) {}});
  return generators;
}

}  // namespace hooke
