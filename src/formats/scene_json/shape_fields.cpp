#include "formats/scene_json/shape_fields.h"

#include <algorithm>
#include <set>

#include "base/file_limits.h"
#include "base/json_text.h"
#include "base/json_writer.h"
#include "base/option_error.h"
#include "base/text_lines.h"

namespace hooke {
namespace {

double read_number(const JsonField& field, const ShapeNumber& number) {
  if (!number.choices.empty()) {
    const auto choice = std::ranges::find(number.choices, field.text());
    if (choice == number.choices.end())
      field.refuse("must be " + joined(
                                    number.choices, [](std::string_view id) { return to_json(id); }, " or "));
    return static_cast<double>(choice - number.choices.begin());
  }
  if (number.integer) return static_cast<double>(field.integer(static_cast<std::int64_t>(number.min), number.max_integer));
  return field.number(number.min > 0.0 ? positive : not_negative);
}

Vec3 read_vector(const JsonField& field, const ShapeVector& vector, SceneFields& fields) {
  if (vector.counts == 0) return fields.position(field);
  Vec3 counts(0.0);
  const auto items = field.items(vector.counts, vector.counts);
  for (std::size_t c = 0; c < items.size(); ++c)
    counts[static_cast<int>(c)] = static_cast<double>(items[c].integer(2, static_cast<std::int64_t>(max_points)));
  return counts;
}

std::size_t read_support(const JsonField& field, const ShapeKind& kind) {
  const auto support = std::ranges::find(kind.supports, field.text());
  if (support == kind.supports.end()) field.refuse(must_be_one_of(joined(kind.supports), field.text()));
  return static_cast<std::size_t>(support - kind.supports.begin());
}

// Reads a field of the position, orientation or support of the shape. Returns false if it is none.
bool read_placement(const JsonField& field, SceneFields& fields, Shape& shape) {
  const bool has_vectors = !shape.kind->vectors.empty();
  if (field.is("at") && !has_vectors)
    shape.at = fields.position(field);
  else if (field.is("turn") && !has_vectors)
    shape.turn = field.number();
  else if (field.is("tilt") && !has_vectors)
    shape.tilt = field.number();
  else if (field.is("held") && !shape.kind->supports.empty())
    shape.support = read_support(field, *shape.kind);
  else
    return false;
  return true;
}

template <class Row>
std::optional<std::size_t> find_row(std::span<const Row> rows, const JsonField& field) {
  const auto row = std::ranges::find_if(rows, [&](const Row& candidate) { return field.is(candidate.name); });
  return row == rows.end() ? std::nullopt : std::optional(static_cast<std::size_t>(row - rows.begin()));
}

void check_required(const JsonField& field, const ShapeKind& kind) {
  for (const ShapeVector& vector : kind.vectors) required(field, vector.name, "must be " + std::string(vector.format));
  for (const ShapeNumber& number : kind.numbers)
    if (number.is_required)
      required(field, number.name, "must be a whole number of at least " + std::to_string(static_cast<std::int64_t>(number.min)));
}

void check_values(const JsonField& field, const Shape& shape) {
  if (shape.kind->check == nullptr) return;
  const std::optional<ShapeError> error = shape.kind->check(shape);
  if (!error) return;
  if (error->field.empty()) field.refuse(error->text);
  if (const auto member = find_member(field, error->field)) member->refuse(error->text);
  field.refuse_missing(error->field, error->text);
}

// Too many points are refused before nails are looked up among them.
void check_size(const JsonField& field, const Shape& shape) {
  const ElementCount count = element_count_of(shape);
  const JsonField place = find_member(field, "points").value_or(field);
  if (count.points > max_points) place.refuse(std::to_string(count.points) + " points: must be at most " + std::to_string(max_points));
  if (count.springs > max_springs) place.refuse(std::to_string(count.springs) + " springs: must be at most " + std::to_string(max_springs));
}

void read_nails(const JsonField& field, Shape& shape) {
  const auto points = static_cast<std::int64_t>(element_count_of(shape).points);
  std::set<Index> nails;
  for (const JsonField item : field.items(0, max_values_per_item)) {
    if (item.is_number()) {
      nails.insert(static_cast<Index>(item.integer(0, points - 1)));
      continue;
    }
    const auto keyword = std::ranges::find(shape.kind->nail_keywords, item.text(), &NailKeyword::word);
    if (keyword == shape.kind->nail_keywords.end()) {
      item.refuse("must be a point number or one of " + joined(shape.kind->nail_keywords, &NailKeyword::word));
    }
    const std::vector<Index> named = keyword->points(shape);
    nails.insert(named.begin(), named.end());
  }
  shape.nails.assign(nails.begin(), nails.end());
}

std::string ids_of_shapes() { return joined(shape_kinds(), &ShapeKind::id); }

}  // namespace

Shape read_shape(const JsonField& field, SceneFields& fields) {
  const JsonField type = required(field, "type", "must be one of " + ids_of_shapes());
  const ShapeKind* kind = find_shape_kind(type.text());
  if (kind == nullptr) type.refuse(must_be_one_of(ids_of_shapes(), type.text()));

  Shape shape = default_shape(*kind);
  std::string unknown;
  std::optional<JsonField> nails;
  for (const JsonField member : field.members()) {
    if (member.is("type")) continue;
    if (const auto number = find_row(kind->numbers, member))
      shape.values[*number] = read_number(member, kind->numbers[*number]);
    else if (const auto vector = find_row(kind->vectors, member))
      shape.vectors[*vector] = read_vector(member, kind->vectors[*vector], fields);
    else if (member.is("color"))
      shape.color = fields.color(member);
    else if (member.is("nail") && !kind->nail_keywords.empty())
      nails = member;
    else if (!read_placement(member, fields, shape))
      fields.preserve_unknown(member, unknown);
  }

  check_required(field, *kind);
  check_values(field, shape);
  check_size(field, shape);
  if (nails) read_nails(*nails, shape);
  return shape;
}

std::vector<Shape> parse_shapes(const std::string& list) {
  std::vector<Shape> shapes;
  JsonParser parser;
  SceneFields fields;
  const std::string name = "generators";
  const auto item = [&](std::string_view, std::size_t index, std::string_view text) {
    shapes.push_back(read_shape({name, name, parser.parse(text), index}, fields));
  };
  walk_json("{\"generators\": " + list + "}", name,
            {.is_list = [](std::string_view) { return true; }, .item = item, .member = [](std::string_view, std::string_view) {}});
  return shapes;
}

}  // namespace hooke
