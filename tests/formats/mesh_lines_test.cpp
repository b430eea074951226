// Lines, lone vertices, seams and units of meshes, and scenes that are written as .obj and read back.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "formats/mesh/mesh_file.h"
#include "formats/mesh/weld_vertices.h"
#include "formats/open_file.h"
#include "scene/shape.h"

namespace hooke {
namespace {

LoadedScene load_lines(const std::string& text, const ImportOptions& options = {}) { return parse_obj(text, "test.obj", options); }

double mass_of_all(const System& system) {
  double sum = 0.0;
  for (const Point& point : system.points()) sum += point.mass;
  return sum;
}

double floor_of(const Scene& scene) { return std::get<Plane>(scene.system.colliders.at(0).shape).point.y; }

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TEST(Mesh, AConcavePolygonHasTheMassOfItsArea) {
  for (const char* corners : {"1 2 3 4 5", "4 5 1 2 3", "5 4 3 2 1"})
    EXPECT_NEAR(mass_of_all(load_lines(std::string("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf ") + corners).scene.system), 2.0, 2e-12);
  std::string tangle, face = "f";
  for (int i = 0; i < 40; ++i) {
    tangle += "v " + std::to_string(i * 7 % 41) + " " + std::to_string(i * i * 5 % 37) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  EXPECT_EQ(load_lines(tangle + face).warnings.at(1), "test.obj: 1 face crosses itself: the area is not that of the outline");
}

TEST(Mesh, ColorsMayBeAnythingAndABlankMayFollowABackslash) {
  const LoadedScene loaded = load_lines("v 0 0 0 nan nan nan\nv 1 0 0 inf\nv 0 1 \\ \n0 0.5 0.5 0.5\nf 1 2 \\\t\n 3\n");
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.scene.system.faces.size(), 1u);
}

TEST(Mesh, AVertexWithoutAFaceChangesNothing) {
  const Scene scene = load_lines(square).scene, with = load_lines(square + "v 1e4 0 0\nv 0.5 -3000 0\n").scene;
  EXPECT_EQ(with.system, scene.system);
  EXPECT_EQ(with.state, scene.state);
  EXPECT_NEAR(floor_of(with), -0.25 * std::sqrt(2.0), 1e-12);
  // also one of a face without area
  EXPECT_EQ(load_lines(square + "v 1e4 0 0\nf 1 5 5\n").scene.system, scene.system);
}

TEST(Mesh, ARopeOfLinesStretchesByOnePercentUnderItsWeight) {
  const LoadedScene loaded = load_lines("v 0 0 0\nv 0 -1 0\nv 0 -2 0\nv 0 -4 0\nl 1 2 3\nl 3 4\nl 4 3\nl 2 2\n");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"test.obj: 2 lines are duplicates or have no length: ignored"});
  const System& system = loaded.scene.system;
  ASSERT_EQ(system.spring_count(), 3);
  EXPECT_TRUE(system.faces.empty());
  // a strip of cloth, a tenth of the size wide
  const double density = 0.2 * 0.4, tension = density * 4.0 * 9.81;
  EXPECT_NEAR(mass_of_all(system), density * 4.0, 1e-12);
  for (const Spring& spring : system.springs()) EXPECT_NEAR(tension / spring.stiffness, 0.01 * spring.rest_length, 1e-12);
  EXPECT_TRUE(loaded.scene.view.springs);
}

TEST(Mesh, LinesTieClothsTogether) {
  const Scene scene = load_lines(square + "v 0 2 0\nv 1 2 0\nv 1 3 0\nf 5 6 7\nl 4 5\nl 3 6\nl 1 3\nl 1 2\n").scene;
  // a line along a diagonal or a side adds to its spring
  EXPECT_EQ(scene.system.spring_count(), 6 + 3 + 2);
  EXPECT_GT(mass_of_all(scene.system), 0.2 * 1.5 + 1e-3);
}

TEST(Mesh, ASpringBetweenPointsOfTwoFacesIsWrittenAsALine) {
  Scene scene = load_lines("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 3 1 0\nf 1 2 3\nf 4 5 6\n").scene;
  const PointId first = scene.system.points()[1].id, second = scene.system.points()[3].id;
  scene.system.append_spring({.id = scene.system.new_spring_id(), .first = first, .second = second, .stiffness = 10.0, .rest_length = 2.0});
  EXPECT_NE(format_obj(scene).find("\nl 2 4\n"), std::string::npos) << format_obj(scene);
}

