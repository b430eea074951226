// The device computes what the processor does, on whatever renderer this machine has.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>

#include "sim/forces/single_precision.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/counted_device.h"
#include "support/parts.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

struct Feature {
  const char* name;
  std::string fields;  // of the scene
  int points = 12;     // of the sheet along each side
  double scale = 1.0;  // [m], of the rounding, which impacts amplify
};

std::string sheet(const Feature& feature) {
  const std::string n = std::to_string(feature.points);
  return R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1], "points": [)" + n +
         ", " + n + R"(], "mass": 1, "stiffness": 100)" + feature.fields + R"(, "simulation": {"substeps": 40}})";
}

constexpr int frames = 25;  // 1000 steps

State run_on(Scene scene, const Integrator& method, Execution execution, const std::optional<GrabPoint>& grab = {}, int count = frames) {
  scene.settings.integrator = &method;
  Lab lab(std::move(scene), KeepStart::No);
  lab.set_execution(std::move(execution));
  if (grab) lab.submit(*grab);
  for (int frame = 0; frame < count; ++frame) {
    if (grab) lab.submit(MoveHand{grab->grab.target + 0.002 * frame * Vec3(1.0, 1.0, 0.5)});
    EXPECT_TRUE(lab.step()) << "frame " << frame;
  }
  return lab.scene().state;
}

double max_distance(const State& a, const State& b) {
  double max = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) max = std::max(max, glm::length(a.position[i] - b.position[i]));
  return max;
}

// Of a case with one method in each part.
class GpuAgreement : public InParts<3> {
 protected:
  void expect(const Scene& scene, const char* name, std::size_t number, double scale = 1.0, const std::optional<GrabPoint>& grab = {}) {
    const Integrator& method = *std::array{&symplectic_euler, &velocity_verlet, &velocity_verlet_explicit}[variant_of(number)];
    const std::string what = std::string(name) + ", " + std::string(method.id);
    const auto device = std::make_shared<CountedDevice>();
    const State expected = run_on(scene, method, {}, grab), computed = run_on(scene, method, {.device = device}, grab);
    EXPECT_EQ(device->frames, frames) << what;
    ASSERT_EQ(expected.position.size(), computed.position.size());
    const double distance = max_distance(expected, computed), moved = max_distance(expected, scene.state);
    if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("%s: %.2g m apart of %.2g\n", what.c_str(), distance, moved);
    EXPECT_LT(distance, 1e-11 * scale) << what;
    EXPECT_GT(moved, 1e-3) << what;
    EXPECT_EQ(expected.torn, computed.torn) << what;
  }
};
INSTANTIATE_TEST_SUITE_P(Daily, GpuAgreement, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, GpuAgreement, testing::Range(1, GpuAgreement::parts));

constexpr const char* hung = R"(, "nail": ["top_left", "top_right"]}])";
const Feature features[] = {
    {"springs of a grid", hung, 16},
    {"springs of any graph", hung, 6},
    {"dashpots", R"(, "damping": 0.1, "nail": ["top"]}])"},
    {"drag and wind", std::string(hung) + R"(, "drag": 0.5, "wind": [1, 0.5, 0.2])"},
    {"wind with gusts on faces", std::string(hung) + R"(, "forces": [{"type": "wind", "x": 4, "y": 1}])"},
    {"wind with drag and dashpots", R"(, "damping": 0.05, "nail": ["top"]}], "drag": 0.3, "forces": [{"type": "wind", "y": 6}])"},
    {"breaking springs", R"(, "nail": ["top"]}], "break_strain": 0.15)", 9},
    {"breaking springs with dashpots", R"(, "damping": 0.05, "nail": ["top"]}], "break_strain": 0.15)", 9},
    {"a held point",
     std::string(hung) + R"(, "hand": {"point": 140, "circle": {"from": [0.7, 0, 1], "center": [0.2, 0, 1]}, "speed": 1, "seconds": 0.2})"},
    {"flat scenes", R"(, "nail": ["top"]}], "dimensions": 2, "gravity": [1, -9.8, 0])"},
};

TEST_P(GpuAgreement, IsToRoundingOverAThousandSteps) {
  for (std::size_t number = 0; number < std::size(features); ++number) {
    const Feature& feature = features[number];
    std::string text = sheet(feature);
    if (std::string(feature.name) == "flat scenes") text.replace(text.find(R"("down": [0, 0, 1])"), 17, R"("down": [0, -1, 0])");
    expect(parse(text), feature.name, number, feature.scale);
  }
}

