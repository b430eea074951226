// What panels show of the springs is computed when the scene or the selection changes, and not once per frame.
#include <gtest/gtest.h>

#include "support/flat_scene.h"
#include "support/gui_fixture.h"

namespace hooke {
namespace {

Scene unequal_springs() {
  TestSim sim;
  const PointId a = sim.nail({-0.5, 0.0, 0.0}), b = sim.add({0.0, 0.0, 0.0}), c = sim.add({0.5, 0.0, 0.0});
  sim.join(a, b, 100.0, 0.5);
  sim.join(b, c, 300.0, 0.5);
  return flat_scene("Two springs", sim);
}

TEST(AffectedParts, AreComputedOnceForAnyNumberOfFrames) {
  GuiFixture gui(unequal_springs());
  gui.key(letter('A'), {.control = true});
  for (const bool running : {false, true}) {
    if (running) gui.key(Key::Space);
    gui.frames(3);
    ASSERT_EQ(gui.status().run.running, running);
    const long before = gui.app().panels().side.affected_parts.computations();
    const double time = gui.status().snapshot->state.time;
    // the laboratory runs in real time
    const auto has_moved = [&] { return gui.status().snapshot->state.time > time; };
    for (int i = 0; i < 30 || (running && !has_moved() && i < 100'000); ++i) gui.frame();
    EXPECT_EQ(has_moved(), running);
    EXPECT_EQ(gui.app().panels().side.affected_parts.computations(), before);
  }
}

TEST(AffectedParts, AreComputedOnceMoreAfterAnEditOrAnotherSelection) {
  GuiFixture gui(unequal_springs());
  const AffectedPartsCache& cache = gui.app().panels().side.affected_parts;
  const long before = cache.computations();
  gui.app().handle(Request(Edit{SetSpringProperty{SpringProperty::Stiffness, {{SpringId{0}, 200.0}}}}));
  gui.frames(3);
  EXPECT_EQ(cache.computations(), before + 1);
  gui.key(letter('A'), {.control = true});
  gui.frames(3);
  EXPECT_EQ(cache.computations(), before + 2);
}

TEST(AffectedParts, OfASelectionAreItsPointsAndTheSpringsBetweenThemAsTheyAreNow) {
  GuiFixture gui(unequal_springs());
  AffectedPartsCache cache;
  const auto stiffness_slider = static_cast<std::size_t>(&stiffness_parameter - parameters().data());
  const AffectedParts& all = cache.of(gui.status(), {});
  EXPECT_TRUE(all.springs.empty());
  EXPECT_EQ(all.slider_values[stiffness_slider].value_or(0.0), 200.0);
  EXPECT_TRUE(all.slider_values[stiffness_slider].is_mixed());

  const Selection right{{PointId{1}, PointId{2}}, {}};
  const AffectedParts& parts = cache.of(gui.status(), right);
  EXPECT_EQ(parts.points, (std::vector<Index>{1, 2}));
  EXPECT_EQ(parts.springs, (std::vector<Index>{1}));
  EXPECT_EQ(parts.stiffness.value, 300.0);
  EXPECT_EQ(parts.slider_values[stiffness_slider].value_or(0.0), 300.0);
  EXPECT_FALSE(parts.slider_values[stiffness_slider].is_mixed());

  gui.app().handle(Request(Edit{SetSpringProperty{SpringProperty::Stiffness, {{SpringId{1}, 50.0}}}}));
  EXPECT_EQ(cache.of(gui.status(), right).stiffness.value, 50.0);
  EXPECT_EQ(cache.computations(), 3);
}

}  // namespace
}  // namespace hooke
