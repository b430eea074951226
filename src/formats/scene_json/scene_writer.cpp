// Writes a scene, one point or spring per line.

#include <array>
#include <cmath>

#include "base/atomic_write.h"
#include "base/file_limits.h"
#include "base/formatted.h"
#include "base/json_writer.h"
#include "base/overloaded.h"
#include "base/printable.h"
#include "base/same_bits.h"
#include "formats/scene_file.h"
#include "formats/scene_json/listed_part.h"
#include "formats/scene_json/spring_law_fields.h"
#include "scene/parameters.h"
#include "scene/spring_family.h"
#include "sim/methods/integrator.h"
#include "sim/plan/hinges.h"

namespace hooke {
namespace {

using Layout = JsonWriter::Layout;

bool is_positive_zero(double value) { return same_bits(value, 0.0); }
bool is_positive_zero(const Vec3& value) { return same_bits(value, Vec3(0.0)); }

std::string to_text(const Color& color) { return formatted("#%02x%02x%02x", color.red, color.green, color.blue); }

class SceneWriter {
 public:
  SceneWriter(const Scene& scene, const Progress& progress)
      : scene_(scene), system_(scene.system), state_(scene.state), progress_(progress) {}

  std::string write() {
    const ListedCounts listed = find_listed(scene_);
    items_ = static_cast<std::size_t>(listed.points) + static_cast<std::size_t>(listed.springs) + listed.faces;
    out_.begin_object(Layout::Lines);
    out_.integer("hooke", newest_scene_version);
    out_.text("name", scene_.name);
    if (!scene_.description.empty()) out_.text("description", scene_.description);
    if (!scene_.notes.empty()) out_.text("notes", scene_.notes);
    if (!scene_.preserved_json.gallery.empty()) out_.raw("gallery", scene_.preserved_json.gallery);
    out_.integer("dimensions", system_.dimensions);
    if (!is_positive_zero(state_.time)) out_.number("time", state_.time);
    out_.vector("gravity", system_.gravity + Vec3(0.0));  // no -0.0
    if (!is_positive_zero(system_.wind)) out_.vector("wind", system_.wind);
    write_parameters("");
    if (!is_positive_zero(system_.muscles.offset)) out_.number("muscle_offset", system_.muscles.offset);

    write_list("points", static_cast<std::size_t>(listed.points), [&](std::size_t i) { write_point(static_cast<Index>(i)); });
    write_list("springs", static_cast<std::size_t>(listed.springs), [&](std::size_t s) { write_spring(static_cast<Index>(s)); });
    write_list("faces", listed.faces, [&](std::size_t f) {
      out_.list(Layout::Line, system_.faces[f].points, [&](PointId id) { out_.integer(system_.index_of(id)); });
    });
    write_rest_angles();
    if (listed.points < system_.point_count()) out_.raw("generators", scene_.preserved_json.generators);
    write_list("colliders", system_.colliders.size(), [&](std::size_t c) { write_collider(c); });
    write_contact();
    write_list("forces", system_.forces.size(), [&](std::size_t f) { write_force(f); });
    if (system_.center_point && system_.index_of(*system_.center_point) != no_index)
      out_.integer("center_point", system_.index_of(*system_.center_point));

    write_hand();
    write_simulation();
    write_defaults();
    if (scene_.controls != ControlRanges{} || has_unknown_inside("controls")) {
      const ControlRanges& controls = scene_.controls;
      out_.begin_object("controls", Layout::Line);
      if (controls != ControlRanges{}) out_.vector("stiffness", {controls.stiffness_min, controls.stiffness_max, controls.stiffness_step});
      write_unknown_inside("controls");
      out_.end();
    }
    write_view();
    if (!scene_.preserved_json.check.empty()) out_.raw("check", scene_.preserved_json.check);
    out_.members(scene_.preserved_json.unknown);
    out_.end();
    check_size();
    return out_.take() + "\n";
  }

 private:
  // The rows of the table of parameters whose field is in the section ("" at the top, "simulation").
  void write_parameters(std::string_view section) {
    for (const Parameter& row : parameters()) {
      const std::size_t dot = row.field.rfind('.');
      const std::string_view parent = dot == std::string_view::npos ? "" : row.field.substr(0, dot);
      if (row.field.empty() || parent != section) continue;
      const double value = row.read(scene_);
      if ((row.applies != nullptr || row.omit_if_default) && value == row.default_value) continue;
      out_.key(row.field.substr(dot == std::string_view::npos ? 0 : dot + 1));
      switch (row.kind) {
        case Parameter::Kind::Switch:
          out_.boolean(value != 0.0);
          break;
        case Parameter::Kind::Integer:
          out_.integer(static_cast<std::int64_t>(value));
          break;
        case Parameter::Kind::Choice:
          out_.text(row.choices[static_cast<std::size_t>(value)].id);
          break;
        case Parameter::Kind::Number:
          out_.number(value);
          break;
      }
    }
  }

