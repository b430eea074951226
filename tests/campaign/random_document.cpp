#include "campaign/random_document.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/texture.h"
#include "scene/parameters.h"
#include "sim/control/automatic.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

class DocumentBuilder {
 public:
  DocumentBuilder(Random& random, Numbers numbers) : random_(random), numbers_(numbers) {}
  Scene build();

 private:
  bool flip() { return random_.one_in(2); }
  double number(const Bounds& bounds = any_number) { return random_number(random_, numbers_, bounds); }
  Vec3 vector();
  Vec3 in_plane() { return flat_ ? Vec3(vector().x, vector().y, 0.0) : vector(); }
  Vec3 direction();
  Color color();
  std::string unknown();
  void add_network(Scene& scene);
  void add_cloth(Scene& scene);
  void add_collider(Scene& scene);
  ColliderPath path(const Collider& collider);
  void add_forces(Scene& scene);
  void add_hand(Scene& scene);
  void add_parameters(Scene& scene);
  void add_view(Scene& scene);
  void add_unknown(Scene& scene);

  Random& random_;
  Numbers numbers_;
  bool flat_ = false;
};

Vec3 DocumentBuilder::vector() {
  const double x = number(), y = number(), z = number();
  return {x, y, z};
}

Vec3 DocumentBuilder::direction() {
  const double x = random_.uniform(-1.0, 1.0), y = random_.uniform(-1.0, 1.0), z = random_.uniform(-1.0, 1.0);
  return glm::normalize(Vec3(x, y, std::copysign(std::max(std::abs(z), 0.1), z)));
}

Color DocumentBuilder::color() {
  const std::uint64_t bits = random_.next_bits();
  return {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8), static_cast<std::uint8_t>(bits >> 16)};
}

// Members that no version of the format has, formatted as the program formats them.
std::string DocumentBuilder::unknown() {
  static constexpr std::string_view values[] = {"null", "true", "-12", "0.125", "\"text\"", "[1, [2, 3], \"a\"]", "{\"b\": {}, \"c\": []}"};
  std::string members;
  for (Index i = random_.below(2); i >= 0; --i)
    members += (members.empty() ? "\"x" : ", \"x") + std::to_string(i) + "\": " + std::string(random_.one_of(values));
  return members;
}

void DocumentBuilder::add_network(Scene& scene) {
  System& system = scene.system;
  const Index points = random_.below(9), springs = points > 1 ? random_.below(12) : 0;
  for (Index i = 0; i < points; ++i) {
    system.append_point({.id = system.new_point_id(),
                         .nailed = random_.one_in(4),
                         .color = flip() ? std::optional(color()) : std::nullopt,
                         .mass = number(positive),
                         .radius = number(not_negative)});
    scene.state.position.push_back(in_plane());
    scene.state.velocity.push_back(flip() ? in_plane() : Vec3(0.0));
  }
  for (Index s = 0; s < springs; ++s) {
    const Index first = random_.below(points), other = random_.below(points - 1);
    system.append_spring({.id = system.new_spring_id(),
                          .first = system.points()[first].id,
                          .second = system.points()[other < first ? other : other + 1].id,
                          .family = static_cast<SpringFamily>(random_.below(static_cast<Index>(spring_families))),
                          .stiffness = number(not_negative),
                          .damping = flip() ? number(not_negative) : 0.0,
                          .rest_length = number(not_negative),
                          .break_strain = random_.one_in(4) ? number(positive) : never_breaks});
  }
  for (Index f = points < 3 ? 0 : random_.below(4); f > 0; --f) {
    const Index first = random_.below(points - 2), second = first + 1 + random_.below(points - first - 2);
    const Index third = second + 1 + random_.below(points - second - 1);
    system.faces.push_back({{system.points()[second].id, system.points()[third].id, system.points()[first].id}});
  }
}

