// Ids and indices of points and springs.
#include <gtest/gtest.h>

#include "support/test_sim.h"

namespace hooke {
namespace {

// Points 0..3 and springs 0..2 between consecutive points.
TestSim chain() {
  TestSim sim;
  std::vector<PointId> points;
  for (int i = 0; i < 4; ++i) points.push_back(sim.add({i, 0.0, 0.0}));
  for (int i = 0; i < 3; ++i) sim.join(points[i], points[i + 1], 100.0, 1.0);
  return sim;
}

template <class Item>
std::vector<Item> without(std::vector<Item> list, Index at) {
  list.erase(list.begin() + at);
  return list;
}

void remove_point(System& system, Index at) { system.set_points(without(system.points(), at)); }
void remove_spring(System& system, Index at) { system.set_springs(without<Spring>(system.springs(), at)); }

TEST(System, GivesEveryPointAndSpringItsIndex) {
  const System system = chain().system;
  for (Index i = 0; i < 4; ++i) EXPECT_EQ(system.index_of(system.points()[i].id), i);
  for (Index s = 0; s < 3; ++s) EXPECT_EQ(system.index_of(system.springs()[s].id), s);
}

TEST(System, HasNoIndexForRemovedOrUnknownItems) {
  System system = chain().system;
  const PointId removed = system.points()[1].id;
  const SpringId removed_spring = system.springs()[2].id;
  remove_spring(system, 2);
  remove_spring(system, 1);
  remove_spring(system, 0);
  remove_point(system, 1);
  EXPECT_EQ(system.index_of(removed), no_index);
  EXPECT_EQ(system.index_of(removed_spring), no_index);
  EXPECT_EQ(system.index_of(PointId{77}), no_index);
  EXPECT_EQ(system.index_of(SpringId{77}), no_index);
}

TEST(System, ShiftsTheIndicesAfterARemoval) {
  System system = chain().system;
  const std::vector<Point> points = system.points();
  const std::vector<Spring> springs = system.springs();
  remove_spring(system, 0);
  EXPECT_EQ(system.index_of(springs[1].id), 0);
  EXPECT_EQ(system.index_of(springs[2].id), 1);
  remove_point(system, 0);
  EXPECT_EQ(system.index_of(points[1].id), 0);
  EXPECT_EQ(system.index_of(points[3].id), 2);
  EXPECT_EQ(system.point_count(), 3);
  EXPECT_EQ(system.spring_count(), 2);
}

TEST(System, IsTheSameAfterARemovalIsUndone) {
  const System original = chain().system;
  System system = original;
  const Point point = system.points()[2];
  const Spring spring = system.springs()[1];
  remove_spring(system, 1);
  remove_point(system, 2);
  EXPECT_NE(system, original);
  std::vector<Point> points = system.points();
  points.insert(points.begin() + 2, point);
  system.set_points(points);
  std::vector<Spring> springs = system.springs();
  springs.insert(springs.begin() + 1, spring);
  system.set_springs(springs);
  EXPECT_EQ(system, original);
}

TEST(System, NeverAssignsAnIdTwice) {
  System system = chain().system;
  const PointId last = system.points().back().id;
  remove_spring(system, 2);
  remove_point(system, 3);
  const PointId fresh = system.new_point_id();
  EXPECT_GT(fresh, last);
  EXPECT_NE(system.new_point_id(), fresh);

  // nor an id that came with an inserted point
  system.append_point({.id = PointId{41}});
  EXPECT_EQ(system.new_point_id(), PointId{42});
  EXPECT_EQ(system.index_of(PointId{41}), 3);
}

TEST(System, TreatsDampingAndDragAsZeroWhenSwitchedOff) {
  System system;
  system.drag = 3.0;
  const Spring spring{.damping = 2.0};
  EXPECT_EQ(system.drag_rate(), 3.0);
  EXPECT_EQ(system.damping_of(spring), 2.0);
  system.switches.drag = false;
  system.switches.dashpots = false;
  EXPECT_EQ(system.drag_rate(), 0.0);
  EXPECT_EQ(system.damping_of(spring), 0.0);
}

TEST(System, EqualsOneThatHasAssignedOtherIds) {
  const System system = chain().system;
  System other = system;
  other.new_point_id();
  other.new_spring_id();
  EXPECT_EQ(system, other);
}

TEST(System, DiffersWhenAnyPropertyDiffers) {
  const auto differs = [](auto change) {
    System changed = chain().system;
    change(changed);
    return !(changed == chain().system);
  };
  EXPECT_TRUE(differs([](System& system) { system.drag = 0.5; }));
  EXPECT_TRUE(differs([](System& system) { system.switches.families[1] = false; }));
  EXPECT_TRUE(differs([](System& system) { system.strain_limit = 0.1; }));
  EXPECT_TRUE(differs([](System& system) { system.faces.push_back({}); }));
  EXPECT_TRUE(differs([](System& system) { system.forces.emplace_back(); }));
  EXPECT_TRUE(differs([](System& system) { system.point(2).nailed = true; }));
  EXPECT_TRUE(differs([](System& system) { system.spring(1)->rest_length = 3.0; }));
  EXPECT_TRUE(differs([](System& system) { remove_spring(system, 2); }));
}

}  // namespace
}  // namespace hooke
