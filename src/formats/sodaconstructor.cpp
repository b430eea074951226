// Models of Sodaconstructor 2 (.xml): docs/reference/file-formats.md has what becomes of them.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>

#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "formats/file_kinds.h"
#include "formats/stable_stepping.h"
#include "sim/model/portable_math.h"

namespace hooke {
namespace {

// "Muscle" of <object type="com.sodaplay.soda.constructor2.model.Muscle">.
std::string_view kind_of(const pugi::xml_node& object) {
  const std::string_view type = object.attribute("type").value();
  return type.substr(type.rfind('.') + 1);
}

// The value of <field name="x"><double>1.5</double></field>.
pugi::xml_node field(const pugi::xml_node& object, const char* name) {
  return object.find_child_by_attribute("field", "name", name).first_child();
}

class SodaReader {
 public:
  SodaReader(std::string_view text, const std::string& file) : file_(file) {
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      const auto lines = std::count(text.begin(), text.begin() + result.offset, '\n');
      throw InputError(line_location(file, static_cast<int>(lines) + 1) + ": XML: " + result.description());
    }
    model_ = document_.find_node([](const pugi::xml_node& node) { return kind_of(node) == "Model"; });
    if (!model_) throw InputError(file + ": object: must be a model of Sodaconstructor 2");
  }

  LoadedScene read() {
    Scene& scene = loaded_.scene;
    scene.name = std::filesystem::path(file_).stem().string();
    scene.system.dimensions = 2;
    read_masses();
    read_springs();
    const double direction = number(model_, "gravityDirection", any, 1.0);
    const double down = direction == 0.0 ? 0.0 : direction == 1.0 ? -1.0 : 1.0;
    scene.system.gravity.y = down * pixel * rate * rate * number(model_, "gravity");
    scene.system.drag = 0.0 - rate * portable::log(1.0 - std::min(number(model_, "friction", {.min = 0.0, .max = 1.0}), 0.999));  // not -0
    scene.system.colliders.push_back({.shape = Plane{Vec3(0.0), Vec3(0.0, 1.0, 0.0)},
                                      .restitution = std::clamp(-number(model_, "surfaceReflection", any, -0.75), 0.0, 1.0),
                                      .friction = 1.0});
    if (const auto warning = choose_stable_stepping(scene, Settings().substeps)) loaded_.warnings.push_back(file_ + ": " + *warning);
    return std::move(loaded_);
  }

 private:
  static constexpr double pixel = 0.01, rate = 50.0;  // [m], and steps per second
  static constexpr Bounds any{.min = -1e9, .max = 1e9}, positive_or_zero{.min = 0.0, .max = 1e9};

  [[noreturn]] void refuse(const pugi::xml_node& object, const std::string& name, const std::string& reason) const {
    throw InputError(file_ + ": " + printable(object.attribute("id").value(), 40) + "." + name + ": " + reason);
  }

  double number(const pugi::xml_node& object, const char* name, const Bounds& bounds = any, double otherwise = 0.0) const {
    const pugi::xml_node value = field(object, name);
    if (!value) return otherwise;
    const std::string_view text = value.child_value();
    const auto number = parse_number(text);
    if (!number || !bounds.contains(*number))
      refuse(object, name, "\"" + printable(text, 40) + "\": " + (number ? bounds.text() : any_number.text()));
    return *number;
  }

  void read_masses() {
    System& system = loaded_.scene.system;
    std::vector<Point> points;
    for (const pugi::xml_node& mass : field(model_, "nodes").children("object")) {
      if (points.size() == max_points) refuse(model_, "nodes", "must be at most " + std::to_string(max_points));
      points.push_back({.id = system.new_point_id(), .nailed = kind_of(mass) == "Node", .mass = 1.0, .radius = 0.02});
      point_of_[mass.attribute("id").value()] = points.back().id;
      loaded_.scene.state.position.push_back(pixel * Vec3(number(mass, "x"), number(mass, "y"), 0.0));
      loaded_.scene.state.velocity.push_back(pixel * rate * Vec3(number(mass, "vx"), number(mass, "vy"), 0.0));
    }
    system.set_points(std::move(points));
  }

  void read_springs() {
    System& system = loaded_.scene.system;
    const double stiffness = rate * rate * number(model_, "springyness", positive_or_zero);
    std::vector<Spring> springs;
    for (const pugi::xml_node& link : field(model_, "springs").children("object")) {
      springs.push_back({.id = system.new_spring_id(),
                         .first = end_of(link, "a"),
                         .second = end_of(link, "b"),
                         .stiffness = stiffness,
                         .rest_length = pixel * number(link, "restLength", positive_or_zero)});
      if (springs.back().first == springs.back().second) refuse(link, "b", "must be another mass than a");
      if (kind_of(link) == "Muscle") springs.back().law = muscle(link);
    }
    system.set_springs(springs);
  }

  PointId end_of(const pugi::xml_node& link, const char* end) const {
    const auto found = point_of_.find(field(link, end).attribute("refid").value());
    if (found == point_of_.end()) refuse(link, end, "must be a mass of the model");
    return found->second;
  }

  std::optional<SpringLaw> muscle(const pugi::xml_node& link) const {
    const pugi::xml_node wave = field(model_, "wave");
    const double amplitude = number(wave, "amplitude") * number(link, "amplitude");
    if (amplitude == 0.0) return std::nullopt;
    const double phase = 2.0 * std::numbers::pi * (number(link, "phase") - number(wave, "phase"));
    const bool is_reverse = field(wave, "direction").child_value() == std::string_view("reverse");
    return SpringLaw{.amplitude = std::clamp(amplitude, -1.0, 1.0),
                     .frequency = rate * std::abs(number(wave, "speed")),
                     .phase = is_reverse ? phase : std::numbers::pi - phase};
  }

  const std::string& file_;
  pugi::xml_document document_;
  pugi::xml_node model_;
  std::map<std::string, PointId, std::less<>> point_of_;
  LoadedScene loaded_;
};

}  // namespace

constinit const FileKind sodaconstructor_file{
    .extension = ".xml",
    .title = "Sodaconstructor model",
    .parse = [](std::string_view text, const std::string& file, const ImportOptions&) { return SodaReader(text, file).read(); }};

}  // namespace hooke
