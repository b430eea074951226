// Loads on faces act on the points of a sheet in proportion to their masses: what is uniform accelerates all of it alike.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "formats/mesh/mesh_file.h"
#include "scene/shape.h"
#include "sim/forces/terms/rows.h"
#include "sim/methods/integrator.h"
#include "study/check/finer_network.h"
#include "support/parse_text.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double density = 0.2, normal_drag = 0.6, tangential_drag = 0.5;

Force wind(const Vec3& u) { return {.term = &wind_force, .values = {u.x, u.y, u.z, normal_drag, tangential_drag, 0.0, 1.0, 1.0}}; }

// A horizontal sheet of 1.2 m x 0.8 m.
Scene cloth(int columns, int rows) {
  return parse(
      R"({"hooke": 1, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1.2, 0, 0], "down": [0, 0, 0.8], "points": [)" +
      std::to_string(columns) + ", " + std::to_string(rows) + R"(], "density": 0.2, "sheet_stiffness": 60, "sheet_damping": 0.01}]})");
}

// A horizontal mesh of the same size: quads, of different widths, or triangles.
Scene mesh(int columns, int rows, bool has_quads) {
  std::string text;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const double s = static_cast<double>(i) / (columns - 1);
      text += "v " + std::to_string(1.2 * s * (0.5 + 0.5 * s)) + " 0 " + std::to_string(0.8 * j / (rows - 1)) + "\n";
    }
  const auto number = [&](int i, int j) { return " " + std::to_string(j * columns + i + 1); };
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const std::string a = number(i, j), b = number(i, j + 1), c = number(i + 1, j), d = number(i + 1, j + 1);
      text += has_quads ? "f" + a + b + d + c + "\n" : "f" + a + b + c + "\nf" + c + b + d + "\n";
    }
  Scene scene = parse_obj(text, "mesh.obj").scene;
  scene.system.colliders.clear();
  return scene;
}

// Without poles and hooks.
std::vector<bool> points_of_faces(const System& system) {
  std::vector<bool> result(static_cast<std::size_t>(system.point_count()), false);
  for (const Face& face : system.faces)
    for (const PointId id : face.points) result[static_cast<std::size_t>(system.index_of(id))] = true;
  return result;
}

Scene shape_of(const char* id) {
  Network network;
  generate(default_shape(*find_shape_kind(id)), network);
  Scene scene;
  for (Point& point : network.points) point.nailed = false;
  scene.system.set_points(network.points);
  scene.system.set_springs(network.springs);
  scene.system.faces = network.faces;
  scene.state.position = network.position;
  scene.state.velocity.assign(network.points.size(), Vec3(0.0));
  return scene;
}

// [m^2/kg], of the points of faces.
double area_per_mass(const Scene& scene) {
  const auto at = [&](PointId id) { return scene.state.position[static_cast<std::size_t>(scene.system.index_of(id))]; };
  const std::vector<bool> is_on_sheet = points_of_faces(scene.system);
  double mass = 0.0, area = 0.0;
  for (std::size_t i = 0; i < is_on_sheet.size(); ++i) mass += is_on_sheet[i] ? scene.system.points()[i].mass : 0.0;
  for (const Face& face : scene.system.faces)
    area += 0.5 * glm::length(glm::cross(at(face.points[1]) - at(face.points[0]), at(face.points[2]) - at(face.points[0])));
  return area / mass;
}

// All sheets that can be made, flat.
std::vector<Scene> sheets() {
  std::vector<Scene> scenes;
  for (const auto& [columns, rows] : {std::pair{2, 2}, {3, 5}, {9, 9}, {17, 4}, {33, 33}}) {
    scenes.push_back(cloth(columns, rows));
    scenes.push_back(mesh(columns, rows, true));
    scenes.push_back(mesh(columns, rows, false));
    scenes.push_back(parse_obj(format_obj(scenes[scenes.size() - 3]), "again.obj").scene);
    const Scene& coarse = scenes[scenes.size() - 4];
    if (auto finer = refine_network(coarse.system, coarse.state, 100'000)) {
      scenes.push_back(coarse);
      scenes.back().system = std::move(finer->system);
      scenes.back().state = std::move(finer->state);
    }
  }
  scenes.push_back(shape_of("sheet"));
  scenes.push_back(shape_of("flag"));
  return scenes;
}

// Of the wind alone.
std::vector<Vec3> accelerations(Scene& scene, const Vec3& u) {
  System& system = scene.system;
  system.forces = {wind(u)};
  const Plan plan = make_plan(system);
  Motion motion;
  pack(plan, scene.state, motion);
  Field f(motion.x.size(), 0.0);
  wind_force.add(plan, plan.forces[0].values, 0.0, motion.x.data(), motion.v.data(), f.data());
  std::vector<Vec3> result;
  for (Index i = 0; i < plan.points; ++i) result.push_back(plan.inverse_mass[i] * vector_at(plan, f.data(), i));
  return result;
}

void expect_uniform(Scene& scene, const Vec3& u, double expected) {
  const std::vector<Vec3> all = accelerations(scene, u);
  const std::vector<bool> is_on_sheet = points_of_faces(scene.system);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_on_sheet[i]) continue;
    const Vec3& a = all[i];
    ASSERT_NEAR(glm::distance(a, expected * glm::normalize(u)), 0.0, 2e-13 * expected)
        << scene.system.point_count() << " points, " << scene.system.faces.size() << " faces";
  }
}