// Texture coordinates of some points, and sheet weights of some springs.
void DocumentBuilder::add_cloth(Scene& scene) {
  if (random_.one_in(3)) {
    ClothCoordinates places;
    for (Index i = 0; i < scene.system.point_count(); ++i) {
      const double right = number(), down = number();
      places.push_back(flip() ? glm::dvec2(right, down) : no_cloth_coordinates);
    }
    scene.cloth_texture.cloth_coordinates = std::make_shared<const ClothCoordinates>(std::move(places));
  }
  if (random_.one_in(3)) {
    SheetWeights sheet;
    for (Index i = 0; i < scene.system.point_count(); ++i) sheet.area.push_back(flip() ? number(positive) : 0.0);
    for (Index s = 0; s < scene.system.spring_count(); ++s) sheet.spring_weight.push_back(flip() ? number(positive) : 0.0);
    scene.sheet = std::make_shared<const SheetWeights>(std::move(sheet));
  }
}

void DocumentBuilder::add_collider(Scene& scene) {
  Collider collider;
  switch (random_.below(3)) {
    case 0:
      collider.shape = Plane{vector(), direction()};
      break;
    case 1:
      collider.shape = Sphere{vector(), number(positive)};
      break;
    default: {
      const Vec3 a = vector(), b = vector();
      Box box{glm::min(a, b), glm::max(a, b)};
      for (int c = 0; c < 3; ++c)
        if (!(box.min[c] < box.max[c])) box.min[c] = -(box.max[c] = std::max(std::abs(box.max[c]), 1.0));
      collider.shape = box;
    }
  }
  collider.restitution = flip() ? random_.uniform(0.0, 1.0) : static_cast<double>(random_.below(2));
  collider.friction = number(not_negative);
  collider.solid = !random_.one_in(4);
  if (flip()) collider.path = path(collider);
  scene.system.colliders.push_back(collider);
}

ColliderPath DocumentBuilder::path(const Collider& collider) {
  ColliderPath path;
  if (flip()) path.amplitude = vector();
  if (flip()) path.frequency = number(not_negative);
  if (flip()) path.phase = number();
  if (flip()) path.belt = vector();
  if (const auto* plane = std::get_if<Plane>(&collider.shape); plane != nullptr && flip())
    path.spin = random_.uniform(-10.0, 10.0) * plane->normal;
  if (std::holds_alternative<Sphere>(collider.shape) && flip()) path.spin = vector();
  return path;
}

void DocumentBuilder::add_forces(Scene& scene) {
  for (Index f = random_.below(3); f > 0; --f) {
    const ForceTerm& term = random_.one_of(force_terms());
    Force force{&term, flip(), {}};
    for (std::size_t i = 0; i < term.numbers.size(); ++i) {
      const Bounds ordinary{.min = term.numbers[i].min, .max = term.numbers[i].max};
      const Bounds allowed = term.numbers[i].valid();
      const std::size_t choices = term.numbers[i].choices.size();
      force.values[i] = choices > 0 ? static_cast<double>(random_.below(static_cast<Index>(choices)))
                                    : number(numbers_ == Numbers::Any ? allowed : ordinary);
    }
    scene.system.forces.push_back(force);
  }
}

void DocumentBuilder::add_hand(Scene& scene) {
  if (scene.system.point_count() == 0 || !random_.one_in(3)) return;
  ScriptedHand hand;
  hand.point = scene.system.points()[random_.below(scene.system.point_count())].id;
  hand.axis = flat_ ? Vec3(0.0, 0.0, flip() ? 1.0 : -1.0) : direction();
  hand.center = Vec3(random_.uniform(-2.0, 2.0), random_.uniform(-2.0, 2.0), 0.0);
  const Vec3 aside = std::abs(hand.axis.x) < 0.5 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0);
  hand.from = hand.center + random_.uniform(0.01, 2.0) * aside;
  hand.speed = random_.uniform(0.0, numbers_ == Numbers::Any ? 1e6 : 10.0);
  hand.begin = number();
  hand.seconds = number(positive);
  scene.system.scripted_hand = hand;
}

