// Reads a scene: scans the text once, reading member by member and point by point, then combines the parts.

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "base/file_limits.h"
#include "base/json_text.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/gallery.h"
#include "formats/scene_check.h"
#include "formats/scene_file.h"
#include "formats/scene_json/scene_sections.h"
#include "formats/scene_json/shape_fields.h"
#include "formats/texture.h"
#include "scene/spring_family.h"
#include "scene/step_limits.h"

namespace hooke {
namespace {

constexpr double rest_length_not_given = std::numeric_limits<double>::quiet_NaN();  // no rest length was given

// Entries between the end of the list and `place` are NaN.
void append_at(std::vector<double>& list, std::size_t place, double value) {
  list.resize(place, 0.0);
  list.push_back(value);
}

bool is_finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

class SceneReader {
 public:
  SceneReader(const std::string& text, const std::string& name, const Progress& progress) : text_(text), name_(name), progress_(progress) {}
  LoadedScene read();

 private:
  // Points, springs, faces, generators and colliders are read item by item, because a file of 256 MiB would otherwise become gigabytes of
  // values.
  struct List {
    std::string_view key;
    std::uint64_t max;
    void (SceneReader::*read)(const JsonField& field);
  };
  static const std::array<List, 6> lists;
  static const List* find_list(std::string_view key);

  void read_member(std::string_view key, std::string_view text);
  void read_item(std::string_view key, std::size_t index, std::string_view text);
  void read_point(const JsonField& field);
  void read_spring(const JsonField& field);
  void read_face(const JsonField& field);
  void read_cloth_place(const JsonField& field);
  void read_one_shape(const JsonField& field);
  void read_one_collider(const JsonField& field) { read_collider(field, fields_, scene_); }
  void read_one_force(const JsonField& field) { read_force(field, fields_, scene_); }
  PointId read_point_number(const JsonField& field) const;

  void generate_all();
  void check_generated(std::size_t generator, std::size_t first_point, std::size_t first_spring) const;
  void check_point_numbers() const;
  void check_hand() const;
  void set_rest_lengths();
  void warn_about_coincident_points();
  [[noreturn]] void refuse(const std::string& field, const std::string& what) const {
    throw InputError(name_ + ": " + field + ": " + what);
  }

