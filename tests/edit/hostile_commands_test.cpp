// Commands with numbers that no scene file may hold, as a recording or a program could send them: none makes a scene that cannot be
// saved and read again.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "edit/command.h"
#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "support/random_scene.h"

namespace hooke {
namespace {

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {}

  double number() {
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double values[] = {nan,    infinity, -infinity, -1.0, 0.0, -0.0, 5e-324, 1e-310,  -1e-310,
                                 1e-300, 0.5,      1.0,       2.0,  1e9, 1e18, 1e300,  1.7e308, -1.7e308};
    return random_.one_in(3) ? random_.uniform(-2.0, 2.0) : random_.one_of(values);
  }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Vec3 direction() {
    if (random_.one_in(2)) return vector();
    return {0.0, random_.one_in(2) ? 1.0 : -1.0, 0.0};
  }
  PointId point(const System& system) {
    if (system.points().empty() || random_.one_in(8)) return PointId{static_cast<std::uint32_t>(random_.below(30))};
    return random_.one_of(system.points()).id;
  }
  SpringId spring(const System& system) {
    if (system.springs().empty() || random_.one_in(8)) return SpringId{static_cast<std::uint32_t>(random_.below(30))};
    return random_.one_of(system.springs()).id;
  }
  Collider collider() {
    Collider made;
    if (random_.one_in(3))
      made.shape = Plane{vector(), direction()};
    else if (random_.one_in(2))
      made.shape = Sphere{vector(), number()};
    else
      made.shape = Box{vector(), vector()};
    if (random_.one_in(2)) made.restitution = number();
    if (random_.one_in(2)) made.friction = number();
    if (random_.one_in(2)) made.path = {vector(), number(), number(), vector(), vector()};
    return made;
  }
  Force force() {
    const ForceTerm& term = random_.one_of(force_terms());
    Force made{.term = random_.one_in(10) ? nullptr : &term, .values = default_values(term)};
    for (double& value : made.values)
      if (random_.one_in(3)) value = number();
    return made;
  }
  template <class T, class Make>
  std::vector<T> some(Make make) {
    std::vector<T> list;
    for (Index count = random_.below(4); count > 0; --count) list.push_back(make());
    return list;
  }

  Command command(const Scene& scene) {
    const System& system = scene.system;
    const auto& row = random_.one_of(parameters());
    switch (random_.below(17)) {
      case 0:
        return Insert{
            some<PlacedPoint>([&] {
              return PlacedPoint{
                  no_index, {.id = point(system), .mass = number(), .radius = number(), .load = vector()}, vector(), vector(), number()};
            }),
            some<PlacedSpring>([&] {
              return PlacedSpring{no_index,
                                  {.id = spring(system),
                                   .first = point(system),
                                   .second = point(system),
                                   .stiffness = number(),
                                   .damping = number(),
                                   .rest_length = number(),
                                   .break_strain = number()},
                                  number()};
            }),
            some<PlacedFace>([&] {
              return PlacedFace{no_index, {{point(system), point(system), point(system)}}};
            })};
      case 1:
        return Remove{some<PointId>([&] { return point(system); }), some<SpringId>([&] { return spring(system); })};
      case 2:
        if (random_.one_in(3)) return SetLoad{{{point(system), vector()}}};
        if (random_.one_in(3)) return SetFixedAxes{{{point(system), static_cast<std::uint8_t>(random_.below(20))}}};
        return SetNailed{{{point(system), random_.one_in(2), vector()}}};
      case 3:
        return Move{{{point(system), vector(), vector()}}};
      case 4:
        return SetPointProperty{random_.one_in(2) ? PointProperty::Mass : PointProperty::Radius, {{point(system), number()}}};
      case 5:
        return SetSpringProperty{static_cast<SpringProperty>(random_.below(4)), {{spring(system), number()}}};
      case 6:
        if (random_.one_in(2))
          return SetSpringLaw{{{spring(system), SpringLaw{.force = static_cast<SpringForce>(random_.below(5)),
                                                          .k3 = number(),
                                                          .amplitude = number(),
                                                          .frequency = number(),
                                                          .rate = number(),
                                                          .min_rest_length = number()}}}};
        return SetParameter{&row, number()};
      case 7:
        return RestoreParameter{&row, number()};
      case 8:
        return GrabPoint{{.point = point(system),
                          .kind = random_.one_in(2) ? GrabKind::Hold : GrabKind::Pull,
                          .target = vector(),
                          .stiffness = number()}};
      case 9:
        return GrabCollider{{random_.below(4), vector()}};
      case 10:
        return MoveHand{vector()};
      case 11:
        return ReleaseHand{};
      case 12:
        return SetGravity{vector()};
      case 13:
        return SetColliders{some<Collider>([&] { return collider(); })};
      case 14:
        return SetForces{some<Force>([&] { return force(); })};
      case 15: {
        State state = scene.state;
        state.time = number();
        state.torn = static_cast<std::uint32_t>(random_.below(3));
        state.hand.position = vector();
        if (!state.position.empty()) state.position[0] = vector();
        return GoToState{std::make_shared<const State>(state)};
      }
      default:
        if (random_.one_in(2)) return SetTexture{random_.one_in(2) ? "linen" : "../x.png", number(), {}};
        return MarkTorn{static_cast<std::uint32_t>(random_.below(3))};
    }
  }

