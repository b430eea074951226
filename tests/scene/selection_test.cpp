// The selection, and excerpts of a scene to be inserted again.
#include "scene/selection.h"

#include <gtest/gtest.h>

#include "edit/copy_selection.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "sim/model/bounding_box.h"
#include "support/apply_now.h"
#include "support/random_scene.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

// Two chains of three points, and a face from the end of the second to a separate point.
Scene two_chains() {
  TestSim sim;
  std::vector<PointId> points;
  for (int i = 0; i < 7; ++i) points.push_back(sim.add({0.1 * i, 0.0, 0.0}, 1.0, {0.0, 1.0 * i, 0.0}));
  for (const int i : {0, 1, 3, 4}) sim.join(points[i], points[i + 1], 10.0 + i, 0.1);
  Scene scene;
  scene.system = sim.system;
  scene.system.faces.push_back({{points[4], points[5], points[6]}});
  scene.system.point(1).color = Color{10, 20, 30};
  scene.system.spring(1)->break_strain = 0.25;
  scene.state = sim.state;
  return scene;
}

PointId point(int i) { return PointId{static_cast<std::uint32_t>(i)}; }
SpringId spring(int i) { return SpringId{static_cast<std::uint32_t>(i)}; }

TEST(Selection, ConnectedFollowsSpringsAndFaces) {
  const Scene scene = two_chains();
  const Selection first{{point(0), point(1), point(2)}, {spring(0), spring(1)}};
  const Selection second{{point(3), point(4), point(5), point(6)}, {spring(2), spring(3)}};
  EXPECT_EQ(select_connected(scene.system, {{point(1)}, {}}), first);
  EXPECT_EQ(select_connected(scene.system, {{}, {spring(1)}}), first);
  EXPECT_EQ(select_connected(scene.system, {{point(6)}, {}}), second);
  EXPECT_EQ(select_connected(scene.system, {{point(0), point(3)}, {}}), select_all(scene.system));
  EXPECT_EQ(select_connected(scene.system, {}), Selection{});
  EXPECT_EQ(select_connected(scene.system, {{point(99)}, {spring(99)}}), Selection{});
}

TEST(Selection, InvertedTwiceIsUnchanged) {
  const Scene scene = two_chains();
  const Selection some{{point(1), point(4)}, {spring(2)}};
  const Selection rest = invert_selection(scene.system, some);
  EXPECT_EQ(rest.points.size(), 5u);
  EXPECT_EQ(rest.springs.size(), 3u);
  EXPECT_EQ(invert_selection(scene.system, rest), some);
  EXPECT_EQ(invert_selection(scene.system, {}), select_all(scene.system));
}

Snapshot snapshot_of(const Scene& scene) {
  Snapshot snapshot;
  snapshot.system = std::make_shared<const System>(scene.system);
  snapshot.state = scene.state;
  return snapshot;
}

TEST(Excerpt, ContainsSpringsBetweenSelectedPointsAndEndsOfSelectedSprings) {
  const Snapshot snapshot = snapshot_of(two_chains());
  const Scene pair = copy_selection(snapshot, nullptr, {{point(0), point(1)}, {}});
  EXPECT_EQ(pair.system.point_count(), 2);
  EXPECT_EQ(pair.system.spring_count(), 1);
  const Scene of_spring = copy_selection(snapshot, nullptr, {{}, {spring(1)}});
  EXPECT_EQ(of_spring.system.point_count(), 2);
  ASSERT_EQ(of_spring.system.spring_count(), 1);
  EXPECT_EQ(of_spring.system.springs()[0].break_strain, 0.25);
  EXPECT_EQ(copy_selection(snapshot, nullptr, {{point(4), point(5), point(6)}, {}}).system.faces.size(), 1u);
  EXPECT_EQ(copy_selection(snapshot, nullptr, {{point(4), point(5)}, {}}).system.faces.size(), 0u);
}

// Written as text, inserted again, undone: the copies have all properties of the originals, and undo removes them completely.
TEST(Excerpt, IsReadBackFromItsTextBitForBit) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    Scene scene;
    const TestSim sim = random_sim(seed, 12, 30, 2 + seed % 2, 1.0);
    scene.system = sim.system;
    scene.state = sim.state;
    Lab lab(scene);
    const Snapshot& snapshot = *lab.status()->snapshot;
    const Selection all = select_all(scene.system);
    const Scene part = parse_scene(format_scene(copy_selection(snapshot, nullptr, all)), "clipboard").scene;
    lab.submit(Command(make_insert(part, Vec3(0.0), {[&] { return lab.new_point_id(); }, [&] { return lab.new_spring_id(); }})));
    apply_now(lab);
    const System& system = lab.scene().system;
    const Index points = scene.system.point_count(), springs = scene.system.spring_count();
    ASSERT_EQ(system.point_count(), 2 * points);
    ASSERT_EQ(system.spring_count(), 2 * springs);
    for (Index i = 0; i < points; ++i) {
      Point copy = system.points()[points + i];
      EXPECT_NE(copy.id, system.points()[i].id);
      copy.id = system.points()[i].id;
      EXPECT_EQ(copy, system.points()[i]) << "seed " << seed;
      EXPECT_EQ(lab.scene().state.position[points + i], lab.scene().state.position[i]);
      EXPECT_EQ(lab.scene().state.velocity[points + i], lab.scene().state.velocity[i]);
    }
    for (Index s = 0; s < springs; ++s) {
      const Spring &original = system.springs()[s], &copy = system.springs()[springs + s];
      EXPECT_EQ(system.index_of(copy.first), system.index_of(original.first) + points);
      EXPECT_EQ(system.index_of(copy.second), system.index_of(original.second) + points);
      EXPECT_EQ(copy.stiffness, original.stiffness);
      EXPECT_EQ(copy.rest_length, original.rest_length);
      EXPECT_EQ(copy.family, original.family);
    }
    lab.submit(Undo{});
    apply_now(lab);
    EXPECT_EQ(lab.scene().system, scene.system);
  }
}

TEST(Excerpt, IsInsertedAtItsDisplacementAndHasACenter) {
  const Scene part = copy_selection(snapshot_of(two_chains()), nullptr, {{point(0), point(2)}, {}});
  EXPECT_NEAR(bounding_box(part.state.position).center().x, 0.1, 1e-15);
  std::uint32_t next = 100;
  const Insert insert = make_insert(part, {0.0, 3.0, 0.0}, {[&] { return PointId{next++}; }, [&] { return SpringId{next++}; }});
  ASSERT_EQ(insert.points.size(), 2u);
  EXPECT_EQ(insert.points[1].position, (Vec3{0.2, 3.0, 0.0}));
  EXPECT_EQ(insert.points[1].velocity, (Vec3{0.0, 2.0, 0.0}));
}

}  // namespace
}  // namespace hooke
