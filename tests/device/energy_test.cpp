// Works by cause, as the passes measure them, against those of the processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "sim/methods/rows.h"
#include "support/counted_device.h"
#include "support/parts.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

struct WorkCase {
  const char* name;
  const char* fields;
  double tolerance = 0.01;  // of the largest work
};

constexpr const char* hung_by_corners = R"(, "nail": ["top_left", "top_right"]}])";
constexpr WorkCase work_cases[] = {
    {"drag", R"(, "nail": ["top_left", "top_right"]}], "drag": 0.8)"},
    {"moving air and drag", R"(, "nail": ["top_left", "top_right"]}], "drag": 0.5, "wind": [1, 0.5, 0.2])"},
    {"wind", R"(, "nail": ["top_left", "top_right"]}], "forces": [{"type": "wind", "x": 6, "y": 2}])"},
    {"dashpots", R"(, "damping": 0.3, "nail": ["top"]}])"},
    {"dashpots and a plane",
     R"(, "damping": 0.3}], "colliders": [{"type": "plane", "point": [0, -0.1, 0], "normal": [0, 1, 0], "friction": 0.3}])", 0.03},
    {"a ball with friction", R"(}], "colliders": [{"type": "sphere", "center": [0.5, -0.3, 0.5], "radius": 0.25, "friction": 0.4}])"},
    {"a floor that bounces",
     R"(}], "drag": 0.2, "colliders": [{"type": "plane", "point": [0, -0.1, 0], "normal": [0.1, 1, 0], "restitution": 0.5, "friction": 0.2}])"},
    {"a floor that oscillates",
     R"(}], "colliders": [{"type": "plane", "point": [0, -0.2, 0], "normal": [0, 1, 0], "oscillate": [0, 0.05, 0], "frequency": 3, "friction": 0.3}])",
     0.03},
};

EnergyLedger works(Scene scene, const Integrator& method, const std::shared_ptr<FrameDevice>& device,
                   const std::optional<GrabPoint>& grab) {
  scene.settings.integrator = &method;
  Lab lab(std::move(scene), KeepStart::No);
  lab.submit(SetAccuracy{AccuracyMode::Frame});
  lab.set_execution({.device = device});
  if (grab) lab.submit(*grab);
  EnergyLedger sum;
  for (int frame = 0; frame < 25; ++frame) {
    if (grab) lab.submit(MoveHand{grab->grab.target + 0.01 * frame * Vec3(1.0, 1.0, 0.5)});
    EXPECT_TRUE(lab.step()) << "frame " << frame;
    sum += lab.last_frame().motion().energy;
  }
  return sum;
}

void expect_works(const WorkCase& each, const Integrator& method, const std::optional<GrabPoint>& grab = {}) {
  const Scene scene = parse(R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1],
      "points": [12, 12], "mass": 1, "stiffness": 100)" +
                            std::string(each.fields) + R"(, "simulation": {"substeps": 40}})");
  const auto device = std::make_shared<CountedDevice>();
  const EnergyLedger expected = works(scene, method, nullptr, grab), measured = works(scene, method, device, grab);
  EXPECT_GT(device->frames, 24);
  double largest = 0.0;
  for (const double work : expected.work) largest = std::max(largest, std::abs(work));
  EXPECT_GT(largest, 1e-3) << each.name;
  for (std::size_t cause = 0; cause < EnergyLedger::causes; ++cause) {
    if (std::getenv("HOOKE_PRINT") != nullptr && (expected.work[cause] != 0.0 || measured.work[cause] != 0.0))
      std::printf("%s, %s: cause %zu: %.6g J, on the device %.6g J\n", each.name, std::string(method.id).c_str(), cause,
                  expected.work[cause], measured.work[cause]);
    EXPECT_NEAR(measured.work[cause], expected.work[cause], each.tolerance * largest)
        << each.name << ", " << method.id << ", cause " << cause;
  }
}

class GpuEnergy : public InParts<3> {
 protected:
  const Integrator& method_of(std::size_t number) const {
    return *std::array{&symplectic_euler, &velocity_verlet, &velocity_verlet_explicit}[variant_of(number)];
  }
};
INSTANTIATE_TEST_SUITE_P(Daily, GpuEnergy, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, GpuEnergy, testing::Range(1, GpuEnergy::parts));

TEST_P(GpuEnergy, WorksByCauseAreThoseOfTheProcessor) {
  for (std::size_t i = 0; i < std::size(work_cases); ++i) expect_works(work_cases[i], method_of(i));
}

TEST_P(GpuEnergy, TheHandSuppliesWhatItPullsAndHolds) {
  const GrabPoint pull{{.point = PointId{66}, .target = Vec3(0.55, 0.03, 0.46)}};
  const GrabPoint hold{{.point = PointId{66}, .kind = GrabKind::Hold, .target = Vec3(0.55, 0.03, 0.46)}};
  for (const char* fields : {hung_by_corners, R"(, "damping": 0.1, "nail": ["top_left", "top_right"]}])"}) {
    expect_works({"pull", fields}, method_of(0), pull);
    expect_works({"hold", fields, 1e-3}, method_of(1), hold);
  }
}

}  // namespace
}  // namespace hooke