  void write_point(Index i) {
    const Point& point = system_.points()[i];
    out_.begin_object(Layout::Line);
    out_.vector("position", state_.position[i]);
    if (!is_positive_zero(state_.velocity[i])) out_.vector("velocity", state_.velocity[i]);
    if (point.nailed) out_.boolean("nailed", true);
    if (point.fixed_axes != 0) out_.text("fixed", axes_text(point.fixed_axes));
    if (!is_positive_zero(point.load)) out_.vector("load", point.load);
    out_.number("mass", point.mass);
    out_.number("radius", point.radius);
    if (point.color) out_.text("color", to_text(*point.color));
    if (const glm::dvec2 place = cloth_coordinates_of(scene_.cloth_texture, point.id); std::isfinite(place.x))
      out_.list("uv", Layout::Line, std::array{place.x, place.y}, [&](double coordinate) { out_.number(coordinate); });
    if (const double area = area_of(scene_.sheet.get(), point.id); area > 0.0) out_.number("area", area);
    const auto unknown = scene_.preserved_json.unknown_of_points.find(point.id);
    if (unknown != scene_.preserved_json.unknown_of_points.end()) out_.members(unknown->second);
    out_.end();
  }

  void write_spring(Index s) {
    const Spring spring = system_.springs()[s];
    out_.begin_object(Layout::Line);
    out_.list("points", Layout::Line, std::array{spring.first, spring.second}, [&](PointId id) { out_.integer(system_.index_of(id)); });
    if (spring.family != SpringFamily::None) out_.text("family", name_of(spring.family));
    out_.number("stiffness", spring.stiffness);
    if (!is_positive_zero(spring.damping)) out_.number("damping", spring.damping);
    out_.number("rest_length", spring.rest_length);
    if (spring.break_strain != never_breaks) out_.number("break_strain", spring.break_strain);
    if (spring.law) write_law(*spring.law, out_);
    if (const double sheet_weight = sheet_weight_of(scene_.sheet.get(), spring.id); sheet_weight > 0.0) out_.number("share", sheet_weight);
    const auto unknown = scene_.preserved_json.unknown_of_springs.find(spring.id);
    if (unknown != scene_.preserved_json.unknown_of_springs.end()) out_.members(unknown->second);
    out_.end();
  }

  // Writes the rest angles of all faces if they differ from the present angles.
  void write_rest_angles() {
    if (system_.faces.empty()) return;
    System drawn = system_;
    set_rest_angles(drawn, state_.position);
    if (drawn.faces == system_.faces) return;
    write_list("rest_angles", system_.faces.size(),
               [&](std::size_t f) { out_.list(Layout::Line, system_.faces[f].rest_angle, [&](double angle) { out_.number(angle); }); });
  }

  void write_collider(std::size_t c) {
    const Collider& collider = system_.colliders[c];
    out_.begin_object(Layout::Line);
    std::visit(Overloaded{
                   [&](const Plane& plane) {
                     out_.text("type", "plane");
                     out_.vector("point", plane.point);
                     out_.vector("normal", plane.normal);
                   },
                   [&](const Sphere& sphere) {
                     out_.text("type", "sphere");
                     out_.vector("center", sphere.center);
                     out_.number("radius", sphere.radius);
                   },
                   [&](const Box& box) {
                     out_.text("type", "box");
                     out_.vector("min", box.min);
                     out_.vector("max", box.max);
                   },
               },
               collider.shape);
    out_.number("restitution", collider.restitution);
    out_.number("friction", collider.friction);
    if (!collider.solid) out_.boolean("solid", false);
    if (collider.one_way) out_.boolean("one_way", true);
    write_path(collider.path);
    write_unknown_inside("colliders[" + std::to_string(c) + "]");
    out_.end();
  }

  void write_path(const ColliderPath& path) {
    if (!is_positive_zero(path.amplitude)) out_.vector("oscillate", path.amplitude);
    if (path.frequency != ColliderPath().frequency) out_.number("frequency", path.frequency);
    if (!is_positive_zero(path.phase)) out_.number("phase", path.phase);
    if (!is_positive_zero(path.spin)) out_.vector("spin", path.spin);
    if (!is_positive_zero(path.belt)) out_.vector("belt", path.belt);
  }

  void write_force(std::size_t f) {
    const Force& force = system_.forces[f];
    out_.begin_object(Layout::Line);
    out_.text("type", force.term->id);
    if (!force.on) out_.boolean("on", false);
    for (std::size_t i = 0; i < force.term->numbers.size(); ++i) {
      const ForceParameter& number = force.term->numbers[i];
      if (number.choices.empty())
        out_.number(number.name, force.values[i]);
      else if (force.values[i] != number.default_value)
        out_.text(number.name, number.choices[static_cast<std::size_t>(force.values[i])].id);
    }
    write_unknown_inside("forces[" + std::to_string(f) + "]");
    out_.end();
  }

