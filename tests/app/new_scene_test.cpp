// What a user builds in a new scene does not blow up: its method is `auto`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "scene/shape.h"
#include "sim/control/automatic.h"
#include "support/gui_fixture.h"
#include "support/modifiers.h"

namespace hooke {
namespace {

// Moves the sliders to one end: those that set the stiffness of springs to the maximum, that of the mass of points to the minimum.
void make_stiff_and_light(GuiFixture& gui) {
  const auto rows = parameters();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_stiffness = rows[i].scope == Parameter::Scope::SpringStiffness, is_mass = rows[i].scope == Parameter::Scope::PointMass;
    if ((!is_stiffness && !is_mass) || std::isnan(gui.status().document->parameter_values[i])) continue;
    gui.app().handle(Request(Edit{SetParameter{&rows[i], is_mass ? rows[i].min : rows[i].max}}));
    gui.frames(2);
  }
  SetPointProperty masses{PointProperty::Mass, {}};
  for (const Point& point : gui.system().points()) masses.values.emplace_back(point.id, std::min(point.mass, 1e-3));
  gui.app().handle(Request(Edit{masses}));
  gui.frames(2);
}

// [m/s], the maximum in so many frames; infinity: the run diverged.
double max_speed(GuiFixture& gui, int frames) {
  double max = 0.0;
  for (int frame = 0; frame < frames; ++frame) {
    const long before = gui.status().run.frames;
    gui.key(Key::Period);
    if (gui.status().run.frames == before) return INFINITY;
    for (const Vec3& v : gui.status().snapshot->state.velocity) max = std::max(max, glm::length(v));
  }
  return max;
}

void build_net(GuiFixture& gui) {
  gui.key(letter('N'), control_shift);
  gui.app().handle(Request(StartPlacement{find_shape_kind("sheet")}));
  gui.frames(2);
  gui.key(Key::Enter);
  ASSERT_GT(gui.system().spring_count(), 100);
  make_stiff_and_light(gui);
}

TEST(NewScenes, AreSteppedByATolerance) {
  for (const Modifiers keys : {control, control_shift}) {
    GuiFixture gui;
    ASSERT_FALSE(is_automatic(gui.status().snapshot->settings));
    gui.key(letter('N'), keys);
    EXPECT_TRUE(is_automatic(gui.status().snapshot->settings));
    EXPECT_NE(gui.text().find("Automatic"), std::string::npos);
    EXPECT_FALSE(gui.status().history.unsaved);
    gui.key(Key::Period);  // nothing moves, nothing fails
    EXPECT_EQ(gui.status().run.frames, 1);
    EXPECT_TRUE(gui.status().diagnosis.message.empty());
  }
}

TEST(NewScenes, KeepTheirMethodInAFileAndFilesWithoutOneKeepTheDefault) {
  const Scene scene = empty_scene();
  const LoadedScene again = parse_scene(format_scene(scene), "new");
  EXPECT_EQ(again.scene.settings, scene.settings);
  EXPECT_TRUE(again.warnings.empty());
  EXPECT_EQ(parse_scene(R"({"hooke": 1, "points": []})", "old").scene.settings.integrator, &default_integrator());
}

TEST(NewScenes, DoNotBlowUpHoweverStiffAndLightTheirNets) {
  GuiFixture gui;
  build_net(gui);
  constexpr double seconds = 1.0, gravity = 9.81;
  const double speed = max_speed(gui, 60);
  // it cannot become faster than twice as fast as it falls
  EXPECT_LT(speed, 2.0 * gravity * seconds);
  EXPECT_GT(speed, 0.0);
}

TEST(NewScenes, WouldBlowUpWithTheDefaultOfFiles) {
  GuiFixture gui;
  build_net(gui);
  gui.app().handle(Request(Edit{SetIntegrator{&default_integrator()}}));
  gui.frames(2);
  EXPECT_GT(max_speed(gui, 60), 1e3);
}

}  // namespace
}  // namespace hooke
