// Numbers and whole scenes are read back bit for bit.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <sstream>

#include "base/bounds.h"
#include "base/json_field.h"
#include "formats/scene_file.h"
#include "sim/methods/integrator.h"
#include "support/parse_text.h"

namespace hooke {
namespace {

// Numbers that are difficult for writers and readers of decimal digits.
double hard_number(std::mt19937_64& random) {
  constexpr double special[] = {
      0.0, -0.0, 5e-324, 2.2250738585072011e-308, 1.7976931348623157e308, 9007199254740993.0, 1e22, 1e23, 0.1, 123456789012345680.0, 0.3};
  if (random() % 4 == 0) return special[random() % std::size(special)];
  if (random() % 4 == 0) return static_cast<double>(random() % 1000) / 100.0;
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

TEST(SceneFile, DigitsAreReadAsTheNearestNumber) {
  JsonParser parser;
  for (const auto& [text, value] : {std::pair{"1e-400", 0.0},
                                    {"2.4703282292062327e-324", 0.0},
                                    {"2.4703282292062328e-324", 5e-324},
                                    {"9007199254740993", 9007199254740992.0},
                                    {"179769313486231570e291", 1.7976931348623157e308},
                                    {"1.00000000000000011102230246251565404236316680908203126", 1.0000000000000002},
                                    {"0.000000000000000000000000000000000000000000000000000000000000001", 1e-63},
                                    {"-0", -0.0}})
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parser.parse(text).GetDouble()), std::bit_cast<std::uint64_t>(value)) << text;
}

TEST(SceneFile, EveryNumberIsReadBackBitForBit) {
  std::mt19937_64 random(1);
  JsonParser parser;
  for (int i = 0; i < 200'000; ++i) {
    const double value = hard_number(random);
    const std::string text = format_exact(value);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(parser.parse(text).GetDouble()), std::bit_cast<std::uint64_t>(value)) << text;
  }
}

// Random scenes with any numbers a file may contain, with gaps in the ids.
class RandomScene {
 public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {}

  Scene make() {
    Scene scene;
    scene.name = text();
    scene.description = text();
    System& system = scene.system;
    system.dimensions = flat_ ? 2 : 3;
    system.gravity = place();
    system.wind = place();
    system.drag = not_negative();
    system.switches.drag = random_() % 2;
    system.switches.dashpots = random_() % 2;
    for (std::size_t family = 1; family < spring_families; ++family) system.switches.families[family] = random_() % 2;
    scene.state.time = hard_number(random_);
    add_points(scene);
    add_springs(scene);
    for (std::uint64_t f = random_() % 3; f > 0 && system.point_count() >= 3; --f) {
      const Index first = below(system.point_count() - 2);
      system.faces.push_back({{system.points()[first].id, system.points()[first + 2].id, system.points()[first + 1].id}});
    }
    for (std::uint64_t c = random_() % 4; c > 0; --c) system.colliders.push_back(collider());
    if (random_() % 2)
      system.contact = {.points = random_() % 2 == 0,
                        .springs = random_() % 2 == 0,
                        .faces = random_() % 2 == 0,
                        .thickness = not_negative(),
                        .restitution = static_cast<double>(random_() % 101) / 100.0,
                        .friction = not_negative()};
    set_settings(scene);
    return scene;
  }

 private:
  Index below(Index count) { return static_cast<Index>(random_() % static_cast<std::uint64_t>(count)); }
  double not_negative() { return std::abs(hard_number(random_)); }
  double positive() {
    const double value = not_negative();
    return std::isnormal(value) ? value : 1.0;
  }
  Vec3 anywhere() { return {hard_number(random_), hard_number(random_), hard_number(random_)}; }
  Vec3 place() {
    Vec3 place = anywhere();
    if (flat_) place.z = random_() % 2 ? 0.0 : -0.0;
    return place;
  }
  Color color() {
    return {static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_()), static_cast<std::uint8_t>(random_())};
  }
  std::string text() {
    constexpr const char* pieces[] = {"a", "\"", "\\", "\n", "\u00e9", "\u2028", "\U0001f600", "/", "", " ", "\x1b", "\x7f"};
    std::string text;
    for (std::uint64_t i = random_() % 8; i > 0; --i) {
      const std::size_t piece = random_() % std::size(pieces);
      text += piece == 8 ? std::string(1, '\0') : std::string(pieces[piece]);
    }
    return text;
  }

  void add_points(Scene& scene) {
    for (std::uint64_t i = random_() % 6; i > 0; --i) {
      if (random_() % 3 == 0) scene.system.new_point_id();
      Point point{.id = scene.system.new_point_id(), .nailed = random_() % 2 == 0, .mass = positive(), .radius = not_negative()};
      if (random_() % 2) point.color = color();
      if (random_() % 2) point.fixed_axes = static_cast<std::uint8_t>(random_() % 8);
      if (random_() % 2) point.load = place();
      scene.system.append_point(point);
      scene.state.position.push_back(place());
      scene.state.velocity.push_back(random_() % 2 ? place() : Vec3(0.0));
    }
  }
  void add_springs(Scene& scene) {
    const Index count = scene.system.point_count();
    for (std::uint64_t i = random_() % 6; i > 0 && count >= 2; --i) {
      const Index first = below(count), second = (first + 1 + below(count - 1)) % count;
      if (random_() % 3 == 0) scene.system.new_spring_id();
      scene.system.append_spring({.id = scene.system.new_spring_id(),
                                  .first = scene.system.points()[first].id,
                                  .second = scene.system.points()[second].id,
                                  .family = static_cast<SpringFamily>(random_() % spring_families),
                                  .stiffness = not_negative(),
                                  .damping = not_negative(),
                                  .rest_length = not_negative(),
                                  .break_strain = random_() % 2 ? never_breaks : positive()});
    }
  }
  Collider collider() {
    Collider collider{.restitution = static_cast<double>(random_() % 101) / 100.0, .friction = not_negative(), .solid = random_() % 2 == 0};
    const auto small = [&] { return static_cast<double>(random_()) / 1e19 - 0.9; };
    switch (random_() % 3) {
      case 0:
        collider.shape = Plane{anywhere(), glm::normalize(Vec3(small(), small(), small()))};
        break;
      case 1:
        collider.shape = Sphere{anywhere(), positive()};
        break;
      default:
        collider.shape = Box{{-not_negative() - 1.0, -1.0, -0.1}, {0.0, -0.0, 5e-324}};
    }
    return collider;
  }
  void set_settings(Scene& scene) {
    const auto methods = integrators();
    scene.settings = {.integrator = &methods[random_() % methods.size()],
                      .frame_rate = positive(),
                      .substeps = 1 + below(1'000'000),
                      .speed = positive()};
    if (random_() % 2) scene.settings.tolerance = positive();
    if (random_() % 2) {
      scene.view.camera =
          CameraPose{.eye = anywhere(), .target = anywhere(), .orthographic = random_() % 2 == 0, .follows = random_() % 2 == 0};
      if (scene.view.camera->eye == scene.view.camera->target)
        scene.view.camera.reset();
      else if (random_() % 2)
        scene.view.camera->up = Vec3(0.0, positive(), -0.0);
    }
    if (random_() % 2) scene.view.background = color();
    if (random_() % 2)
      scene.defaults = {positive(),     not_negative(), not_negative(),
                        not_negative(), not_negative(), random_() % 2 ? GrabKind::Hold : GrabKind::Pull};
    if (random_() % 2) scene.controls = {0.25, 0.25 + 1e-3 + static_cast<double>(random_() % 100), positive()};
  }

  std::mt19937_64 random_;
  bool flat_ = random_() % 2 == 0;
};

