// The initial view of a scene shows all of it, also while it moves.
#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "support/flat_scene.h"
#include "support/gui_fixture.h"
#include "support/modifiers.h"
#include "support/parts.h"

namespace hooke {
namespace {

glm::dvec2 view_size(double width, double height) {
  const Rect scene = lay_out(width, height, 1.0).scene;
  return {scene.width, scene.height};
}

// Points outside the picture, as a fraction of all; their radius counts.
double fraction_outside(const Camera& camera, const System& system, const State& state, const glm::dvec2& size) {
  Index outside = 0;
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3 at = camera.project(state.position[i], size);
    const double radius = system.points()[i].radius / camera.meters_per_pixel(state.position[i], size);
    const bool is_inside = at.x - radius >= 0.0 && at.x + radius <= size.x && at.y - radius >= 0.0 && at.y + radius <= size.y;
    if (!is_inside) ++outside;
  }
  return system.point_count() == 0 ? 0.0 : static_cast<double>(outside) / system.point_count();
}

// In the window as it opens: at the start, and in the following seconds until something tears, because pieces may fly away.
class Framing : public InParts<6> {};
INSTANTIATE_TEST_SUITE_P(Daily, Framing, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, Framing, testing::Range(1, Framing::parts));

TEST_P(Framing, KeepsShippedScenesInTheWindowWhileTheyMove) {
  const glm::dvec2 size = view_size(1280.0, 800.0);
  int number = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    if (!has(number++)) continue;
    Lab lab(load_scene(shipped.file).scene, KeepStart::No);
    lab.submit(SetAccuracy{AccuracyMode::Off});
    const Scene& scene = lab.scene();
    Camera camera = make_scene_camera(scene.view, scene.system, scene.state, size.x / size.y);
    EXPECT_EQ(fraction_outside(camera, scene.system, scene.state, size), 0.0) << shipped.id << " at the start";
    const long frames = std::lround(1.5 * scene.settings.frame_rate);
    double worst = 0.0, when = 0.0;
    for (long frame = 0; frame < frames && lab.step() && scene.state.torn == 0; ++frame) {
      follow_scene(camera, scene.state);
      if (const double outside = fraction_outside(camera, scene.system, scene.state, size); outside > worst) {
        worst = outside;
        when = scene.state.time;
      }
    }
    EXPECT_EQ(worst, 0.0) << shipped.id << " at " << when << " s";
  }
}

Scene falling_pair(bool nailed = false) {
  TestSim sim;
  const PointId first = nailed ? sim.nail({-0.2, 0.0, 0.0}) : sim.add({-0.2, 0.0, 0.0});
  sim.join(first, sim.add({0.2, 0.0, 0.0}), 100.0, 0.4);
  return flat_scene("Pair", sim);
}

TEST(OutOfView, IsReportedAndHomeShowsTheSceneAgain) {
  GuiFixture gui(falling_pair(true));
  EXPECT_EQ(gui.text().find("Out of view"), std::string::npos);
  const Rect& view = gui.app().layout().scene;
  const glm::dvec2 middle{view.x + 0.5 * view.width, view.y + 0.5 * view.height};
  for (int i = 0; i < 3; ++i) gui.drag(middle, middle + glm::dvec2(0.45 * view.width, 0.0), Button::Right);
  EXPECT_NE(gui.text().find("Out of view: press Home"), std::string::npos);
  gui.key(Key::Home);
  EXPECT_EQ(gui.text().find("Out of view"), std::string::npos);
}

TEST(Home, FollowsARunningSceneWithoutNails) {
  for (const bool nailed : {false, true}) {
    GuiFixture gui(falling_pair(nailed));
    gui.key(Key::Space);
    gui.key(Key::Home);
    EXPECT_EQ(gui.app().camera().follows, !nailed);
  }
}

TEST(OpeningCloth, FallsOnAFloorInSight) {
  GuiFixture gui(load_scene(find_scene("cloth")).scene);
  gui.key(letter('R'));
  gui.app().handle(Request(Control(RunTo{2.0})));
  EXPECT_TRUE(gui.wait_for_end_of_run());
  const Snapshot& snapshot = *gui.status().snapshot;
  const glm::dvec2 size = view_size(1280.0, 800.0);
  EXPECT_EQ(fraction_outside(gui.app().camera(), *snapshot.system, snapshot.state, size), 0.0);
  EXPECT_EQ(gui.text().find("Out of view"), std::string::npos);
  gui.key(letter('R'), control);
  EXPECT_TRUE(gui.system().points()[0].nailed);
  EXPECT_FALSE(gui.status().history.unsaved);
}

}  // namespace
}  // namespace hooke