TEST_P(GpuAgreement, OfCablesThatOnlyPull) {
  std::size_t number = 0;
  for (const char* damping : {"0", "0.5"})
    expect(parse(R"({"hooke": 1, "generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 30, "mass": 1,
        "stiffness": 3000, "cable": 1, "nail": ["from"], "damping": )" +
                 std::string(damping) + R"(}], "simulation": {"substeps": 40}})"),
           "cables", number++);
}

TEST_P(GpuAgreement, OfWindOnThePointsOfASceneWithoutFaces) {
  expect(
      parse(
          R"({"hooke": 1, "generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 30, "mass": 0.1, "stiffness": 3000,
      "damping": 0, "nail": ["from"]}], "forces": [{"type": "wind", "z": 9, "normal": 4}], "simulation": {"substeps": 40}})"),
      "wind on points", 2);
}

TEST_P(GpuAgreement, OfTheHandThatPullsPointsAndPlacesBetweenPoints) {
  const Scene scene = parse(sheet({"", hung}));
  expect(scene, "pull", 0, 1.0, GrabPoint{{.point = PointId{66}, .target = Vec3(0.55, 0.03, 0.46)}});
  const Patch patch{{PointId{66}, PointId{67}, PointId{78}}, {0.5, 0.3, 0.2}};
  expect(scene, "pull between points", 1, 1.0, GrabPoint{{.point = PointId{66}, .patch = patch, .target = Vec3(0.55, 0.03, 0.46)}});
  expect(scene, "hold", 2, 1.0, GrabPoint{{.point = PointId{66}, .kind = GrabKind::Hold, .target = Vec3(0.55, 0.03, 0.46)}});
}

TEST(GpuDevice, TheSameSceneGivesTheSameBitsTwice) {
  for (const char* fields :
       {hung, R"(}], "colliders": [{"type": "sphere", "center": [0.5, -0.3, 0.5], "radius": 0.25, "friction": 0.4}])"}) {
    const Scene scene = parse(sheet({"", fields, 20}));
    const auto run_once = [&] { return hash_state(run_on(scene, symplectic_euler, {.device = std::make_shared<GpuDevice>()}, {}, 8)); };
    EXPECT_EQ(run_once(), run_once()) << fields;
  }
}

TEST(GpuDevice, AMotionThatNothingEditsStaysOnTheDevice) {
  static GlFunctions driver;
  static std::size_t sent = 0;  // [bytes]
  const auto device = std::make_shared<GpuDevice>([](GlFunctions& gl) {
    driver = gl;
    gl.BufferData = [](GLenum target, GLsizeiptr bytes, const void* data, GLenum use) {
      sent += data != nullptr ? static_cast<std::size_t>(bytes) : 0;
      driver.BufferData(target, bytes, data, use);
    };
  });
  Lab lab(parse(sheet({"", hung, 30})));
  lab.set_execution({.device = device});
  const auto sent_by = [&](int count) {
    const std::size_t before = sent;
    for (int frame = 0; frame < count; ++frame) {
      EXPECT_TRUE(lab.step());
      lab.measure_accuracy([] { return true; });
    }
    return sent - before;
  };
  const std::size_t state = 96 * 30 * 30;  // [bytes]
  // the run and the two beside it, which start anew now and then
  EXPECT_GT(sent_by(1), 3 * state);
  EXPECT_LT(sent_by(20) / 20, state / 2);
  lab.submit(SetNailed{.items = {{PointId{450}, true}}});
  EXPECT_GT(sent_by(1), 3 * state);
  EXPECT_LT(sent_by(10) / 10, state / 2);
}

TEST(GpuDevice, SinglePrecisionStaysNearDouble) {
  const Scene scene = parse(sheet({"", hung}));
  const auto device = std::make_shared<CountedDevice>();
  const State expected = run_on(scene, velocity_verlet, {});
  const State computed = run_on(scene, velocity_verlet, {.single = std::make_shared<SinglePrecision>(), .device = device});
  EXPECT_EQ(device->frames, frames);
  EXPECT_LT(max_distance(expected, computed), 1e-4);
  EXPECT_GT(max_distance(expected, computed), 1e-9);
}

}  // namespace
}  // namespace hooke
