// Meshes from files: conversion to cloth, repairs, refusals; and scenes written as meshes.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <glm/geometric.hpp>

#include "formats/mesh/mesh_cloth.h"
#include "formats/mesh/mesh_file.h"
#include "formats/mesh/weld_vertices.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/integrator.h"
#include "sim/step/divergence.h"
#include "sim/step/step.h"

namespace hooke {
namespace {

LoadedScene load(const std::string& text) { return parse_obj(text, "test.obj"); }

std::string refusal(const std::string& text) {
  try {
    load(text);
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "not refused";
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

// columns x rows quads of side `a` [m], in the plane z = 0.
std::string grid(int columns, int rows, double a) {
  std::string text;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) text += "v " + std::to_string(a * column) + " " + std::to_string(-a * row) + " 0\n";
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int corner = row * (columns + 1) + column + 1;
      for (const int i : {corner, corner + columns + 1, corner + columns + 2, corner + 1})
        text += (i == corner ? "f " : " ") + std::to_string(i);
      text += "\n";
    }
  return text;
}

// Rows of equilateral triangles of side 1 m.
std::string equilateral(int columns, int rows) {
  std::string text;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      text += "v " + std::to_string(column + 0.5 * row) + " " + std::to_string(std::sqrt(0.75) * row) + " 0\n";
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const int a = row * (columns + 1) + column + 1, b = a + columns + 1;
      text += "f " + std::to_string(a) + " " + std::to_string(a + 1) + " " + std::to_string(b) + "\n";
      text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(b) + "\n";
    }
  return text;
}

double total_mass(const System& system) {
  double sum = 0.0;
  for (const Point& point : system.points()) sum += point.mass;
  return sum;
}

Spring spring_between(const System& system, Index i, Index j) {
  for (const Spring& spring : system.springs())
    if (system.index_of(spring.first) == i && system.index_of(spring.second) == j) return spring;
  throw std::logic_error("no such spring");
}

TEST(Mesh, AQuadBecomesFourSidesTwoDiagonalsAndTwoFaces) {
  const LoadedScene loaded = load(grid(1, 1, 0.5));
  EXPECT_TRUE(loaded.warnings.empty());
  const System& system = loaded.scene.system;
  EXPECT_EQ(loaded.scene.name, "test");
  EXPECT_EQ(system.point_count(), 4);
  EXPECT_EQ(system.spring_count(), 6);
  EXPECT_EQ(system.faces.size(), 2u);
  EXPECT_NEAR(total_mass(system), SheetMaterial().density * 0.25, 1e-15);
  for (const Spring& spring : system.springs()) EXPECT_NEAR(strain(system, loaded.scene.state, spring), 0.0, 1e-15);
}

TEST(Mesh, AGridOfQuadsEqualsTheIsotropicSheet) {
  const LoadedScene loaded = load(grid(2, 2, 0.5));
  const System& system = loaded.scene.system;
  const SheetMaterial material = cloth_of_size(std::sqrt(2.0));
  EXPECT_NEAR(spring_between(system, 0, 1).stiffness, 0.375 * material.stiffness, 1e-9);  // on the border
  EXPECT_NEAR(spring_between(system, 1, 4).stiffness, 0.75 * material.stiffness, 1e-9);   // inside
  EXPECT_NEAR(spring_between(system, 0, 4).stiffness, 0.375 * material.stiffness, 1e-9);  // diagonal
  EXPECT_NEAR(spring_between(system, 1, 4).damping, 0.75 * material.damping, 1e-9);
  EXPECT_NEAR(system.points()[0].mass, 0.25 * 0.25 * material.density, 1e-12);
  EXPECT_NEAR(system.points()[1].mass, 0.50 * 0.25 * material.density, 1e-12);
  EXPECT_NEAR(system.points()[4].mass, 1.00 * 0.25 * material.density, 1e-12);
}

// Stretched by s in one direction and fixed in the other, a sheet of Poisson's ratio 1/3 stores E t / (1 - 1/9) s^2 / 2 of energy per
// square meter, for any triangulation and direction.
TEST(Mesh, StretchedStoresTheEnergyOfTheMaterial) {
  for (const auto& [text, area] : {std::pair(grid(5, 4, 0.5), 5.0), std::pair(equilateral(6, 5), 60 * std::sqrt(0.1875))})
    for (const double angle : {0.0, 0.3, 1.1}) {
      Scene scene = load(text).scene;
      Vec3 min = scene.state.position[0], max = min;
      for (const Vec3& x : scene.state.position) {
        min = glm::min(min, x);
        max = glm::max(max, x);
      }
      const double s = 1e-6;
      const Vec3 along(std::cos(angle), std::sin(angle), 0.0);
      for (Vec3& x : scene.state.position) x += s * glm::dot(x, along) * along;
      const double expected = 0.5 * cloth_of_size(glm::distance(min, max)).stiffness * s * s * area * 9.0 / 8.0;
      EXPECT_NEAR(compute_energy(scene.system, scene.state).elastic / expected, 1.0, 1e-5) << area << " m^2, " << angle;
    }
}

TEST(Mesh, WithDefaultSettingsFallsAndLiesOnTheFloor) {
  Scene scene = load(grid(8, 8, 0.1)).scene;
  EXPECT_LT(scene.settings.substep(), largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system)));
  initialize_supply(scene.system, scene.state);
  Plan plan = make_plan(scene.system);
  Frame frame;
  for (int i = 0; i < 120; ++i) {
    frame.begin(plan, scene.system, scene.settings, scene.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, scene.state);
  }
  EXPECT_FALSE(find_divergence(scene.system, scene.state, compute_energy(scene.system, scene.state)));
  const double floor = std::get<Plane>(scene.system.colliders.at(0).shape).point.y;
  for (const Vec3& x : scene.state.position) EXPECT_GE(x.y, floor);
}