// Equal to the last bit, unlike ==, which takes -0.0 for 0.0. Ids matter only by the items they refer to.
std::string bits_of(const Scene& scene) {
  std::ostringstream text;
  const auto add = [&](auto... values) { ((text << std::hex << std::bit_cast<std::uint64_t>(static_cast<double>(values)) << ' '), ...); };
  const auto add_vector = [&](const Vec3& v) { add(v.x, v.y, v.z); };
  const auto add_color = [&](const std::optional<Color>& c) { text << (c ? c->red * 65536 + c->green * 256 + c->blue : -1) << ' '; };
  const System& system = scene.system;
  text << scene.name.size() << scene.name << scene.description.size() << scene.description << system.dimensions << system.switches.drag
       << system.switches.dashpots << system.switches.families[1] << system.switches.families[2] << system.switches.families[3] << ' ';
  add(scene.state.time, system.drag);
  add_vector(system.gravity + Vec3(0.0));  // saved without the sign of a zero
  add_vector(system.wind);
  for (Index i = 0; i < system.point_count(); ++i) {
    add(system.points()[i].nailed, system.points()[i].mass, system.points()[i].radius);
    add_color(system.points()[i].color);
    add_vector(scene.state.position[i]);
    add_vector(scene.state.velocity[i]);
  }
  for (const Spring& spring : system.springs())
    add(system.index_of(spring.first), system.index_of(spring.second), spring.family, spring.stiffness, spring.damping, spring.rest_length,
        spring.break_strain);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) add(system.index_of(id));
  add(system.contact.points, system.contact.springs, system.contact.faces, system.contact.thickness, system.contact.restitution,
      system.contact.friction);
  for (const Collider& collider : system.colliders) {
    add(collider.shape.index(), collider.restitution, collider.friction, collider.solid);
    if (const auto* plane = std::get_if<Plane>(&collider.shape)) add_vector(plane->point), add_vector(plane->normal);
    if (const auto* sphere = std::get_if<Sphere>(&collider.shape)) add_vector(sphere->center), add(sphere->radius);
    if (const auto* box = std::get_if<Box>(&collider.shape)) add_vector(box->min), add_vector(box->max);
  }
  text << scene.settings.integrator->id << ' ';
  add(scene.settings.frame_rate, scene.settings.substeps, scene.settings.speed, scene.settings.tolerance.value_or(-1.0));
  if (scene.view.camera) {
    add_vector(scene.view.camera->eye);
    add_vector(scene.view.camera->target);
    add_vector(scene.view.camera->up.value_or(Vec3(-7.0)));
    add(scene.view.camera->orthographic);
    add(scene.view.camera->follows);
  }
  add_color(scene.view.background);
  const Defaults& d = scene.defaults;
  add(d.mass, d.radius, d.stiffness, d.damping, d.pull_stiffness, d.grab == GrabKind::Hold);
  add(scene.controls.stiffness_min, scene.controls.stiffness_max, scene.controls.stiffness_step);
  return text.str();
}

TEST(SceneFile, RandomScenesAreReadBackBitForBit) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Scene scene = RandomScene(seed).make();
    const std::string text = format_scene(scene);
    ASSERT_EQ(bits_of(parse(text)), bits_of(scene)) << "seed " << seed << "\n" << text;
    ASSERT_EQ(format_scene(parse(text)), text) << "seed " << seed;
  }
}

}  // namespace
}  // namespace hooke