  void write_contact() {
    if (system_.contact == PairContact{} && !has_unknown_inside("contact")) return;
    out_.begin_object("contact", Layout::Line);
    write_parameters("contact");
    write_unknown_inside("contact");
    out_.end();
  }

  void write_hand() {
    const std::optional<ScriptedHand>& hand = system_.scripted_hand;
    if (!hand || system_.index_of(hand->point) == no_index) return;
    out_.begin_object("hand", Layout::Line);
    out_.integer("point", system_.index_of(hand->point));
    out_.begin_object("circle", Layout::Line);
    out_.vector("from", hand->from);
    out_.vector("center", hand->center);
    out_.vector("axis", hand->axis);
    write_unknown_inside("hand.circle");
    out_.end();
    out_.number("speed", hand->speed);
    out_.number("begin", hand->begin);
    out_.number("seconds", hand->seconds);
    write_unknown_inside("hand");
    out_.end();
  }

  void write_simulation() {
    out_.begin_object("simulation", Layout::Line);
    out_.text("integrator", scene_.settings.integrator->id);
    write_parameters("simulation");
    if (scene_.settings.tolerance) out_.number("tolerance", *scene_.settings.tolerance);
    write_unknown_inside("simulation");
    out_.end();
  }

  void write_defaults() {
    if (scene_.defaults == Defaults{} && !has_unknown_inside("defaults")) return;
    out_.begin_object("defaults", Layout::Line);
    write_parameters("defaults");
    if (scene_.defaults.radius > 0.0) out_.number("radius", scene_.defaults.radius);
    out_.text("grab", scene_.defaults.grab == GrabKind::Hold ? "hold" : "pull");
    write_unknown_inside("defaults");
    out_.end();
  }

  void write_view() {
    const ViewSettings& view = scene_.view;
    if (view == ViewSettings{} && !has_unknown_inside("view")) return;
    out_.begin_object("view", Layout::Line);
    if (view.camera) {
      out_.begin_object("camera", Layout::Line);
      out_.vector("eye", view.camera->eye);
      out_.vector("target", view.camera->target);
      if (view.camera->up) out_.vector("up", *view.camera->up);
      if (view.camera->orthographic) out_.boolean("orthographic", true);
      if (view.camera->follows) out_.boolean("follow", true);
      write_unknown_inside("view.camera");
      out_.end();
    }
    if (view.background) out_.text("background", to_text(*view.background));
    for (const auto& [key, is_shown] : {std::pair{"surface", view.surface},
                                        {"springs", view.springs},
                                        {"points", view.points},
                                        {"strain_colors", view.strain_colors},
                                        {"shadows", view.shadows}})
      if (!is_shown) out_.boolean(key, false);
    if (view.coils) out_.boolean("coils", true);
    if (!view.texture.empty()) out_.text("texture", view.texture);
    if (view.texture_size) out_.number("texture_size", *view.texture_size);
    if (!view.plots.empty()) out_.list("plots", Layout::Line, view.plots, [&](const std::string& name) { out_.text(name); });
    write_unknown_inside("view");
    out_.end();
  }

  void write_unknown_inside(const std::string& path) {
    const auto unknown = scene_.preserved_json.unknown_inside.find(path);
    if (unknown != scene_.preserved_json.unknown_inside.end()) out_.members(unknown->second);
  }

  bool has_unknown_inside(const std::string& path) const { return scene_.preserved_json.unknown_inside.contains(path); }

  // A file that cannot be read back would be lost work.
  void check_size() const {
    if (out_.written().size() > max_file_bytes)
      throw FileError(printable(scene_.name) + ": the file would have more than 256 MiB and could not be read back");
  }

  // `count` items, each on its own line; nothing if there are none
  template <class Write>
  void write_list(std::string_view key, std::size_t count, Write write_item) {
    if (count == 0) return;
    out_.begin_list(key, Layout::Lines);
    for (std::size_t i = 0; i < count; ++i) {
      write_item(i);
      check_size();
      if (progress_ && is_progress_step(written_items_++) && !progress_(static_cast<double>(written_items_) / static_cast<double>(items_)))
        throw FileError(printable(scene_.name) + ": writing was canceled");
    }
    out_.end();
  }

  const Scene& scene_;
  const System& system_;
  const State& state_;
  const Progress& progress_;
  std::size_t items_ = 0, written_items_ = 0;  // list elements, for the progress
  JsonWriter out_;
};

}  // namespace

std::string format_scene(const Scene& scene, const Progress& progress) { return SceneWriter(scene, progress).write(); }

void save_scene(const Scene& scene, const std::filesystem::path& file, const Progress& progress) {
  write_atomically(file, format_scene(scene, progress));
}

}  // namespace hooke
