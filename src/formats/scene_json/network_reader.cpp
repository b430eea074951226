#include "formats/scene_json/network_reader.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/finite.h"
#include "formats/scene_json/spring_law_fields.h"
#include "formats/texture.h"
#include "scene/spring_family.h"
#include "scene/spring_laws.h"

namespace hooke {
namespace {

constexpr double rest_length_not_given = std::numeric_limits<double>::quiet_NaN();  // no rest length was given

// Entries between the end of the list and `place` are NaN.
void append_at(NumberList& list, std::size_t place, double value) {
  list.resize(place, 0.0);
  list.push_back(value);
}

}  // namespace

std::string no_such_point(std::uint32_t number, std::size_t points) {
  return std::to_string(number) + ": must be the number of one of the " + std::to_string(points) + " points, from 0";
}

Network NetworkReader::take(int dimensions) {
  generate_shapes(dimensions);
  check_point_numbers();
  set_rest_lengths();
  if (const std::size_t angles = network_.rest_angles.size(); angles != 0 && angles != 3 * network_.faces.size())
    refuse("rest_angles",
           std::to_string(angles / 3) + " items: must be as many as the " + std::to_string(network_.faces.size()) + " faces");
  warn_about_coincident_points();
  return std::move(network_);
}

void NetworkReader::refuse(const std::string& field, const std::string& what) const {
  throw InputError(name_ + ": " + field + ": " + what);
}

void NetworkReader::read_point(const JsonField& field) {
  Point point{.id = PointId{static_cast<std::uint32_t>(network_.points.size())}};
  Vec3 position(0.0), velocity(0.0);
  for (const JsonField member : field.members()) {
    if (member.is("position"))
      position = fields_.position(member);
    else if (member.is("velocity"))
      velocity = fields_.position(member);
    else if (member.is("nailed"))
      point.nailed = member.boolean();
    else if (member.is("fixed")) {
      const auto axes = axes_of(member.text());
      if (!axes) member.refuse("must be axes in their order, as \"y\" or \"xz\"");
      point.fixed_axes = *axes;
    } else if (member.is("load"))
      point.load = fields_.vector(member);
    else if (member.is("mass"))
      point.mass = member.number(positive);
    else if (member.is("radius"))
      point.radius = member.number(not_negative);
    else if (member.is("color"))
      point.color = fields_.color(member);
    else if (member.is("uv"))
      read_cloth_place(member);
    else if (member.is("area"))
      append_at(network_.sheet_areas, network_.points.size(), member.number(not_negative));
    else
      fields_.preserve_unknown(member, unknown_.unknown_of_points[point.id]);
  }
  required(field, "position", "must be [x, y, z]");
  network_.points.push_back(point);
  network_.position.push_back(position);
  network_.velocity.push_back(velocity);
}

void NetworkReader::read_spring(const JsonField& field) {
  Spring spring{.id = SpringId{static_cast<std::uint32_t>(network_.springs.size())}, .rest_length = rest_length_not_given};
  for (const JsonField member : field.members()) {
    if (member.is("points")) {
      const auto ends = member.items(2, 2);
      spring.first = read_point_number(ends[0]);
      spring.second = read_point_number(ends[1]);
      if (spring.first == spring.second) member.refuse("must be two different points");
    } else if (member.is("stiffness"))
      spring.stiffness = member.number(not_negative);
    else if (member.is("damping"))
      spring.damping = member.number(not_negative);
    else if (member.is("family"))
      spring.family = read_family(member);
    else if (member.is("share"))
      append_at(network_.sheet_weights, network_.springs.size(), member.number(not_negative));
    else if (member.is("rest_length"))
      spring.rest_length = member.number(not_negative);
    else if (member.is("break_strain"))
      spring.break_strain = member.is_null() ? never_breaks : member.number(positive);
    else if (!read_law_field(member, spring))
      fields_.preserve_unknown(member, unknown_.unknown_of_springs[spring.id]);
  }
  required(field, "points", "must be two point numbers");
  required(field, "stiffness", "must be a number of at least 0");
  network_.springs.push_back(spring);
}

// Of the point that is being read.
void NetworkReader::read_cloth_place(const JsonField& field) {
  const auto items = field.items(2, 2);
  network_.cloth_coordinates.resize(network_.points.size(), no_cloth_coordinates);
  network_.cloth_coordinates.emplace_back(items[0].number(), items[1].number());
}

void NetworkReader::read_face(const JsonField& field) {
  const auto corners = field.items(3, 3);
  Face face;
  for (std::size_t c = 0; c < 3; ++c) face.points[c] = read_point_number(corners[c]);
  if (face.points[0] == face.points[1] || face.points[1] == face.points[2] || face.points[2] == face.points[0])
    field.refuse("must be three different points");
  network_.faces.push_back(face);
}

void NetworkReader::read_rest_angles(const JsonField& field) {
  constexpr Bounds half_turn{.min = -3.141592653589793, .max = 3.141592653589793};
  const auto items = field.items(3, 3);
  for (const JsonField& angle : items) network_.rest_angles.push_back(angle.number(half_turn));
}

// Whether the point exists is known only when all points have been read: check_point_numbers.
PointId NetworkReader::read_point_number(const JsonField& field) const {
  return PointId{static_cast<std::uint32_t>(field.integer(0, static_cast<std::int64_t>(max_points) - 1))};
}

// All elements are counted before any memory is allocated for them.
void NetworkReader::generate_shapes(int dimensions) {
  ElementCount all{network_.points.size(), network_.springs.size(), network_.faces.size()};
  for (const Shape& shape : shapes_) {
    const ElementCount count = element_count_of(shape);
    all.points += count.points;
    all.springs += count.springs;
    all.faces += count.faces;
  }
  const auto check = [&](const char* what, std::uint64_t count, std::uint64_t max) {
    if (count > max) refuse(what, std::to_string(count) + " with those of the generators: must be at most " + std::to_string(max));
  };
  check("points", all.points, max_points);
  check("springs", all.springs, max_springs);
  check("faces", all.faces, max_faces);

  network_.points.reserve(all.points);
  network_.position.reserve(all.points);
  network_.velocity.reserve(all.points);
  network_.springs.reserve(all.springs);
  network_.faces.reserve(all.faces);
  for (std::size_t g = 0; g < shapes_.size(); ++g) {
    const std::size_t first_point = network_.points.size(), first_spring = network_.springs.size();
    generate(shapes_[g], network_);
    check_generated(g, first_point, first_spring, dimensions);
  }
}

// Extreme sizes lead to zero masses and infinite stiffnesses.
void NetworkReader::check_generated(std::size_t generator, std::size_t first_point, std::size_t first_spring, int dimensions) const {
  const std::string field = "generators[" + std::to_string(generator) + "]";
  for (std::size_t i = first_point; i < network_.points.size(); ++i) {
    const double mass = network_.points[i].mass, radius = network_.points[i].radius;
    if (!(mass >= std::numeric_limits<double>::min()) || !std::isfinite(mass))
      refuse(field, "mass of a point: " + format_exact(mass) + ": must be from 2.3e-308 to 1.7e308");
    if (!is_finite(network_.position[i]) || !std::isfinite(radius)) refuse(field, "position of a point: must be a number below 1.8e308");
    if (dimensions == 2 && network_.position[i].z != 0.0)
      refuse(field, "position of a point: z = " + format_exact(network_.position[i].z) + ": must be 0 in a 2-D scene");
  }
  for (std::size_t s = first_spring; s < network_.springs.size(); ++s) {
    const Spring& spring = network_.springs[s];
    for (const auto& [what, value] :
         {std::pair{"stiffness", spring.stiffness}, {"damping", spring.damping}, {"rest length", spring.rest_length}})
      if (!std::isfinite(value))
        refuse(field, std::string(what) + " of a spring: " + format_exact(value) + ": must be a number below 1.8e308");
  }
}

void NetworkReader::check_point_numbers() const {
  const auto missing = [&](PointId id) { return no_such_point(static_cast<std::uint32_t>(id), network_.points.size()); };
  const auto exists = [&](PointId id) { return static_cast<std::uint32_t>(id) < network_.points.size(); };
  for (std::size_t s = 0; s < network_.springs.size(); ++s)
    for (const PointId id : {network_.springs[s].first, network_.springs[s].second})
      if (!exists(id))
        refuse("springs[" + std::to_string(s) + "].points[" + (id == network_.springs[s].first ? "0" : "1") + "]", missing(id));
  for (std::size_t f = 0; f < network_.faces.size(); ++f)
    for (const PointId id : network_.faces[f].points)
      if (!exists(id)) refuse("faces[" + std::to_string(f) + "]", missing(id));
}

// Those that are not given are as drawn. Laws may depend on them.
void NetworkReader::set_rest_lengths() {
  for (std::size_t s = 0; s < network_.springs.size(); ++s) {
    Spring spring = network_.springs[s];
    const auto field = [&] { return "springs[" + std::to_string(s) + "]."; };
    if (std::isnan(spring.rest_length)) {
      const auto i = static_cast<std::uint32_t>(spring.first), j = static_cast<std::uint32_t>(spring.second);
      spring.rest_length = glm::length(network_.position[j] - network_.position[i]);
      if (!std::isfinite(spring.rest_length))
        refuse(field() + "rest_length", format_exact(spring.rest_length) + " as drawn: must be a number below 1.8e308");
      network_.springs.set_properties(s, spring);
    }
    if (const LawError error = error_of(spring); !error.limit.empty()) refuse(field() + std::string(error.field), error.limit);
  }
}

void NetworkReader::warn_about_coincident_points() {
  std::size_t first = 0, count = 0;
  for (std::size_t s = 0; s < network_.springs.size(); ++s) {
    const auto i = static_cast<std::uint32_t>(network_.springs[s].first), j = static_cast<std::uint32_t>(network_.springs[s].second);
    if (network_.position[i] == network_.position[j] && count++ == 0) first = s;
  }
  if (count == 0) return;
  const std::string others = count == 1 ? "" : " and " + std::to_string(count - 1) + " more";
  fields_.warn("springs[" + std::to_string(first) + "]" + others +
               ": connects two points at the same position: no force between them until they separate");
}

}  // namespace hooke
