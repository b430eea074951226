// Colliders on the device: the contact of the processor, point by point.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "sim/methods/rows.h"
#include "support/counted_device.h"
#include "support/parts.h"
#include "support/random_scene.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

struct Case {
  const char* name;
  const char* colliders;
};

// Free points that fly, bounce, slide and rest, and a loose sheet: after 1000 steps where the processor has them.
constexpr const char* things =
    R"({"hooke": 1, "points": [{"position": [0.1, 0.4, 0.1], "velocity": [1, -2, 0.3]}, {"position": [0.5, 0.02, 0.3], "velocity": [0.5, 0, 0.2]},
      {"position": [0.3, 0.3, 0.4], "velocity": [0.4, 0, 0.1], "mass": 2, "radius": 0.05}, {"position": [0.9, 0.02, 0.1]}],
    "generators": [{"type": "cloth", "corner": [0.02, 0.35, 0.03], "across": [0.6, 0, 0], "down": [0, 0, 0.6], "points": [5, 5], "mass": 0.5,
      "stiffness": 60, "damping": 0.03}], "simulation": {"substeps": 40}, "colliders": )";

constexpr Case cases[] = {
    {"plane", R"([{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0]}])"},
    {"plane with friction", R"([{"type": "plane", "point": [0, 0, 0], "normal": [0.2, 1, 0.1], "friction": 0.3}])"},
    {"plane that bounces", R"([{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "restitution": 0.7, "friction": 0.2}])"},
    {"sphere", R"([{"type": "sphere", "center": [0.3, 0, 0.3], "radius": 0.25}])"},
    {"sphere with friction", R"([{"type": "sphere", "center": [0.3, 0, 0.3], "radius": 0.25, "friction": 0.5}])"},
    {"sphere that bounces", R"([{"type": "sphere", "center": [0.3, 0, 0.3], "radius": 0.25, "restitution": 0.5}])"},
    {"box", R"([{"type": "box", "min": [0.1, -1, 0.1], "max": [0.5, 0.1, 0.5], "friction": 0.4, "restitution": 0.3}])"},
    {"box whose edge a point with a radius goes round",
     R"([{"type": "box", "min": [-1, -1, -1], "max": [0.35, 0.25, 0.6], "friction": 0.1}])"},
    {"corner of two planes and a ball",
     R"([{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "friction": 0.2}, {"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 0],
       "restitution": 0.5}, {"type": "sphere", "center": [0.4, 0, 0.3], "radius": 0.2, "friction": 0.3}])"},
    {"plane that oscillates",
     R"([{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "oscillate": [0, 0.05, 0.02], "frequency": 3, "friction": 0.3, "restitution": 0.4}])"},
    {"ball that oscillates",
     R"([{"type": "sphere", "center": [0.3, 0, 0.3], "radius": 0.25, "oscillate": [0.1, 0, 0], "frequency": 2, "friction": 0.5}])"},
    {"ball that spins on a belt",
     R"([{"type": "sphere", "center": [0.3, 0, 0.3], "radius": 0.25, "spin": [0, 3, 1], "friction": 0.5},
        {"type": "plane", "point": [0, -0.1, 0], "normal": [0, 1, 0], "belt": [0.5, 0, 0], "friction": 0.5}])"},
};

State run_on(const Scene& scene, bool on_device, int frames) {
  Lab lab(scene, KeepStart::No);
  const auto shared = std::make_shared<CountedDevice>();
  if (on_device) lab.set_execution({.device = shared});
  run(lab, frames);
  EXPECT_EQ(shared->frames, on_device ? frames : 0);
  return lab.scene().state;
}

const std::array methods{&symplectic_euler, &velocity_verlet, &velocity_verlet_explicit};

class GpuColliders : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, GpuColliders, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, GpuColliders, testing::Range(1, GpuColliders::parts));

TEST_P(GpuColliders, AgreeWithTheProcessorOverAThousandSteps) {
  for (std::size_t number = 0; number < std::size(cases); ++number) {
    const Case& each = cases[number];
    const Integrator* method = methods[variant_of(number)];
    Scene scene = parse(things + std::string(each.colliders) + "}");
    scene.settings.integrator = method;
    const State expected = run_on(scene, false, 25), computed = run_on(scene, true, 25);
    double free = 0.0, sheet = 0.0;
    for (std::size_t i = 0; i < expected.position.size(); ++i) {
      double& max = i < 4 ? free : sheet;
      max = std::max(max, glm::length(expected.position[i] - computed.position[i]));
    }
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%s, %s: free points %.2g m, sheet %.2g m apart\n", each.name, std::string(method->id).c_str(), free, sheet);
    EXPECT_LT(free, 1e-9) << each.name << ", " << method->id;
    EXPECT_LT(sheet, 1e-9) << each.name << ", " << method->id;
  }
}

