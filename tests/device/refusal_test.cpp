// What the device does not compute is refused by name.
#include <gtest/gtest.h>

#include "device/gpu_device.h"
#include "sim/methods/rows.h"
#include "support/parse_text.h"

namespace hooke {
namespace {

std::string reason(const std::string& fields, const Integrator& method = velocity_verlet, const std::string& spring = "") {
  const Scene scene =
      parse(R"({"hooke": 1, "points": [{"position": [0, 0, 0], "nailed": true}, {"position": [1, 0, 0]}, {"position": [1, 1, 0]}],
    "springs": [{"points": [0, 1], "stiffness": 100)" +
            spring + R"(}], "faces": [[0, 1, 2]])" + fields + "}");
  return needs_processor(make_plan(scene.system), method);
}

TEST(DeviceRefusal, NamesTheFeature) {
  EXPECT_EQ(reason(""), "");
  EXPECT_EQ(reason(R"(, "forces": [{"type": "wind"}], "colliders": [{"type": "sphere", "center": [0, -2, 0], "radius": 1}])"), "");
  EXPECT_EQ(reason(R"(, "contact": {"points": true})"), "contact of points with each other");
  EXPECT_EQ(reason(R"(, "contact": {"faces": true, "thickness": 0.01})"), "contact of faces and springs");
  EXPECT_EQ(reason(R"(, "contact": {"springs": true, "thickness": 0.01})"), "contact of faces and springs");
  EXPECT_EQ(reason(R"(, "colliders": [{"type": "plane", "point": [0, -1, 0], "normal": [0, 1, 0], "one_way": true}])"),
            "planes that act one way");
  EXPECT_EQ(reason(R"(, "strain_limit_percent": 10)"), "the strain limit");
  for (const std::string force : {"bending", "pressure", "buoyancy", "center", "mass_center", "wall", "sticky"})
    EXPECT_EQ(reason(R"(, "forces": [{"type": ")" + force + R"("}])"), "the force " + force);
  EXPECT_EQ(reason(R"(, "forces": [{"type": "wind"}, {"type": "wind"}])"), "more than one wind");
  std::string many = R"(, "colliders": [)";
  for (int c = 0; c < 17; ++c) many += std::string(c > 0 ? "," : "") + R"({"type": "sphere", "center": [0, -2, 0], "radius": 1})";
  EXPECT_EQ(reason(many + "]"), "more than 16 colliders");
}

TEST(DeviceRefusal, NamesTheLawOfASpring) {
  EXPECT_EQ(reason("", velocity_verlet, R"(, "law": "cable")"), "");
  EXPECT_EQ(reason("", velocity_verlet, R"(, "law": "strut")"), "struts");
  EXPECT_EQ(reason("", velocity_verlet, R"(, "law": "cubic", "k3": 10)"), "springs with a cubic force");
  EXPECT_EQ(reason("", velocity_verlet, R"(, "muscle": {"amplitude": 0.1})"), "springs whose rest length moves");
  EXPECT_EQ(reason("", velocity_verlet, R"(, "rest_length_rate": 0.1)"), "springs whose rest length moves");
}

TEST(DeviceRefusal, NamesTheMethod) {
  for (const Integrator& method : integrators()) {
    const bool runs = &method == &symplectic_euler || &method == &velocity_verlet || &method == &velocity_verlet_explicit;
    const std::string why = reason("", method);
    EXPECT_EQ(why.empty(), runs) << method.id;
    if (!runs) {
      EXPECT_EQ(why.substr(0, why.find(" (")), "the method " + std::string(method.id));
    }
  }
  EXPECT_EQ(reason("", velocity_verlet, R"(, "damping": 1)"), "");
}

}  // namespace
}  // namespace hooke
