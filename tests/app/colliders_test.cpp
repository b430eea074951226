// Colliders are added, edited, sized and deleted in the window.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/edit/placement_part.h"
#include "scene/collider_kinds.h"
#include "support/gui_fixture.h"
#include "support/hanging_scene.h"
#include "ui/search_results.h"

namespace hooke {
namespace {

const ColliderKind& kind(std::string_view label) { return *std::ranges::find(collider_kinds(), label, &ColliderKind::label); }

void start(GuiFixture& gui, std::string_view label) {
  gui.app().handle(Request(StartPlacement{nullptr, false, &kind(label)}));
  gui.frames(2);
}

const Collider& collider(GuiFixture& gui) { return gui.system().colliders.back(); }

// Placed with its middle at a position in sight.
void place(GuiFixture& gui, std::string_view label, const Vec3& at) {
  start(gui, label);
  auto& placed = gui.app().panels().placement.collider;
  placed = translated(*placed, at - anchor_of(*placed));
  gui.app().handle(Request(Place{}));
  gui.frames(2);
}

TEST(Colliders, AreInTheAddMenuAndInTheSearch) {
  GuiFixture gui(hanging());
  gui.click(gui.find("menu", {"Add"}));
  gui.frames(3);
  const std::string words = gui.text();
  gui.key(Key::Escape);
  for (const ColliderKind& each : collider_kinds()) {
    EXPECT_NE(words.find(each.label), std::string::npos) << each.label;
    const auto found = find_results(gui.app().panel_input({}), std::string(each.label));
    EXPECT_TRUE(std::ranges::any_of(found, [&](const SearchResult& row) { return row.text == "Add " + std::string(each.label); }))
        << each.label;
  }
}

TEST(Colliders, OfEveryKindArePreviewedPlacedAndUndoneInOneStep) {
  for (const int dimensions : {2, 3})
    for (const ColliderKind& each : collider_kinds()) {
      GuiFixture gui(hanging(dimensions));
      start(gui, each.label);
      EXPECT_FALSE(gui.app().marks().ghost_lines.empty()) << each.label;
      EXPECT_TRUE(gui.system().colliders.empty());
      const std::string words = gui.text();
      for (const char* row : {"Restitution", "Friction", "Frequency", "Belt x"}) EXPECT_NE(words.find(row), std::string::npos) << row;
      gui.app().handle(Request(Place{}));
      gui.frames(2);
      ASSERT_EQ(gui.system().colliders.size(), 1u) << each.label;
      EXPECT_EQ(gui.app().selection().collider, Index{0});
      EXPECT_NE(gui.text().find("Collider"), std::string::npos);
      gui.key(letter('Z'), control);
      EXPECT_TRUE(gui.system().colliders.empty());
      EXPECT_TRUE(gui.app().selection().empty());
    }
}

TEST(Colliders, AreSelectedByAClickSizedByAHandleAndDeleted) {
  GuiFixture gui(hanging());
  place(gui, "Ball", {0.23, 0.33, 0.0});
  gui.click(gui.seen({0.02, 0.15, 0.0}));
  EXPECT_TRUE(gui.app().selection().empty());
  gui.click(gui.seen({0.23, 0.33, 0.0}));
  ASSERT_EQ(gui.app().selection().collider, Index{0});
  const double before = std::get<Sphere>(collider(gui).shape).radius;
  const Vec3 handle = Vec3(0.23, 0.33, 0.0) + Vec3(before, 0.0, 0.0);
  gui.drag(gui.seen(handle), gui.seen(handle + Vec3(0.1, 0.0, 0.0)));
  EXPECT_NEAR(std::get<Sphere>(collider(gui).shape).radius, before + 0.1, 0.02);
  EXPECT_EQ(std::get<Sphere>(collider(gui).shape).center, Vec3(0.23, 0.33, 0.0));
  gui.key(letter('Z'), control);
  EXPECT_EQ(std::get<Sphere>(collider(gui).shape).radius, before);
  gui.key(Key::Delete);
  EXPECT_TRUE(gui.system().colliders.empty());
  gui.key(letter('Z'), control);
  EXPECT_EQ(gui.system().colliders.size(), 1u);
}

TEST(Colliders, ThatAreMadeTooSmallSaySo) {
  GuiFixture gui(hanging());
  place(gui, "Ball", {0.23, 0.33, 0.0});
  gui.app().panels().messages.toast.clear();
  gui.click(gui.seen({0.23, 0.33, 0.0}));
  const Vec3 center(0.23, 0.33, 0.0);
  const double radius = std::get<Sphere>(collider(gui).shape).radius;
  gui.drag(gui.seen(center + Vec3(radius, 0.0, 0.0)), gui.seen(center + Vec3(0.02, 0.0, 0.0)));
  gui.frames(2);
  EXPECT_NE(gui.app().panels().messages.toast.find("fits between the points"), std::string::npos) << gui.app().panels().messages.toast;

  gui.app().panels().messages.toast.clear();
  std::vector<Collider> colliders = gui.system().colliders;
  std::get<Sphere>(colliders.back().shape).radius = 0.01;
  gui.app().handle(Request(Edit{SetColliders{colliders}}));
  gui.frames(2);
  EXPECT_NE(gui.app().panels().messages.toast.find("a ball of radius 0.01 m fits"), std::string::npos) << gui.app().panels().messages.toast;
}

TEST(Colliders, AreMovedByADrag) {
  GuiFixture gui(hanging());
  place(gui, "Box", {0.23, 0.33, 0.0});
  gui.drag(gui.seen({0.23, 0.33, 0.0}), gui.seen({0.3, 0.33, 0.0}));
  EXPECT_NEAR(anchor_of(collider(gui)).x, 0.3, 0.02);
}

TEST(Colliders, APlaneIsTiltedByItsNormal) {
  GuiFixture other(hanging());
  place(other, "Plane", {0.2, 0.25, 0.0});
  other.click(other.seen({0.3, 0.1, 0.0}));
  ASSERT_EQ(other.app().selection().collider, Index{0});
  other.frames(2);
  ASSERT_EQ(other.app().marks().ghost_nails.size(), 1u);
  const Vec3 tip = other.app().marks().ghost_nails[0];
  other.drag(other.seen(tip), other.seen(Vec3(0.2, 0.25, 0.0) + Vec3(0.2, 0.2, 0.0)));
  const Vec3 normal = std::get<Plane>(collider(other).shape).normal;
  EXPECT_NEAR(normal.x, normal.y, 0.05);
  EXPECT_GT(normal.x, 0.5);
}

// Typed values: what the tables describe can be read back, and every change is valid.
TEST(Colliders, EveryNumberCanBeSetForEveryKindThatHasIt) {
  int set = 0;
  for (const ColliderKind& each : collider_kinds()) {
    GuiFixture gui(hanging(3));
    place(gui, each.label, {0.2, -0.6, 0.0});
    for (const ColliderNumber& row : collider_numbers()) {
      Collider changed = collider(gui);
      if (!row.applies(changed)) continue;
      row.write(changed, 0.5);
      if (!row.label.starts_with("Normal")) {
        EXPECT_NEAR(row.read(changed), 0.5, 1e-12) << each.label << ' ' << row.label;
      }
      gui.app().handle(Request(Edit{SetColliders{{changed}}}));
      gui.frames(1);
      EXPECT_EQ(collider(gui), changed) << each.label << ' ' << row.label;
      ++set;
    }
  }
  EXPECT_GE(set, 40);
}

TEST(Colliders, AMeshBecomesAnObstacleOfNailedPoints) {
  Placement placement;
  placement.is_mesh = placement.is_obstacle = true;
  TestSim sim;
  const PointId a = sim.add({0.0, 0.0, 0.0}), b = sim.add({1.0, 0.0, 0.0}), c = sim.add({0.0, 1.0, 0.0});
  sim.join(a, b, 1.0, 1.0);
  Scene mesh;
  mesh.system = sim.system;
  mesh.state = sim.state;
  mesh.system.faces.push_back({{a, b, c}});
  const Scene part = part_of(placement, &mesh, {0.0, 1.0, 0.0}, false);
  for (const Point& point : part.system.points()) EXPECT_TRUE(point.nailed);
  const auto contact = contact_of(placement, part, false);
  ASSERT_TRUE(contact);
  EXPECT_TRUE(contact->faces);
}

}  // namespace
}  // namespace hooke