// Three numbers, each up to `max`.
std::string random_vector(Random& random, double max) {
  std::string text;
  for (int c = 0; c < 3; ++c) text += (c == 0 ? "[" : ", ") + std::to_string(random.uniform(-max, max));
  return text + "]";
}

std::string random_collider(Random& random) {
  const auto number = [&](double min, double max) { return std::to_string(random.uniform(min, max)); };
  std::string text;
  switch (random.below(3)) {
    case 0:
      text = R"({"type": "plane", "point": [0, )" + number(-0.3, 0.0) + R"(, 0], "normal": [)" + number(-0.8, 0.8) + ", 1, " +
             number(-0.8, 0.8) + "]";
      break;
    case 1:
      text = R"({"type": "sphere", "center": [)" + number(0.0, 1.0) + ", " + number(-0.6, -0.2) + ", " + number(0.0, 1.0) +
             R"(], "radius": )" + number(0.1, 0.4);
      break;
    default:
      text = R"({"type": "box", "min": [)" + number(-0.5, 0.4) + ", -1, " + number(-0.5, 0.4) + R"(], "max": [)" + number(0.5, 1.0) + ", " +
             number(-0.4, 0.0) + ", " + number(0.5, 1.0) + "]";
  }
  if (random.one_in(2)) text += R"(, "restitution": )" + number(0.05, 0.9);
  if (random.one_in(2)) text += R"(, "friction": )" + number(0.05, 1.2);
  if (random.one_in(4)) text += R"(, "oscillate": )" + random_vector(random, 0.06) + R"(, "frequency": )" + number(0.5, 4.0);
  if (random.one_in(5)) text += R"(, "belt": )" + random_vector(random, 0.5);
  return text + "}";
}

// Points that fall between up to three colliders, where a run on the processor from 2e-15 m beside shows what the scene itself makes of
// rounding. HOOKE_SEED tries other scenes, HOOKE_SCENES more of them.
TEST(GpuContact, AgreesWithTheProcessorAmongRandomColliders) {
  const auto given = [](const char* name, long otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtol(text, nullptr, 10) : otherwise;
  };
  const long first = given("HOOKE_SEED", 1100), scenes = given("HOOKE_SCENES", 24);
  for (long seed = first; seed < first + scenes; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    std::string text = R"({"hooke": 1, "simulation": {"substeps": 25}, "points": [)";
    for (int i = 0; i < 8; ++i)
      text += (i == 0 ? "" : ", ") + std::string(R"({"position": [)") + std::to_string(random.uniform(0.0, 1.0)) + ", " +
              std::to_string(random.uniform(0.05, 0.5)) + ", " + std::to_string(random.uniform(0.0, 1.0)) + R"(], "velocity": )" +
              random_vector(random, 1.0) + R"(, "radius": )" + std::to_string(random.one_in(2) ? 0.001 : random.uniform(0.01, 0.12)) + "}";
    text += R"(], "colliders": [)" + random_collider(random);
    for (Index more = random.below(3); more > 0; --more) text += ", " + random_collider(random);
    Scene scene = parse(text + "]}");
    scene.settings.integrator = random.one_of(methods);
    const State expected = run_on(scene, false, 40), computed = run_on(scene, true, 40);
    for (Vec3& x : scene.state.position) x += Vec3(2e-15);
    const State beside = run_on(scene, false, 40);
    double most = 0.0, of_rounding = 0.0;
    for (std::size_t i = 0; i < expected.position.size(); ++i) {
      most = std::max(most, glm::distance(expected.position[i], computed.position[i]));
      of_rounding = std::max(of_rounding, glm::distance(expected.position[i], beside.position[i]));
    }
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("seed %ld: %.2g m, rounding %.2g m\n", seed, most, of_rounding);
    // each of a thousand steps rounds
    EXPECT_LT(most, std::max(1e-9, 1e3 * of_rounding)) << "seed " << seed << ", " << scene.settings.integrator->id << "\n" << text;
  }
}

}  // namespace
}  // namespace hooke