TEST(Mesh, TheSameShapeAtAnySizeMovesSimilarly) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const Scene scene = load(grid(4, 4, size / 4)).scene;
    // periods scale with the square root of the size
    EXPECT_NEAR(bound_spectrum(scene.system).omega * std::sqrt(size), bound_spectrum(load(grid(4, 4, 0.25)).scene.system).omega, 1e-6)
        << size;
  }
}

TEST(Mesh, CoincidentVerticesAreWelded) {
  // two triangles with a common edge but separate vertices; one vertex differs in the last printed digit
  const LoadedScene loaded = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1.000001 0\nf 1 2 3\nf 4 5 6\n");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"test.obj: 2 vertices are at the position of another: welded"});
  EXPECT_EQ(loaded.scene.system.point_count(), 4);
  EXPECT_EQ(loaded.scene.system.spring_count(), 5);
}

TEST(Mesh, WeldingIsLocalAndDoesNotMergeChains) {
  const double d = 1.0;
  EXPECT_EQ(weld(std::vector<Vec3>{}, d), std::vector<Index>{});
  // a row of vertices spaced by less than d: each is merged with the first one kept, not along the row
  const std::vector<Vec3> row{Vec3(0.0), Vec3(0.9, 0, 0), Vec3(1.8, 0, 0), Vec3(2.7, 0, 0)};
  EXPECT_EQ(weld(row, d), (std::vector<Index>{0, 0, 2, 2}));
  // at the faces of the cells of the search grid, and all at one position
  for (const double at : {-4.0, 0.0, 3.9999999, 4.0, 123456.0}) {
    const std::vector<Vec3> pair{Vec3(at - 0.49, at, at), Vec3(at + 0.49, at, at), Vec3(at + 1.5, at, at)};
    EXPECT_EQ(weld(pair, d), (std::vector<Index>{0, 0, 2})) << at;
  }
  EXPECT_EQ(weld(std::vector<Vec3>(1000, Vec3(7.0)), d), std::vector<Index>(1000, 0));
  EXPECT_EQ(weld(std::vector<Vec3>(3, Vec3(7.0)), 0.0), std::vector<Index>(3, 0));
}

TEST(Mesh, FacesWithoutAreaAreIgnoredAndReported) {
  const LoadedScene loaded = load(triangle + "v 2 0 0\nf 1 2 4\nf 1 1 2\nf 1 2\nf 3 2 1 3\nf 1 2 1 3\n");
  EXPECT_EQ(loaded.warnings, (std::vector<std::string>{
                                 "test.obj: 4 faces have no area: ignored",
                                 "test.obj: 1 face is a duplicate: ignored",
                                 "test.obj: 1 vertex belongs to no face or line: ignored",
                             }));
  EXPECT_EQ(loaded.scene.system.faces.size(), 1u);
  EXPECT_EQ(loaded.scene.system.spring_count(), 3);
}

TEST(Mesh, AnEdgeOfThreeFacesIsOneSpringAndReported) {
  const LoadedScene loaded = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"test.obj: 1 edge has more than two faces: each is a single spring"});
  EXPECT_EQ(loaded.scene.system.spring_count(), 7);
  EXPECT_EQ(loaded.scene.system.faces.size(), 3u);
}

