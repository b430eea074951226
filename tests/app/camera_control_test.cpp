// The camera by mouse and keys.
#include "app/app.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "formats/scene_file.h"
#include "support/gui_fixture.h"
#include "support/hanging_scene.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

TEST(Camera, OrbitsPansAndZoomsToTheCursor) {
  GuiFixture gui(hanging(3));
  const Vec3 back = gui.app().camera().back, target = gui.app().camera().target;
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_GT(glm::distance(gui.app().camera().back, back), 0.1);
  EXPECT_EQ(gui.app().camera().target, target);
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Middle, {.shift = true});
  EXPECT_GT(glm::distance(gui.app().camera().target, target), 0.01);

  const glm::dvec2 before = gui.seen({0.2, 0.0, 0.0});
  const double distance = gui.app().camera().distance;
  gui.move(before);
  gui.app().handle(Scroll{3.0, before});
  EXPECT_LT(gui.app().camera().distance, distance);
  EXPECT_LT(glm::distance(gui.seen({0.2, 0.0, 0.0}), before), 40.0);
  gui.key(Key::Home);
  const glm::dvec2 home = gui.seen({0.2, 0.2, 0.0});
  EXPECT_TRUE(gui.app().layout().scene.contains(home.x, home.y));
}

TEST(Camera, StaysPerpendicularToAFlatScene) {
  GuiFixture gui(hanging());
  const Vec3 back = gui.app().camera().back, target = gui.app().camera().target;
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_EQ(gui.app().camera().back, back);
  EXPECT_NE(gui.app().camera().target, target);
}

TEST(Camera, LooksAlongTheAxesAndFromTheOppositeSideOnRepetition) {
  GuiFixture gui(hanging(3));
  const auto from = [&](char key) {
    gui.key(letter(key));
    return gui.app().camera().back;
  };
  EXPECT_LT(glm::distance(from('1'), {0.0, 0.0, 1.0}), 1e-12);
  EXPECT_LT(glm::distance(from('1'), {0.0, 0.0, -1.0}), 1e-12);
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 1.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(from('3'), {1.0, 0.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(from('7'), {0.0, 1.0, 0.0}), 1e-12);
  // seen from above, the front is at the bottom
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 0.0, -1.0}), 1e-12);
  EXPECT_LT(glm::distance(from('7'), {0.0, -1.0, 0.0}), 1e-12);
  EXPECT_LT(glm::distance(gui.app().camera().up, {0.0, 0.0, 1.0}), 1e-12);
  gui.key(letter('5'));
  EXPECT_TRUE(gui.app().camera().orthographic);
  gui.key(letter('5'));
  EXPECT_FALSE(gui.app().camera().orthographic);
  // then it orbits as before
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  EXPECT_NEAR(glm::length(gui.app().camera().up), 1.0, 1e-12);
  EXPECT_NEAR(glm::dot(gui.app().camera().up, gui.app().camera().back), 0.0, 1e-12);
}

TEST(Camera, AClickOnAnAxisLooksAlongIt) {
  {
    GuiFixture flat(hanging(2));
    flat.frames(2);
    EXPECT_EQ(ImGui::FindWindowByName("axes"), nullptr);
  }
  GuiFixture gui(hanging(3));
  gui.frames(2);
  const ImGuiWindow* axes = ImGui::FindWindowByName("axes");
  ASSERT_NE(axes, nullptr);
  const Camera camera = gui.app().camera();
  const Vec3 right = glm::cross(camera.up, camera.back);
  const glm::dvec2 center(axes->Pos.x + 0.5 * axes->Size.x, axes->Pos.y + 0.5 * axes->Size.y);
  gui.click(center + 31.0 * glm::dvec2(right.x, -camera.up.x));
  EXPECT_LT(glm::distance(gui.app().camera().back, {1.0, 0.0, 0.0}), 1e-12);
  EXPECT_TRUE(gui.app().selection().empty());
}

TEST(Camera, IsCopiedAndPastedAsText) {
  GuiFixture gui(hanging(3));
  gui.drag({400.0, 400.0}, {480.0, 420.0}, Button::Right);
  gui.key(letter('5'));
  const Camera camera = gui.app().camera();
  gui.key(letter('C'), control_shift);
  gui.key(letter('1'));
  gui.key(letter('5'));
  gui.key(letter('V'), control_shift);
  const Camera& pasted = gui.app().camera();
  EXPECT_LT(glm::distance(pasted.eye(), camera.eye()), 1e-12);
  EXPECT_LT(glm::distance(pasted.target, camera.target), 1e-12);
  EXPECT_TRUE(pasted.orthographic);
  gui.app().use({.put = nullptr, .take = [] { return std::string("1,2,3"); }});
  gui.key(letter('V'), control_shift);
  EXPECT_EQ(gui.app().panels().messages.toast, "The clipboard contains no camera");
  EXPECT_LT(glm::distance(gui.app().camera().eye(), camera.eye()), 1e-12);
}

}  // namespace
}  // namespace hooke
