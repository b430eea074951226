// Reads a scene: scans the text once, reading member by member and point by point, then combines the parts.

#include <array>

#include "base/file_limits.h"
#include "base/json_text.h"
#include "base/printable.h"
#include "base/read_file.h"
#include "formats/gallery.h"
#include "formats/scene_check.h"
#include "formats/scene_file.h"
#include "formats/scene_json/network_reader.h"
#include "formats/scene_json/scene_sections.h"
#include "formats/texture.h"
#include "scene/parameters.h"
#include "scene/step_advice.h"
#include "scene/warnings/warnings.h"
#include "sim/plan/hinges.h"

namespace hooke {
namespace {

class SceneReader {
 public:
  SceneReader(const std::string& text, const std::string& name, const Progress& progress) : text_(text), name_(name), progress_(progress) {}

  LoadedScene read() {
    walk_json(text_, name_,
              {.is_list = [](std::string_view key) { return find_list(key) != nullptr; },
               .item = [this](std::string_view key, std::size_t index, std::string_view text) { read_item(key, index, text); },
               .member = [this](std::string_view key, std::string_view text) { read_member(key, text); }});
    if (!has_version_) throw InputError(name_ + ": Not a Hooke scene: \"hooke\": 1 is missing");
    fields_.check_dimensions(scene_.system.dimensions);

    Network network = network_.take(scene_.system.dimensions);
    check_hand(network.points.size());

    scene_.system.muscles.offset = muscle_offset_;
    scene_.system.set_points(std::move(network.points));
    scene_.system.set_springs(std::move(network.springs));
    scene_.system.faces = std::move(network.faces);
    scene_.state.position = std::move(network.position);
    scene_.state.velocity = std::move(network.velocity);
    if (!network.cloth_coordinates.empty())
      scene_.cloth_texture.cloth_coordinates = std::make_shared<const ClothCoordinates>(std::move(network.cloth_coordinates));
    if (!network.sheet_areas.empty() || !network.sheet_weights.empty())
      scene_.sheet = std::make_shared<const SheetWeights>(SheetWeights{std::move(network.sheet_areas), std::move(network.sheet_weights)});
    set_rest_angles(scene_.system, scene_.state.position);
    if (!network.rest_angles.empty()) {
      scene_.system.faces.set_rest_angles(std::move(network.rest_angles));
      if (const auto warning = rest_angle_warning(scene_.system)) fields_.warn(*warning);
    }
    set_print_layout(scene_);
    for (const std::string& warning : settings_warnings(scene_.system, scene_.state, scene_.settings)) fields_.warn(warning);
    for (const std::string& warning : crossing_warnings(scene_.system, scene_.state)) fields_.warn(warning);
    for (const auto& warning : {thickness_warning(scene_.system), bending_warning(scene_.system), pressure_warning(scene_.system),
                                strain_limit_warning(scene_.system, scene_.state), small_collider_warning(scene_.system, scene_.state)})
      if (warning) fields_.warn(*warning);
    return {std::move(scene_), fields_.warnings(name_)};
  }

  // Reads an addition to `scene`.
  void start_from(const Scene& scene) {
    scene_.system.dimensions = scene.system.dimensions;
    copy_surroundings(scene, scene_);
    is_addition_ = true;
  }

 private:
  // Points, springs, faces, generators and colliders are read item by item, because a file of 256 MiB would otherwise become gigabytes of
  // values.
  struct List {
    std::string_view key;
    std::uint64_t max;
    void (SceneReader::*read)(const JsonField& field);
  };
  static const std::array<List, 7> lists;

  static const List* find_list(std::string_view key) {
    for (const List& list : lists)
      if (list.key == key) return &list;
    return nullptr;
  }