TEST(SheetLoads, WindAcrossAFlatSheetAcceleratesAllOfItAlike) {
  for (Scene& scene : sheets()) {
    const auto& x = scene.state.position;
    const auto [a, b, c] = scene.system.faces[0].points;
    const auto at = [&](PointId id) { return x[static_cast<std::size_t>(scene.system.index_of(id))]; };
    const Vec3 normal = glm::normalize(glm::cross(at(b) - at(a), at(c) - at(a)));
    expect_uniform(scene, 3.0 * normal, normal_drag * 9.0 * area_per_mass(scene));
  }
}

TEST(SheetLoads, WindAlongABentSheetAcceleratesAllOfItAlike) {
  Scene pleated = shape_of("curtain");
  expect_uniform(pleated, {0.0, 3.0, 0.0}, tangential_drag * 9.0 * area_per_mass(pleated));
  for (const auto& [columns, rows] : {std::pair{2, 2}, {5, 3}, {12, 12}})
    for (Scene scene : {cloth(columns, rows), mesh(columns, rows, true), mesh(columns, rows, false)}) {
      // bent by one radian in all, between the columns; chords as long as the cells
      std::vector<Vec3> bent = scene.state.position;
      double angle = 0.0;
      for (int i = 1; i < columns; ++i) {
        const double length = scene.state.position[i].x - scene.state.position[i - 1].x;
        const Vec3 next = bent[i - 1] + length * Vec3(std::cos(angle), std::sin(angle), 0.0);
        for (int j = 0; j < rows; ++j) {
          bent[j * columns + i].x = next.x;
          bent[j * columns + i].y = next.y;
        }
        angle += 1.0 / columns;
      }
      scene.state.position = bent;
      expect_uniform(scene, {0.0, 0.0, 3.0}, tangential_drag * 9.0 / density);
    }
}

// v' = g - a v^2 / density; after 4 s, v = sqrt(g density / a) to 1e-18.
TEST(SheetLoads, AFallingSheetStaysFlatAndReachesItsTerminalSpeed) {
  for (const auto& [n, method] : {std::pair(33, "velocity_verlet"), std::pair(9, "implicit_midpoint")}) {
    Scene scene = cloth(n, n);
    scene.system.forces = {wind({0.0, 0.0, 0.0})};
    TestSim sim{scene.system, scene.state};
    sim.run(*find_integrator(method), 4.0, 4000);
    const double y = sim.state.position[0].y;
    for (std::size_t i = 0; i < sim.state.position.size(); ++i) {
      ASSERT_NEAR(sim.state.velocity[i].y, -std::sqrt(9.81 * density / normal_drag), 1e-9) << method << ' ' << n;
      ASSERT_NEAR(sim.state.position[i].y, y, 1e-9) << method << ' ' << n;
    }
  }
}

// A closed box of quads: the pressure on each of its flat sides acts on the points in it in proportion to their shares of its area.
TEST(SheetLoads, PressureDoesNotDependOnTheDiagonalsOfQuads) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
  Scene scene = parse_obj(vertices + "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n", "box.obj").scene;
  scene.system.forces = {{.term = &pressure_force, .values = {100.0, 0.0, 0.0, 0.0, 0.0}}};
  const Plan plan = make_plan(scene.system);
  Motion motion;
  pack(plan, scene.state, motion);
  Field f(motion.x.size(), 0.0);
  pressure_force.add(plan, plan.forces[0].values, 0.0, motion.x.data(), motion.v.data(), f.data());
  for (Index i = 0; i < 8; ++i) {
    const Vec3 outwards = 2.0 * vector_at(plan, motion.x.data(), i) - Vec3(1.0);
    EXPECT_NEAR(glm::distance(vector_at(plan, f.data(), i), 25.0 * outwards), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace hooke
