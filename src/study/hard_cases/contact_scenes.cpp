#include "study/hard_cases/contact_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "study/hard_cases/monitored_run.h"

namespace hooke {
namespace {

using std::numbers::pi;

// A grid of points with springs right, down and, of half the stiffness, along both diagonals, and two faces per cell.
struct PlainCloth {
  int rows, columns;
  double width = 1.0, height = 1.0;      // [m], at rest
  double mass = 0.2, stiffness = 300.0;  // [kg], [N/m]
  bool is_tube = false;                  // whether the last column is next to the first
};

// Adds it; place(u, v) and velocity(u, v) of the point at u m to the right and v m below the first one at rest. Returns the points.
template <class Place, class Velocity>
std::vector<PointId> add_cloth(TestNetwork& network, const PlainCloth& cloth, const Place& place, const Velocity& velocity) {
  const double across = cloth.width / (cloth.is_tube ? cloth.columns : cloth.columns - 1), down = cloth.height / (cloth.rows - 1);
  const double diagonal = std::hypot(across, down), mass = cloth.mass / (cloth.rows * cloth.columns);
  std::vector<PointId> ids;
  for (int row = 0; row < cloth.rows; ++row)
    for (int column = 0; column < cloth.columns; ++column) {
      const double u = across * column, v = down * row;
      ids.push_back(network.add(place(u, v), mass, velocity(u, v)));
    }
  const auto at = [&](int row, int column) { return ids[row * cloth.columns + column % cloth.columns]; };
  for (int row = 0; row < cloth.rows; ++row)
    for (int column = 0; column < cloth.columns; ++column) {
      const bool has_right = cloth.is_tube || column + 1 < cloth.columns, has_below = row + 1 < cloth.rows;
      if (has_right) network.join(at(row, column), at(row, column + 1), cloth.stiffness, across);
      if (has_below) network.join(at(row, column), at(row + 1, column), cloth.stiffness, down);
      if (!has_right || !has_below) continue;
      network.join(at(row, column), at(row + 1, column + 1), 0.5 * cloth.stiffness, diagonal);
      network.join(at(row, column + 1), at(row + 1, column), 0.5 * cloth.stiffness, diagonal);
      network.system.faces.push_back({{at(row, column), at(row + 1, column), at(row, column + 1)}});
      network.system.faces.push_back({{at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)}});
    }
  return ids;
}

Vec3 no_velocity(double, double) { return Vec3(0.0); }

Collider floor_at(double height) { return {.shape = Plane{{0.0, height, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.0, .friction = 0.3}; }

// Folds what is beyond x = at upwards and back: the layers below `top` come to lie above it in reverse order. Those on the fold itself bend
// around each other.
Vec3 fold(Vec3 place, double at, double top) {
  constexpr double bend = 0.3, tolerance = 1e-9;
  const double depth = top - place.y, beyond = place.x - at;
  if (beyond < -tolerance) return place;
  if (beyond > tolerance) return {at - beyond, top + depth, place.z};
  return {at + bend * depth, top, place.z};
}

// Walls of a box: planes on all sides of the origin but the upper one.
std::vector<Collider> make_bin(double half_width, double restitution, double friction) {
  std::vector<Collider> planes;
  for (const auto& [point, normal] :
       {std::pair(Vec3(0.0), Vec3(0.0, 1.0, 0.0)), std::pair(Vec3(-half_width, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)),
        std::pair(Vec3(half_width, 0.0, 0.0), Vec3(-1.0, 0.0, 0.0)), std::pair(Vec3(0.0, 0.0, -half_width), Vec3(0.0, 0.0, 1.0)),
        std::pair(Vec3(0.0, 0.0, half_width), Vec3(0.0, 0.0, -1.0))})
    planes.push_back({.shape = Plane{point, normal}, .restitution = restitution, .friction = friction});
  return planes;
}

}  // namespace

ContactScene make_folded_cloth() {
  ContactScene scene{.seconds = 0.6};
  System& system = scene.network.system;
  constexpr double gap = 0.006, drop = 0.3;  // [m], between layers, and below the lowest
  const auto place = [&](double u, double v) {
    Vec3 x = fold({u, 0.0, v}, 0.5, 0.5 * gap);
    x = fold(x, 0.25, 1.5 * gap);
    x = fold(x, 0.125, 3.5 * gap);
    return Vec3(x.x, x.y + drop, x.z);
  };
  add_cloth(scene.network, {.rows = 13, .columns = 25}, place, no_velocity);
  system.colliders = {floor_at(0.0)};
  system.contact = {.faces = true, .thickness = 0.004};
  return scene;
}

ContactScene make_crossing_cloths() {
  ContactScene scene{.seconds = 0.3};
  System& system = scene.network.system;
  system.gravity = Vec3(0.0);
  const PlainCloth cloth{.rows = 13, .columns = 13};
  add_cloth(
      scene.network, cloth, [](double u, double v) { return Vec3(u - 0.5, v - 0.5, -0.1); },
      [](double, double) { return Vec3(0.0, 0.0, 10.0); });
  add_cloth(
      scene.network, cloth,
      [](double u, double v) { return Vec3(0.8 * (u - 0.5) + 0.6 * (v - 0.5) + 0.1, 0.8 * (v - 0.5) - 0.6 * (u - 0.5), 0.1 + 0.6 * u); },
      [](double, double) { return Vec3(0.0, 0.0, -10.0); });
  system.contact = {.faces = true, .thickness = 0.004};
  return scene;
}

ContactScene make_twisted_tube() {
  ContactScene scene{.seconds = 0.6, .release_time = 0.3};
  System& system = scene.network.system;
  constexpr int around = 12, along = 41;
  constexpr double radius = 0.06, length = 1.0, turns = 4.0;
  const std::vector<PointId> points = add_cloth(
      scene.network, {.rows = along, .columns = around, .width = 2.0 * pi * radius, .height = length, .is_tube = true},
      [](double u, double v) {
        const double angle = u / radius + 2.0 * pi * turns * v / length;
        return Vec3(radius * std::cos(angle), -v, radius * std::sin(angle));
      },
      no_velocity);
  for (int i = 0; i < around; ++i) {
    const PointId lower = points[(along - 1) * around + i];
    for (const PointId id : {points[i], lower}) system.point(system.index_of(id)).nailed = true;
    scene.released.push_back(lower);
  }
  system.contact = {.faces = true, .thickness = 0.004};
  return scene;
}

ContactScene make_pulled_sleeve() {
  ContactScene scene{.seconds = 0.8};
  System& system = scene.network.system;
  constexpr int n = 11;
  const std::vector<PointId> points = add_cloth(
      scene.network, {.rows = n, .columns = n},
      [](double u, double v) {
        const double angle = 5.5 * (u - 0.5);
        return Vec3(std::sin(angle) / 5.5, -v, std::cos(angle) / 5.5);
      },
      no_velocity);
  for (int column = 0; column < n; ++column) system.point(column).nailed = true;
  const PointId corner = points[n * (n - 1)];
  const Vec3 from = scene.network.state.position[scene.network.index(corner)];
  system.scripted_hand = ScriptedHand{
      .point = corner, .from = from, .center = {from.x, -0.8, 0.0}, .axis = {1.0, 0.0, 0.0}, .speed = 10.0, .begin = 0.0, .seconds = 0.5};
  system.contact = {.faces = true, .thickness = 0.004};
  return scene;
}

ContactScene make_rope_heap() {
  ContactScene scene{.seconds = 2.0, .min_substeps = 10};
  System& system = scene.network.system;
  constexpr int ropes = 20, points = 11;
  constexpr double length = 0.5, a = length / (points - 1);
  Random random(15);
  for (int rope = 0; rope < ropes; ++rope) {
    const double angle = random.uniform(0.0, pi);
    const Vec3 along(std::cos(angle), random.uniform(-0.1, 0.1), std::sin(angle));
    const Vec3 middle = Vec3(0.0, 0.1 + 0.08 * rope, 0.0) + random.vector(0.03);
    PointId last{};
    for (int i = 0; i < points; ++i) {
      const PointId next = scene.network.add(middle + (a * i - 0.5 * length) * along, 0.01);
      if (i > 0) scene.network.join(last, next, 500.0, a, 0.05);
      last = next;
    }
  }
  system.colliders = make_bin(0.3, 0.0, 0.3);
  system.contact = {.springs = true, .thickness = 0.01};
  return scene;
}

Settings settings_for(const Integrator& method, const ContactScene& scene) {
  const System& system = scene.network.system;
  // implicit methods have as many as contact allows
  const double step = is_stable_at_any_step(method) ? StepLimits(bound_spectrum(system)).stable_step(method) : HUGE_VAL;
  const int implicit = std::isfinite(step) ? static_cast<int>(std::ceil(1.0 / (60.0 * step) * (1.0 + 1e-9))) : 1;
  return settings_for(method, system, {.min = scene.min_substeps, .free = std::max(scene.min_substeps, implicit)});
}

}  // namespace hooke