  void read_member(std::string_view key, std::string_view text) {
    if (find_list(key) != nullptr && text.front() == '[') {
      // its items have been read
      if (key == "generators") scene_.preserved_json.generators = text;
      return;
    }

    if (is_addition_)
      for (const char* other : {"name", "description", "notes", "muscle_offset", "dimensions", "time", "center_point", "hand", "view",
                                "defaults", "controls", "check", "gallery"})
        if (key == other) refuse(other, "cannot be added to a scene");
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
    else if (field.is("notes"))
      scene_.notes = field.text();
    else if (field.is("dimensions"))
      scene_.system.dimensions = static_cast<int>(field.integer(2, 3));
    else if (field.is("time"))
      scene_.state.time = field.number();
    else if (field.is("muscle_offset"))
      muscle_offset_ = field.number();
    else if (field.is("gravity"))
      scene_.system.gravity = fields_.position(field);
    else if (field.is("wind"))
      scene_.system.wind = fields_.position(field);
    else if (field.is("center_point"))
      scene_.system.center_point = PointId{static_cast<std::uint32_t>(field.integer(0, static_cast<std::int64_t>(max_points) - 1))};
    else if (field.is("contact"))
      read_contact(field, fields_, scene_);
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

  void read_item(std::string_view key, std::size_t index, std::string_view text) {
    const List& list = *find_list(key);
    if (index >= list.max) refuse(std::string(key), std::to_string(index + 1) + " items: must be at most " + std::to_string(list.max));
    if (progress_ && is_progress_step(index) &&
        !progress_(static_cast<double>(text.data() - text_.data()) / static_cast<double>(text_.size())))
      throw InputError(name_ + ": reading was canceled");
    (this->*list.read)(JsonField(name_, key, parser_.parse(text), index));
  }

  void read_point(const JsonField& field) { network_.read_point(field); }
  void read_spring(const JsonField& field) { network_.read_spring(field); }
  void read_face(const JsonField& field) { network_.read_face(field); }
  void read_rest_angles(const JsonField& field) { network_.read_rest_angles(field); }
  void read_generator(const JsonField& field) { network_.read_generator(field); }
  void read_one_collider(const JsonField& field) { read_collider(field, fields_, scene_); }
  void read_one_force(const JsonField& field) { read_force(field, fields_, scene_); }

  void check_hand(std::size_t points) const {
    if (const auto& center = scene_.system.center_point; center && static_cast<std::uint32_t>(*center) >= points)
      refuse("center_point", no_such_point(static_cast<std::uint32_t>(*center), points));
    if (!scene_.system.scripted_hand) return;
    if (const auto number = static_cast<std::uint32_t>(scene_.system.scripted_hand->point); number >= points)
      refuse("hand.point", no_such_point(number, points));
    if (scene_.system.dimensions != 2) return;
    const Vec3& axis = scene_.system.scripted_hand->axis;
    if (axis.x != 0.0 || axis.y != 0.0)
      refuse("hand.circle.axis",
             "[" + format_exact(axis.x) + ", " + format_exact(axis.y) + ", " + format_exact(axis.z) + "]: must be along z in a 2-D scene");
  }

  [[noreturn]] void refuse(const std::string& field, const std::string& what) const {
    throw InputError(name_ + ": " + field + ": " + what);
  }

  const std::string& text_;
  const std::string& name_;
  const Progress& progress_;
  JsonParser parser_;
  SceneFields fields_;
  Scene scene_;
  NetworkReader network_{name_, fields_, scene_.preserved_json};
  bool has_version_ = false, is_addition_ = false;
  double muscle_offset_ = 0.0;  // [s]
};

const std::array<SceneReader::List, 7> SceneReader::lists{
    List{"points", max_points, &SceneReader::read_point},
    List{"springs", max_springs, &SceneReader::read_spring},
    List{"faces", max_faces, &SceneReader::read_face},
    List{"rest_angles", max_faces, &SceneReader::read_rest_angles},
    List{"generators", max_generators, &SceneReader::read_generator},
    List{"colliders", max_colliders, &SceneReader::read_one_collider},
    List{"forces", max_forces, &SceneReader::read_one_force},
};

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

Scene parse_members(std::string_view members, const std::string& name, const Scene& scene) {
  const std::string text = "{\"hooke\": 1, " + std::string(members) + "}";
  const std::string shown = printable(name);
  SceneReader reader(text, shown, {});
  reader.start_from(scene);
  LoadedScene loaded = reader.read();
  // here an unknown field is a mistake; in a file it may be of a later version
  for (const std::string& warning : loaded.warnings)
    if (const std::size_t end = warning.find(", kept"); end != std::string::npos) throw InputError(warning.substr(0, end));
  return std::move(loaded.scene);
}

LoadedScene load_scene(const std::filesystem::path& file, const Progress& progress) { return load_scene_from_copy(file, file, progress); }

LoadedScene load_scene_from_copy(const std::filesystem::path& copy, const std::filesystem::path& original, const Progress& progress) {
  const std::string text = read_text_file(copy), name = printable(copy.native());
  LoadedScene loaded = SceneReader(text, name, progress).read();
  add_picture(loaded, original.parent_path(), name);
  return loaded;
}

}  // namespace hooke