// Every row of the table that has a field of its own.
void DocumentBuilder::add_parameters(Scene& scene) {
  for (const Parameter& row : parameters()) {
    if (row.field.empty() || flip()) continue;
    const Bounds range{.min = row.min, .max = row.max};
    double value = number(numbers_ == Numbers::Any ? row.physical : range);
    if (row.kind == Parameter::Kind::Switch) value = flip() ? 1.0 : 0.0;
    if (row.kind == Parameter::Kind::Choice) value = static_cast<double>(random_.below(static_cast<Index>(row.choices.size())));
    if (row.kind == Parameter::Kind::Integer)
      value = static_cast<double>(1 + random_.below(numbers_ == Numbers::Any ? static_cast<Index>(row.physical.max) : 8));
    row.write(scene, value);
  }
}

void DocumentBuilder::add_view(Scene& scene) {
  ViewSettings& view = scene.view;
  if (flip()) {
    CameraPose pose{.eye = vector(), .target = vector(), .orthographic = flip(), .follows = flip()};
    if (flip()) pose.up = vector();
    if (pose.eye != pose.target && (!pose.up || *pose.up != Vec3(0.0))) view.camera = pose;
  }
  if (flip()) view.background = color();
  for (bool* flag : {&view.surface, &view.springs, &view.points, &view.strain_colors, &view.shadows}) *flag = !random_.one_in(4);
  if (random_.one_in(3)) {
    view.texture = flip() ? std::string(random_.one_of(shipped_textures()).id) : "folder/picture.png";
    if (flip()) view.texture_size = number(positive);
  }
}

void DocumentBuilder::add_unknown(Scene& scene) {
  PreservedJson& kept = scene.preserved_json;
  if (random_.one_in(3)) kept.unknown = unknown();
  for (const char* section : {"simulation", "defaults", "controls", "view"})
    if (random_.one_in(4)) kept.unknown_inside[section] = unknown();
  if (scene.view.camera && random_.one_in(4)) kept.unknown_inside["view.camera"] = unknown();
  if (scene.system.scripted_hand && random_.one_in(2)) kept.unknown_inside["hand"] = unknown();
  if (scene.system.scripted_hand && random_.one_in(2)) kept.unknown_inside["hand.circle"] = unknown();
  for (std::size_t c = 0; c < scene.system.colliders.size(); ++c)
    if (random_.one_in(4)) kept.unknown_inside["colliders[" + std::to_string(c) + "]"] = unknown();
  for (std::size_t f = 0; f < scene.system.forces.size(); ++f)
    if (random_.one_in(4)) kept.unknown_inside["forces[" + std::to_string(f) + "]"] = unknown();
  for (const Point& point : scene.system.points())
    if (random_.one_in(6)) kept.unknown_of_points[point.id] = unknown();
  for (const Spring& spring : scene.system.springs())
    if (random_.one_in(6)) kept.unknown_of_springs[spring.id] = unknown();
  if (random_.one_in(8)) kept.check = R"({"seconds": 0.5})";
}

Scene DocumentBuilder::build() {
  Scene scene;
  flat_ = flip();
  scene.system.dimensions = flat_ ? 2 : 3;
  scene.name = random_text(random_, 20);
  if (flip()) scene.description = random_text(random_, 200);
  if (flip()) scene.state.time = number();
  scene.system.gravity = in_plane();
  if (flip()) scene.system.wind = in_plane();
  add_network(scene);
  add_cloth(scene);
  for (Index c = random_.below(3); c > 0; --c) add_collider(scene);
  add_forces(scene);
  add_hand(scene);
  scene.settings.integrator = random_.one_in(8) ? &automatic_method() : &random_.one_of(integrators());
  if (random_.one_in(4)) scene.settings.tolerance = numbers_ == Numbers::Any ? number(positive) : 1e-4;
  if (flip()) {
    add_parameters(scene);
    scene.defaults.radius = number(not_negative);
    scene.defaults.grab = flip() ? GrabKind::Hold : GrabKind::Pull;
  }
  if (random_.one_in(4)) {
    const double a = number(not_negative), b = number(positive);
    if (a != b) scene.controls = {.stiffness_min = std::min(a, b), .stiffness_max = std::max(a, b), .stiffness_step = number(positive)};
  }
  add_view(scene);
  add_unknown(scene);
  set_print_layout(scene);
  return scene;
}

}  // namespace