TEST(Mesh, ABentQuadIsSplitWhereBothTrianglesHaveTheSameOrientation) {
  // an arrow head, starting at two of its corners: the shorter diagonal, between its wings, is outside
  for (const char* corners : {"1 2 3 4", "2 3 4 1"}) {
    const LoadedScene arrow = load(std::string("v 0 0 0\nv 1 -1 0\nv 0 3 0\nv -1 -1 0\nf ") + corners);
    EXPECT_NEAR(total_mass(arrow.scene.system), SheetMaterial().density * 3.0, 1e-12);
    for (const Face& face : arrow.scene.system.faces) {
      const auto x = [&](std::size_t i) { return arrow.scene.state.position[static_cast<std::size_t>(face.points[i])]; };
      EXPECT_GT(glm::cross(x(1) - x(0), x(2) - x(0)).z, 0.0);
    }
  }
  // folded like a book: both triangles have mass
  EXPECT_NEAR(total_mass(load("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1 0.001 0\nf 1 2 3 4\n").scene.system), 0.2 * (0.5 + 0.4995), 0.2 * 0.002);
}

TEST(Mesh, APolygonWithManyCornersIsSplitIntoTriangles) {
  const LoadedScene loaded = load("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(loaded.warnings, std::vector<std::string>{"test.obj: 1 face has more than four corners: split into triangles"});
  EXPECT_EQ(loaded.scene.system.faces.size(), 3u);
  EXPECT_NEAR(total_mass(loaded.scene.system), SheetMaterial().density * 5.0, 1e-12);
}

TEST(Mesh, AllVariantsOfTheSyntaxAreRead) {
  const LoadedScene loaded = load(
      "# a comment\r\nmtllib /etc/passwd\r\no thing\r\n  v\t+0 0.0 0e0 1.0\r\nv 1. 0 0 0.5 0.5 0.5\nv 0 1 \\\n0\rv .5 .5 -1e-3\nvt 0 0\nvn "
      "0 0 1\n"
      "usemtl cloth\ns off\ng a b\nf 1/1/1 2/1 4//1 3/1/ # a comment \\\n");
  EXPECT_TRUE(loaded.warnings.empty());
}

TEST(Mesh, NegativeNumbersCountBackwardsAndFacesMayComeFirst) {
  EXPECT_EQ(load("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n").scene.system.point_count(), 3);
  EXPECT_EQ(load("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").scene.system.point_count(), 3);
}

TEST(Mesh, OtherStatementsAreReported) {
  EXPECT_EQ(load(triangle + "curv 1 2\n").warnings,
            std::vector<std::string>{"test.obj: line 5: \"curv\": is ignored: only vertices, faces, lines and points are read"});
  EXPECT_EQ(load("call other.obj\n" + triangle + "t x 8192/8192/8192\ncurv 1 2\n").warnings,
            std::vector<std::string>{"test.obj: line 1: \"call\": and 2 more statements are ignored: only vertices, "
                                     "faces, lines and points are read"});
}

TEST(Mesh, InvalidFilesAreRefusedWithTheLine) {
  EXPECT_EQ(refusal(""), "test.obj: faces and lines: none: there must be at least one");
  EXPECT_EQ(refusal("\x7f"
                    "ELF\x01\x02"),
            "test.obj: faces and lines: none: there must be at least one");
  EXPECT_EQ(refusal("v 0 0 0\nv 0 nan 0\n"), "test.obj: line 2: v: \"nan\": must be a number");
  EXPECT_EQ(refusal("v 0 inf 0\n"), "test.obj: line 1: v: \"inf\": must be a number");
  EXPECT_EQ(refusal("v 0 1e400 0\n"), "test.obj: line 1: v: \"1e400\": must be a number");
  EXPECT_EQ(refusal("v 0 1e10 0\n"), "test.obj: line 1: v: 1e+10: must be from -1e9 to 1e9 (meters)");
  EXPECT_EQ(refusal(triangle + "l 1 4\n"), "test.obj: line 5: l: 4: there are only 3 vertices");
  EXPECT_EQ(refusal(triangle + "p -4\n"), "test.obj: line 5: p: -4: there are only 3 vertices");
  EXPECT_EQ(refusal("v 1 2\n"), "test.obj: line 1: v: 2 numbers: must be at least 3");
  EXPECT_EQ(refusal("v 1 2 three\n"), "test.obj: line 1: v: \"three\": must be a number");
  EXPECT_EQ(refusal(std::string("v 1 2 3\0\n", 9)), "test.obj: line 1: v: \"3\\u0000\": must be a number");
  EXPECT_EQ(refusal(triangle + "f 1 2 0\n"), "test.obj: line 5: f: \"0\": must be the number of a vertex");
  EXPECT_EQ(refusal(triangle + "f 1 2 x\n"), "test.obj: line 5: f: \"x\": must be the number of a vertex");
  EXPECT_EQ(refusal(triangle + "f 1 2 3/x\n"), "test.obj: line 5: f: \"3/x\": must be the number of a vertex");
  EXPECT_EQ(refusal(triangle + "f 1 2 99999999999\n"), "test.obj: line 5: f: \"99999999999\": must be the number of a vertex");
  EXPECT_EQ(refusal(triangle + "v 1 1 1 nan\nv 1 1 nan\n"), "test.obj: line 6: v: \"nan\": must be a number");
  EXPECT_EQ(refusal(triangle + "f 1 2 4\n"), "test.obj: line 5: f: 4: there are only 3 vertices");
  EXPECT_EQ(refusal(triangle + "f 1 2 2147483647\n"), "test.obj: line 5: f: 2147483647: there are only 3 vertices");
  EXPECT_EQ(refusal(triangle + "f 1 2 -4\n"), "test.obj: line 5: f: -4: there are only 3 vertices");
  std::string many = "f";
  for (int i = 0; i < 1001; ++i) many += " 1";
  EXPECT_EQ(refusal(triangle + many + "\n"), "test.obj: line 5: f: more than 1000 corners: too many");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "test.obj: faces: none has an area: there must be at least one");
  EXPECT_EQ(refusal("v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"), "test.obj: size: 0 m: must be at least 1e-06");
}