TEST(Mesh, AlmostCoincidentEdgesAreReportedAndWeldedOnDemand) {
  // two squares, the second 0.005 mm away from the first
  const std::string seam = square + "v 1.000005 0 0\nv 2 0 0\nv 2 1 0\nv 1.000005 1 0\nf 5 6 7 8\n";
  EXPECT_EQ(load_lines(seam).warnings,
            std::vector<std::string>{"test.obj: 2 points on open edges are within 0.05 mm of others: not joined (--weld 5e-05)"});
  ImportOptions options;
  options.seam_distance = 1e-5;
  const LoadedScene joined = load_lines(seam, options);
  EXPECT_EQ(joined.warnings, std::vector<std::string>{"test.obj: 2 vertices are at the position of another: welded"});
  EXPECT_EQ(joined.scene.system.point_count(), 6);
  // inner points are not joined, however close
  options.seam_distance = 0.6;
  EXPECT_EQ(
      load_lines("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n", options).scene.system.point_count(),
      5);
}

TEST(Mesh, PointsOnTheEdgeOfAnotherFaceAreCounted) {
  EXPECT_EQ(load_lines(square + "v 1 0.5 0\nv 2 0.5 0\nv 2 1 0\nf 5 6 7 3\n").warnings,
            std::vector<std::string>{"test.obj: 1 point lies on an open edge between its ends: not joined"});
}

TEST(Mesh, ASheetOfMoreThanFiftyMetersAsksForItsUnit) {
  const std::string large = "v 0 0 0\nv 1000 0 0\nv 0 0 500\nf 1 2 3\n";
  const LoadedScene loaded = load_lines(large);
  EXPECT_EQ(loaded.warnings.at(0), "test.obj: size: 1000 x 0 x 500 m: millimeters? (--scale 0.001)");
  EXPECT_EQ(loaded.summary, "test.obj: 1000 x 0 x 500 m, 3 points");
  ImportOptions options{.scale = 0.001, .is_z_up = true};
  EXPECT_EQ(load_lines(large, options).scene.state.position, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}}));
  options.scale = 1e9;
  EXPECT_THROW(load_lines(large, options), InputError);
}

TEST(Mesh, WeldingNeedsNoBoundOnTheExtent) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 1000; ++i) positions.emplace_back(1e6 * i, -1e6 * i, 0.0);
  positions.push_back(positions[500] + Vec3(5e-4, 0.0, 0.0));
  const std::vector<Index> welded_to = weld(positions, 1e-3);
  EXPECT_EQ(welded_to.back(), 500);
  EXPECT_EQ(welded_to[499], 499);
}

// The lines of a file without its name.
std::string elements_of(const Scene& scene) {
  const std::string text = format_obj(scene);
  return text.substr(text.find("\nv "));
}

bool has_coincident_points(const Scene& scene) {
  Vec3 min = scene.state.position[0], max = min;
  for (const Vec3& x : scene.state.position) min = glm::min(min, x), max = glm::max(max, x);
  const std::vector<Index> welded_to = weld(scene.state.position, 1e-6 * glm::distance(min, max));
  for (std::size_t i = 0; i < welded_to.size(); ++i)
    if (welded_to[i] != static_cast<Index>(i)) return true;
  return min == max;
}

TEST(Mesh, WhatIsWrittenIsReadBack) {
  std::vector<Scene> scenes;
  for (const ShapeKind& kind : shape_kinds()) {
    Network network;
    generate(default_shape(kind), network);
    Scene scene;
    scene.system.set_points(std::move(network.points));
    scene.system.set_springs(std::move(network.springs));
    scene.system.faces = std::move(network.faces);
    scene.state.position = std::move(network.position);
    scene.state.velocity = std::move(network.velocity);
    scene.name = kind.id;
    scenes.push_back(std::move(scene));
  }
  for (const ShippedScene& shipped : shipped_scenes())
    if (Scene scene = load_scene(shipped.file).scene; scene.system.point_count() < 5000) scenes.push_back(std::move(scene));
  int checked = 0;
  for (const Scene& scene : scenes) {
    if (scene.state.position.empty() || has_coincident_points(scene)) continue;
    const Scene again = load_lines(format_obj(scene)).scene;
    EXPECT_EQ(again.state.position, scene.state.position) << scene.name;
    EXPECT_EQ(again.system.faces.size(), scene.system.faces.size()) << scene.name;
    EXPECT_EQ(elements_of(again), elements_of(scene)) << scene.name;
    ++checked;
  }
  EXPECT_GT(checked, 20);
}

}  // namespace
}  // namespace hooke
