// Runs that blow up: what the processor reports, the device does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "lab/accuracy/judgement.h"
#include "sim/methods/rows.h"
#include "support/counted_device.h"
#include "support/parts.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

struct BlowUp {
  const char* name;
  const char* fields;
  std::optional<GrabPoint> grab{};
};

constexpr const char* nailed_at_corners = R"(, "nail": ["top_left", "top_right"]}])";

// Where a run stopped, why, and what was said of it before.
struct Course {
  int frames = 0;
  std::optional<Divergence::Kind> kind;
  Judgement::Level level = Judgement::Level::Good;
  std::string text;
};

Course course_of(const BlowUp& each, const Integrator& method, int substeps, const std::shared_ptr<FrameDevice>& device) {
  Scene scene = parse(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1],
      "points": [9, 9], "mass": 0.5, "stiffness": 2000)" +
                      std::string(each.fields) + "}");
  scene.settings.integrator = &method;
  scene.settings.substeps = substeps;
  Lab lab(std::move(scene), KeepStart::No);
  lab.submit(SetAccuracy{AccuracyMode::Full});
  lab.set_execution({.device = device});
  if (each.grab) lab.submit(*each.grab);
  Course course;
  for (; course.frames < 12; ++course.frames) {
    if (each.grab) lab.submit(MoveHand{each.grab->grab.target + 0.01 * course.frames * Vec3(1.0, 1.0, 0.5)});
    if (!lab.step()) break;
  }
  lab.publish();
  const Judgement judgement = judge(lab.status()->accuracy);
  course.level = judgement.level;
  course.text = judgement.text;
  if (const auto& divergence = lab.status()->snapshot->divergence) course.kind = divergence->kind;
  EXPECT_EQ(lab.device_refusal(), "") << each.name;
  return course;
}

const BlowUp blow_ups[] = {
    {"a hung sheet", nailed_at_corners},
    {"drag", R"(, "nail": ["top_left", "top_right"]}], "drag": 0.8)"},
    {"wind", R"(, "nail": ["top_left", "top_right"]}], "forces": [{"type": "wind", "x": 6, "y": 2}])"},
    {"a plane", R"(}], "colliders": [{"type": "plane", "point": [0, -0.1, 0], "normal": [0, 1, 0], "friction": 0.3}])"},
    {"a ball", R"(}], "colliders": [{"type": "sphere", "center": [0.5, -0.3, 0.5], "radius": 0.25, "restitution": 0.5}])"},
    {"a floor that oscillates",
     R"(}], "colliders": [{"type": "plane", "point": [0, -0.2, 0], "normal": [0, 1, 0], "oscillate": [0, 0.05, 0], "frequency": 3}])"},
    {"a pull", nailed_at_corners, GrabPoint{{.point = PointId{40}, .target = Vec3(0.52, 0.03, 0.5)}}},
    {"a hold", nailed_at_corners, GrabPoint{{.point = PointId{40}, .kind = GrabKind::Hold, .target = Vec3(0.52, 0.03, 0.5)}}},
    {"stiff dashpots", R"(, "damping": 4, "nail": ["top"]}])"},
    {"springs that break", R"(, "nail": ["top"]}], "break_strain": 5)"},
};

class GpuBlowUps : public InParts<4> {};
INSTANTIATE_TEST_SUITE_P(Daily, GpuBlowUps, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, GpuBlowUps, testing::Range(1, GpuBlowUps::parts));

TEST_P(GpuBlowUps, AreReportedAsOnTheProcessor) {
  for (std::size_t i = 0; i < std::size(blow_ups); ++i) {
    const BlowUp& each = blow_ups[i];
    const std::size_t variant = variant_of(i);
    const Integrator* method = variant < 2 ? &symplectic_euler : &velocity_verlet_explicit;
    const int substeps = variant % 2 == 0 ? 8 : 40;
    const std::string what = std::string(each.name) + ", " + std::string(method->id) + ", " + std::to_string(substeps);
    const auto device = std::make_shared<CountedDevice>();
    const Course expected = course_of(each, *method, substeps, nullptr), computed = course_of(each, *method, substeps, device);
    if (std::getenv("HOOKE_PRINT") != nullptr)
      std::printf("%s: %d frames, kind %d, level %d, %s | %d, %d, %d, %s\n", what.c_str(), expected.frames,
                  expected.kind ? static_cast<int>(*expected.kind) : -1, static_cast<int>(expected.level), expected.text.c_str(),
                  computed.frames, computed.kind ? static_cast<int>(*computed.kind) : -1, static_cast<int>(computed.level),
                  computed.text.c_str());
    EXPECT_EQ(expected.kind.has_value(), computed.kind.has_value()) << what;
    EXPECT_LE(std::abs(expected.frames - computed.frames), 3) << what;
    EXPECT_EQ(expected.level, computed.level) << what;
    EXPECT_GT(device->frames, 0) << what;
  }
}

}  // namespace
}  // namespace hooke