TEST(Mesh, CanBeWrittenAsObjAndReadBack) {
  const Scene scene = load(grid(3, 2, 0.3)).scene;
  const Scene again = load(format_obj(scene)).scene;
  ASSERT_EQ(again.system.point_count(), scene.system.point_count());
  for (std::size_t i = 0; i < scene.state.position.size(); ++i) EXPECT_EQ(again.state.position[i], scene.state.position[i]);
  EXPECT_EQ(again.system.faces, scene.system.faces);
}

TEST(Mesh, ObjContainsFacesAndSpringsOutsideThem) {
  Scene scene = load(triangle).scene;
  const PointId end = scene.system.new_point_id();
  scene.system.append_point({.id = end});
  scene.state.position.emplace_back(0.1, -2.0, 1.0 / 3.0);
  scene.state.velocity.emplace_back(0.0);
  scene.system.append_spring({.id = scene.system.new_spring_id(), .first = scene.system.points()[0].id, .second = end});
  EXPECT_EQ(format_obj(scene),
            "# written by Hooke; meters\no test\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.1 -2 0.3333333333333333\nf 1 2 3\nl 1 4\n");
}

TEST(Mesh, PlyContainsTheStrainOfEachVertexByteForByte) {
  Scene scene = load(triangle).scene;
  for (Vec3& x : scene.state.position) x *= 1.25;
  const std::string bytes = format_ply(scene);
  const std::string end = "end_header\n";
  const std::size_t begin = bytes.find(end) + end.size();
  EXPECT_EQ(bytes.substr(0, begin),
            "ply\nformat binary_little_endian 1.0\n"
            "comment written by Hooke; meters; strain: mean l / l0 - 1 of the springs at the vertex\n"
            "element vertex 3\nproperty double x\nproperty double y\nproperty double z\nproperty float strain\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n");
  std::string expected;
  const auto put = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    expected.append(raw, sizeof raw);
  };
  for (const Vec3& x : scene.state.position) {
    for (int c = 0; c < 3; ++c) put(x[c]);
    put(0.25f);
  }
  put(std::uint8_t{3});
  for (const std::int32_t i : {0, 1, 2}) put(i);
  EXPECT_EQ(bytes.substr(begin), expected);
}

TEST(Mesh, StrainAtAPointIsTheMeanOverItsSprings) {
  Scene scene;
  for (const double x : {0.0, 1.0, 3.0, 3.0}) {
    scene.system.append_point({.id = scene.system.new_point_id()});
    scene.state.position.emplace_back(x, 0.0, 0.0);
    scene.state.velocity.emplace_back(0.0);
  }
  const auto join = [&](std::size_t i, std::size_t j, double rest_length) {
    scene.system.append_spring({.id = scene.system.new_spring_id(),
                                .first = scene.system.points()[i].id,
                                .second = scene.system.points()[j].id,
                                .rest_length = rest_length});
  };
  join(0, 1, 0.5);  // +1
  join(1, 2, 4.0);  // -0.5
  join(0, 2, 0.0);  // no strain is defined
  EXPECT_EQ(strain_of_points(scene), (std::vector<double>{1.0, 0.25, -0.5, 0.0}));
}

}  // namespace
}  // namespace hooke
