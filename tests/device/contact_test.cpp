// Colliders on the device: the contact of the processor, point by point.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "sim/methods/rows.h"
#include "support/counted_device.h"
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
    "generators": [{"type": "cloth", "corner": [0.02, 0.35, 0.03], "across": [0.6, 0, 0], "down": [0, 0, 0.6], "points": [7, 7], "mass": 0.5,
      "stiffness": 60}], "simulation": {"substeps": 40}, "colliders": )";

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

TEST(GpuContact, AgreesWithTheProcessorOverAThousandSteps) {
  for (const Case& each : cases)
    for (const Integrator* method : {&symplectic_euler, &velocity_verlet, &velocity_verlet_explicit}) {
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

}  // namespace
}  // namespace hooke
