// Random combinations of everything that a scene can have: the device refuses those with anything that it does not compute, and agrees with
// the processor on all others.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>

#include "device/gpu_device.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/rows.h"
#include "sim/model/hash.h"
#include "support/parts.h"
#include "support/random_scene.h"
#include "support/run_lab.h"

namespace hooke {
namespace {

struct RandomPart {
  const char* fields;
  bool is_computed;  // by the device
};

// Of the scene; a force goes to its list of forces.
constexpr RandomPart scene_features[] = {
    {R"("drag": 0.4)", true},
    {R"("wind": [1, 0, 0.5], "drag": 0.2)", true},
    {R"("break_strain": 0.2)", true},
    {R"("colliders": [{"type": "plane", "point": [0, -0.3, 0], "normal": [0.1, 1, 0], "friction": 0.3}])", true},
    {R"("colliders": [{"type": "sphere", "center": [0.4, -0.5, 0.4], "radius": 0.35, "restitution": 0.4},
                                          {"type": "box", "min": [-1, -2, -1], "max": [2, -0.7, 2], "belt": [0.3, 0, 0], "friction": 0.4}])",
     true},
    {R"("colliders": [{"type": "sphere", "center": [0.5, -0.4, 0.5], "radius": 0.3, "oscillate": [0, 0.05, 0.02], "frequency": 2, "spin": [0, 2, 0],
       "friction": 0.3}])",
     true},
    {R"("colliders": [{"type": "plane", "point": [0, -0.3, 0], "normal": [0, 1, 0], "one_way": true}])", false},
    {R"("strain_limit_percent": 20)", false},
    {R"("contact": {"points": true})", false},
    {R"("contact": {"faces": true, "thickness": 0.004})", false},
    {R"("contact": {"springs": true, "thickness": 0.004})", false}};
constexpr RandomPart point_features[] = {{R"("nailed": true)", true}, {R"("mass": 3, "radius": 0.05)", true}, {R"("fixed": "y")", false}};
constexpr RandomPart spring_features[] = {{R"("damping": 0.3)", true},
                                          {R"("law": "cable")", true},
                                          {R"("law": "cable", "damping": 0.3)", true},
                                          {R"("break_strain": 0.05)", true},
                                          {R"("law": "strut")", false},
                                          {R"("law": "cubic", "k3": 10)", false},
                                          {R"("muscle": {"amplitude": 0.1})", false},
                                          {R"("rest_length_rate": 0.1)", false}};

// One of them in one of `rarity` scenes, or nothing.
template <std::size_t n>
std::string pick(Random& random, const RandomPart (&features)[n], Index rarity, bool& is_computed) {
  if (!random.one_in(rarity)) return {};
  const RandomPart& feature = features[random.below(static_cast<Index>(n))];
  is_computed = is_computed && feature.is_computed;
  return std::string(", ") + feature.fields;
}

// A sheet, which may be a grid, some points and springs beside it, and listed forces.
std::string random_text(Random& random, bool& is_computed) {
  std::string text = R"({"hooke": 1, "points": [{"position": [1.2, 0, 0], "nailed": true})";
  for (int i = 0; i < 4; ++i)
    text += R"(, {"position": [)" + std::to_string(1.4 + 0.2 * i) + R"(, 0, 0.1])" + pick(random, point_features, 6, is_computed) + "}";
  text += R"(], "springs": [{"points": [0, 1], "stiffness": 80})";
  for (int i = 1; i < 4; ++i)
    text += R"(, {"points": [)" + std::to_string(i) + ", " + std::to_string(i + 1) + R"(], "stiffness": 60)" +
            pick(random, spring_features, 5, is_computed) + "}";
  const std::string n = std::to_string(6 + random.below(12));
  text += R"(], "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, 0, 1], "points": [)" + n + ", " + n +
          R"(], "mass": 1, "stiffness": 90, "nail": ["top"])" + (random.one_in(3) ? R"(, "damping": 0.05)" : "") +
          (random.one_in(6) ? R"(, "bend_stiffness": 20)" : "") + "}]";
  if (random.one_in(2)) {
    const std::string id(random.one_of(force_terms()).id);
    is_computed = is_computed && id == "wind";
    text += R"(, "forces": [{"type": ")" + id + R"("}])";
  }
  text += pick(random, scene_features, 2, is_computed);
  return text + R"(, "simulation": {"substeps": 25}})";
}

class GpuRandomScenes : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, GpuRandomScenes, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, GpuRandomScenes, testing::Range(1, GpuRandomScenes::parts));

TEST_P(GpuRandomScenes, AgreeWithTheProcessorOrAreRefused) {
  const auto device = std::make_shared<GpuDevice>();
  int computed = 0, refused = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    if (!has(static_cast<int>(seed))) continue;
    Random random(seed);
    bool is_computed = true;
    const std::string text = random_text(random, is_computed);
    Scene scene = parse(text);
    const std::array computed_there{&symplectic_euler, &velocity_verlet, &velocity_verlet_explicit};
    const Integrator& method = random.one_in(5) ? random.one_of(integrators()) : *random.one_of(std::span(computed_there));
    scene.settings.integrator = &method;
    const bool runs = needs_processor(make_plan(System()), method).find("method") == std::string::npos;
    Lab lab(scene, KeepStart::No), expected(scene, KeepStart::No);
    lab.set_execution({.device = device});
    const std::string refusal = lab.device_refusal();
    EXPECT_EQ(refusal.empty(), is_computed && runs) << seed << ": " << refusal << "\n" << text;
    (refusal.empty() ? computed : refused)++;
    if (random.one_in(4))
      for (Lab* each : {&lab, &expected}) {
        const auto kind = seed % 2 == 0 ? GrabKind::Hold : GrabKind::Pull;
        const PointId held{30};
        const Vec3 place = scene.state.position[scene.system.index_of(held)];
        each->submit(GrabPoint{{.point = held, .kind = kind, .target = place + Vec3(0.0, 0.1, 0.02)}});
      }
    double distance = 0.0;
    for (int frame = 0; frame < 8 && expected.step() && lab.step(); ++frame)
      for (Index i = 0; i < scene.system.point_count(); ++i)
        distance = std::max(distance, glm::distance(lab.scene().state.position[i], expected.scene().state.position[i]));
    EXPECT_LT(distance, 1e-9) << seed << "\n" << text;
    EXPECT_EQ(lab.scene().state.torn, expected.scene().state.torn) << seed;
    if (!refusal.empty()) {
      EXPECT_EQ(hash_state(lab.scene().state), hash_state(expected.scene().state)) << seed;
    }
    EXPECT_EQ(lab.device_refusal(), refusal) << seed;
  }
  EXPECT_GT(computed, 15 / parts);
  EXPECT_GT(refused, 60 / parts);
}

}  // namespace
}  // namespace hooke