Scene random_document(Random& random, Numbers numbers) { return DocumentBuilder(random, numbers).build(); }

double random_number(Random& random, Numbers numbers, const Bounds& bounds) {
  constexpr double extremes[] = {0.0,  -0.0,         1.0, 0.1, -1.0 / 3.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308,
                                 1e22, 123456789.125};
  for (int attempt = 0; attempt < 100; ++attempt) {
    double value = random.uniform(-3.0, 3.0);
    if (numbers == Numbers::Any) {
      const Index kind = random.below(4);
      if (kind == 0) value = random.one_of(extremes);
      if (kind == 1) value = std::bit_cast<double>(random.next_bits());
      if (kind == 2) value = std::round(1000.0 * value) / 1000.0;
    } else if (std::isfinite(bounds.min) && std::isfinite(bounds.max)) {
      value = random.uniform(bounds.min, bounds.max);
    }
    if (bounds.min >= 0.0) value = std::abs(value);
    if (std::isfinite(value) && bounds.contains(value)) return value;
  }
  return bounds.contains(1.0) ? 1.0 : bounds.min;
}

std::string random_text(Random& random, Index max_length) {
  static constexpr std::string_view letters[] = {"a",  "Z",    "0",    " ",      "\"",     "\\",         "/", "\n",
                                                 "\t", "\x01", "\x7f", "\u00e9", "\u20ac", "\U0001f600", "%s"};
  std::string text;
  for (Index i = random.below(max_length + 1); i > 0; --i) text += random.one_of(letters);
  return text;
}

std::string random_generators(Random& random) {
  const auto number = [&](double min, double max) { return format_exact(random.uniform(min, max)); };
  const auto flat_vector = [&](double x, double y) { return "[" + format_exact(x) + ", " + format_exact(y) + ", 0]"; };
  std::string list;
  for (Index g = 1 + random.below(2); g > 0; --g) {
    list += list.empty() ? "[" : ", ";
    const std::string fabric = ", \"stiffness\": " + number(0.0, 1000.0) + ", \"damping\": " + number(0.0, 2.0) +
                               (random.one_in(2) ? ", \"mass_model\": \"equal\"" : "") +
                               (random.one_in(2) ? ", \"point_radius\": " + number(0.0, 0.1) : "");
    if (random.one_in(2))
      list += "{\"type\": \"rope\", \"from\": " + flat_vector(random.uniform(-1.0, 0.0), 1.0) +
              ", \"to\": " + flat_vector(random.uniform(0.5, 2.0), random.uniform(-1.0, 1.0)) +
              ", \"points\": " + std::to_string(2 + random.below(12)) + ", \"mass\": " + number(0.01, 10.0) + fabric +
              (random.one_in(2) ? ", \"nail\": [\"from\"]}" : "}");
    else
      list += "{\"type\": \"cloth\", \"corner\": " + flat_vector(random.uniform(-1.0, 1.0), 1.0) +
              ", \"across\": " + flat_vector(random.uniform(0.1, 2.0), 0.0) + ", \"down\": " + flat_vector(0.0, -random.uniform(0.1, 2.0)) +
              ", \"points\": [" + std::to_string(2 + random.below(5)) + ", " + std::to_string(2 + random.below(5)) +
              "], \"density\": " + number(0.01, 10.0) + fabric + (random.one_in(2) ? ", \"nail\": [\"top_left\", 1]}" : "}");
  }
  return list + "]";
}

}  // namespace hooke