  const std::string& text_;
  const std::string& name_;
  const Progress& progress_;
  JsonParser parser_;
  SceneFields fields_;
  Scene scene_;
  Network network_;
  std::vector<Shape> shapes_;
  bool has_version_ = false;
};

const std::array<SceneReader::List, 6> SceneReader::lists{
    List{"points", max_points, &SceneReader::read_point},
    List{"springs", max_springs, &SceneReader::read_spring},
    List{"faces", max_faces, &SceneReader::read_face},
    List{"generators", max_generators, &SceneReader::read_one_shape},
    List{"colliders", max_colliders, &SceneReader::read_one_collider},
    List{"forces", max_forces, &SceneReader::read_one_force},
};

const SceneReader::List* SceneReader::find_list(std::string_view key) {
  for (const List& list : lists)
    if (list.key == key) return &list;
  return nullptr;
}

LoadedScene SceneReader::read() {
  walk_json(text_, name_,
            {.is_list = [](std::string_view key) { return find_list(key) != nullptr; },
             .item = [this](std::string_view key, std::size_t index, std::string_view text) { read_item(key, index, text); },
             .member = [this](std::string_view key, std::string_view text) { read_member(key, text); }});
  if (!has_version_) refuse("hooke", "missing: must be 1, the version of the format");
  fields_.check_dimensions(scene_.system.dimensions);

  generate_all();
  check_point_numbers();
  check_hand();
  set_rest_lengths();
  warn_about_coincident_points();

  scene_.system.set_points(std::move(network_.points));
  scene_.system.set_springs(std::move(network_.springs));
  scene_.system.faces = std::move(network_.faces);
  scene_.state.position = std::move(network_.position);
  scene_.state.velocity = std::move(network_.velocity);
  if (!network_.cloth_coordinates.empty())
    scene_.cloth_texture.cloth_coordinates = std::make_shared<const ClothCoordinates>(std::move(network_.cloth_coordinates));
  if (!network_.sheet_areas.empty() || !network_.sheet_weights.empty())
    scene_.sheet = std::make_shared<const SheetWeights>(SheetWeights{std::move(network_.sheet_areas), std::move(network_.sheet_weights)});
  set_print_layout(scene_);
  if (const auto warning = step_warning(scene_.system, scene_.settings)) fields_.warn(*warning);
  return {std::move(scene_), fields_.warnings(name_)};
}

void SceneReader::read_member(std::string_view key, std::string_view text) {
  if (find_list(key) != nullptr && text.front() == '[') {
    // its items have been read
    if (key == "generators") scene_.preserved_json.generators = text;
    return;
  }

  const JsonField field(name_, key, parser_.parse(text));
  if (field.is("hooke")) {
    if (field.number() > newest_scene_version)
      field.refuse("must be at most " + std::to_string(newest_scene_version) + ": scenes of version " + format_exact(field.number()) +
                   " need a newer Hooke");
    field.integer(1, newest_scene_version);
    has_version_ = true;
  } else if (field.is("name"))
    scene_.name = field.text();
  else if (field.is("description"))
    scene_.description = field.text();
  else if (field.is("dimensions"))
    scene_.system.dimensions = static_cast<int>(field.integer(2, 3));
  else if (field.is("time"))
    scene_.state.time = field.number();
  else if (field.is("gravity"))
    scene_.system.gravity = fields_.position(field);
  else if (field.is("wind"))
    scene_.system.wind = fields_.position(field);
  else if (field.is("hand"))
    read_hand(field, fields_, scene_);
  else if (field.is("simulation"))
    read_simulation(field, fields_, scene_);
  else if (field.is("view"))
    read_view(field, fields_, scene_);
  else if (field.is("defaults"))
    read_defaults(field, fields_, scene_);
  else if (field.is("controls"))
    read_controls(field, fields_, scene_);
  else if (field.is("check")) {
    read_scene_check(field);
    scene_.preserved_json.check = text;
  } else if (field.is("gallery")) {
    read_gallery_entry(field);
    scene_.preserved_json.gallery = text;
  } else if (find_list(key) != nullptr)
    field.refuse("must be a list [...]");
  else if (!read_parameter(field, scene_))
    fields_.preserve_unknown(field, scene_.preserved_json.unknown, text);
}

void SceneReader::read_item(std::string_view key, std::size_t index, std::string_view text) {
  const List& list = *find_list(key);
  if (index >= list.max) refuse(std::string(key), std::to_string(index + 1) + " items: must be at most " + std::to_string(list.max));
  if (progress_ && is_progress_step(index) &&
      !progress_(static_cast<double>(text.data() - text_.data()) / static_cast<double>(text_.size())))
    throw InputError(name_ + ": reading was canceled");
  (this->*list.read)(JsonField(name_, key, parser_.parse(text), index));
}

void SceneReader::read_point(const JsonField& field) {
  Point point{.id = PointId{static_cast<std::uint32_t>(network_.points.size())}};
  Vec3 position(0.0), velocity(0.0);
  bool has_position = false;
  for (const JsonField member : field.members()) {
    if (member.is("position")) {
      position = fields_.position(member);
      has_position = true;
    } else if (member.is("velocity"))
      velocity = fields_.position(member);
    else if (member.is("nailed"))
      point.nailed = member.boolean();
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
      fields_.preserve_unknown(member, scene_.preserved_json.unknown_of_points[point.id]);
  }
  if (!has_position) field.refuse_missing("position", "must be [x, y, z]");
  network_.points.push_back(point);
  network_.position.push_back(position);
  network_.velocity.push_back(velocity);
}

void SceneReader::read_spring(const JsonField& field) {
  Spring spring{.id = SpringId{static_cast<std::uint32_t>(network_.springs.size())}, .rest_length = rest_length_not_given};
  bool has_points = false, has_stiffness = false;
  for (const JsonField member : field.members()) {
    if (member.is("points")) {
      const auto ends = member.items(2, 2);
      spring.first = read_point_number(ends[0]);
      spring.second = read_point_number(ends[1]);
      if (spring.first == spring.second) member.refuse("must be two different points");
      has_points = true;
    } else if (member.is("stiffness")) {
      spring.stiffness = member.number(not_negative);
      has_stiffness = true;
    } else if (member.is("damping"))
      spring.damping = member.number(not_negative);
    else if (member.is("family"))
      spring.family = read_family(member);
    else if (member.is("share"))
      append_at(network_.sheet_weights, network_.springs.size(), member.number(not_negative));
    else if (member.is("rest_length"))
      spring.rest_length = member.number(not_negative);
    else if (member.is("break_strain"))
      spring.break_strain = member.is_null() ? never_breaks : member.number(positive);
    else
      fields_.preserve_unknown(member, scene_.preserved_json.unknown_of_springs[spring.id]);
  }
  if (!has_points) field.refuse_missing("points", "must be two point numbers");
  if (!has_stiffness) field.refuse_missing("stiffness", "must be a number of at least 0");
  network_.springs.push_back(spring);
}

// Of the point that is being read.
void SceneReader::read_cloth_place(const JsonField& field) {
  const auto items = field.items(2, 2);
  network_.cloth_coordinates.resize(network_.points.size(), no_cloth_coordinates);
  network_.cloth_coordinates.emplace_back(items[0].number(), items[1].number());
}

void SceneReader::read_face(const JsonField& field) {
  const auto corners = field.items(3, 3);
  Face face;
  for (std::size_t c = 0; c < 3; ++c) face.points[c] = read_point_number(corners[c]);
  if (face.points[0] == face.points[1] || face.points[1] == face.points[2] || face.points[2] == face.points[0])
    field.refuse("must be three different points");
  network_.faces.push_back(face);
}

void SceneReader::read_one_shape(const JsonField& field) { shapes_.push_back(read_shape(field, fields_)); }

// Whether the point exists is known only when all points have been read: check_point_numbers.
PointId SceneReader::read_point_number(const JsonField& field) const {
  return PointId{static_cast<std::uint32_t>(field.integer(0, static_cast<std::int64_t>(max_points) - 1))};
}

// All elements are counted before any memory is allocated for them.
void SceneReader::generate_all() {
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
    check_generated(g, first_point, first_spring);
  }
}

// Extreme sizes lead to zero masses and infinite stiffnesses.
void SceneReader::check_generated(std::size_t generator, std::size_t first_point, std::size_t first_spring) const {
  const std::string field = "generators[" + std::to_string(generator) + "]";
  for (std::size_t i = first_point; i < network_.points.size(); ++i) {
    const double mass = network_.points[i].mass, radius = network_.points[i].radius;
    if (!(mass >= std::numeric_limits<double>::min()) || !std::isfinite(mass))
      refuse(field, "mass of a point: " + format_exact(mass) + ": must be more than 0 and a number");
    if (!is_finite(network_.position[i]) || !std::isfinite(radius)) refuse(field, "position of a point: must be a number below 1.8e308");
    if (scene_.system.dimensions == 2 && network_.position[i].z != 0.0)
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

void SceneReader::check_point_numbers() const {
  const auto check = [&](PointId id, const auto& name_field) {
    const auto number = static_cast<std::uint32_t>(id);
    if (number >= network_.points.size())
      refuse(name_field(),
             std::to_string(number) + ": must be the number of one of the " + std::to_string(network_.points.size()) + " points, from 0");
  };
  for (std::size_t s = 0; s < network_.springs.size(); ++s)
    for (const PointId id : {network_.springs[s].first, network_.springs[s].second})
      check(id, [&] { return "springs[" + std::to_string(s) + "].points[" + (id == network_.springs[s].first ? "0" : "1") + "]"; });
  for (std::size_t f = 0; f < network_.faces.size(); ++f)
    for (const PointId id : network_.faces[f].points) check(id, [&] { return "faces[" + std::to_string(f) + "]"; });
  if (scene_.system.scripted_hand) check(scene_.system.scripted_hand->point, [] { return std::string("hand.point"); });
}

void SceneReader::check_hand() const {
  if (!scene_.system.scripted_hand || scene_.system.dimensions != 2) return;
  const Vec3& axis = scene_.system.scripted_hand->axis;
  if (axis.x != 0.0 || axis.y != 0.0)
    refuse("hand.circle.axis",
           "[" + format_exact(axis.x) + ", " + format_exact(axis.y) + ", " + format_exact(axis.z) + "]: must be along z in a 2-D scene");
}

void SceneReader::set_rest_lengths() {
  for (std::size_t s = 0; s < network_.springs.size(); ++s) {
    Spring& spring = network_.springs[s];
    if (!std::isnan(spring.rest_length)) continue;
    const auto i = static_cast<std::uint32_t>(spring.first), j = static_cast<std::uint32_t>(spring.second);
    spring.rest_length = glm::length(network_.position[j] - network_.position[i]);
    if (!std::isfinite(spring.rest_length))
      refuse("springs[" + std::to_string(s) + "].rest_length",
             format_exact(spring.rest_length) + " as drawn: must be a number below 1.8e308");
  }
}

void SceneReader::warn_about_coincident_points() {
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

// A scene whose texture is missing is drawn without it.
void add_picture(LoadedScene& loaded, const std::filesystem::path& folder, const std::string& name) {
  const std::string& texture = loaded.scene.view.texture;
  if (texture.empty()) return;
  try {
    loaded.scene.cloth_texture.picture = read_texture(texture, folder, name + ": view.texture: \"" + printable(texture) + "\"");
  } catch (const FileError& error) {
    loaded.warnings.push_back(std::string(error.what()) + ": drawn without it");
  }
}

}  // namespace

LoadedScene parse_scene(std::string_view text, const std::string& name, const Progress& progress) {
  return SceneReader(std::string(text), printable(name), progress).read();
}
LoadedScene parse_scene(std::string_view text, const std::string& name) { return parse_scene(text, name, {}); }

LoadedScene load_scene(const std::filesystem::path& file, const Progress& progress) { return load_scene_from_copy(file, file, progress); }

LoadedScene load_scene_from_copy(const std::filesystem::path& copy, const std::filesystem::path& original, const Progress& progress) {
  const std::string text = read_file(copy), name = printable(copy.native());
  LoadedScene loaded = SceneReader(text, name, progress).read();
  add_picture(loaded, original.parent_path(), name);
  return loaded;
}

}  // namespace hooke