 private:
  Random random_;
};

// The finite numbers of a scene file, whatever was done.
TEST(HostileCommands, NeverMakeASceneThatCannotBeReadAgain) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const TestSim sim = random_sim(seed, 6, 8, seed % 3 == 0 ? 2 : 3, 1.0);
    Scene scene;
    scene.system = sim.system;
    scene.state = sim.state;
    Hostile hostile(seed);
    for (int i = 0; i < 60; ++i) {
      const Command command = hostile.command(scene);
      Effect effect;
      const std::vector<Command> inverse = apply(scene, command, effect);
      const std::string text = format_scene(scene);
      ASSERT_NO_THROW(parse_scene(text, "scene")) << "seed " << seed << ", command " << i << ": " << describe(command);
      ASSERT_LE(scene.state.torn, scene.tears.size());
      if (i % 3 != 0) continue;
      for (const Command& undo : inverse) apply(scene, undo, effect);
      ASSERT_NO_THROW(parse_scene(format_scene(scene), "scene"))
          << "seed " << seed << ", undo of command " << i << ": " << describe(command);
    }
  }
}

TEST(HostileCommands, ChangeNothingWhereTheyAreRefused) {
  const TestSim sim = random_sim(1, 6, 8);
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  scene.system.colliders = {{.shape = Sphere{{0.0, -2.0, 0.0}, 0.5}}};
  const System before = scene.system;
  const auto expect_refused = [&](const Command& command) {
    Effect effect;
    EXPECT_TRUE(apply(scene, command, effect).empty()) << describe(command);
    EXPECT_EQ(scene.system, before) << describe(command);
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(SetColliders{{{.shape = Sphere{{0.0, 0.0, 0.0}, -1.0}}}});
  expect_refused(SetColliders{{{.shape = Sphere{{0.0, 0.0, 0.0}, nan}}}});
  expect_refused(SetColliders{{{.shape = Plane{{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}}}});
  expect_refused(SetColliders{{{.shape = Box{{0.0, 0.0, 0.0}, {1.0, -1.0, 1.0}}}}});
  expect_refused(SetColliders{{{.shape = Sphere{{0.0, 0.0, 0.0}, 1.0}, .restitution = 1.5}}});
  expect_refused(SetColliders{{{.shape = Sphere{{0.0, 0.0, 0.0}, 1.0}, .friction = -0.1}}});
  expect_refused(RestoreParameter{&stiffness_parameter, -1.0});
  expect_refused(RestoreParameter{&drag_parameter, nan});
  expect_refused(SetGravity{{nan, 0.0, 0.0}});
}

}  // namespace
}  // namespace hooke
