// Bodies that are filled with gas: balls of triangles, and rings in flat scenes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <vector>

#include "sim/forces/terms/rows.h"
#include "sim/plan/enclosures.h"
#include "support/test_sim.h"

namespace hooke {

inline constexpr double gas_pi = 3.141592653589793;

struct GasOptions {
  double pressure = 100.0, exponent = 1.0, ambient = 0.0, leak = 0.0, leak_start = 0.0;
};

inline Force gas_force(const GasOptions& gas) {
  return {.term = &pressure_force, .values = {gas.pressure, gas.exponent, gas.ambient, gas.leak, gas.leak_start}};
}

// An icosahedron whose faces are divided into 4^level, with corners on a sphere of radius 1 m and a mass of 1 kg in total; springs along
// all edges, of the stiffness k [N/m] and their present length.
inline TestSim gas_ball(int level, double k, const GasOptions& gas) {
  std::vector<Vec3> corners;
  std::vector<std::array<int, 3>> faces;
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  for (int axis = 0; axis < 3; ++axis)
    for (const double a : {-1.0, 1.0})
      for (const double b : {-golden, golden}) {
        Vec3 corner(0.0);
        corner[axis] = a;
        corner[(axis + 1) % 3] = b;
        corners.push_back(glm::normalize(corner));
      }
  const double edge = 1.1 * 2.0 / std::sqrt(1.0 + golden * golden);
  const auto joined = [&](int i, int j) { return glm::distance(corners[i], corners[j]) < edge; };
  for (int i = 0; i < 12; ++i)
    for (int j = i + 1; j < 12; ++j)
      for (int l = j + 1; l < 12; ++l)
        if (joined(i, j) && joined(j, l) && joined(l, i)) faces.push_back({i, j, l});  // of any orientation
  for (int division = 0; division < level; ++division) {
    std::map<std::pair<int, int>, int> middle_of;
    const auto middle = [&](int i, int j) {
      const auto [at, is_new] = middle_of.try_emplace(std::minmax(i, j), static_cast<int>(corners.size()));
      if (is_new) corners.push_back(glm::normalize(corners[i] + corners[j]));
      return at->second;
    };
    std::vector<std::array<int, 3>> divided;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const auto& face : {std::array{a, ab, ca}, std::array{b, ab, bc}, std::array{c, ca, bc}, std::array{ab, bc, ca}})
        divided.push_back(face);
    }
    faces = divided;
  }

  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  std::vector<PointId> ids;
  for (const Vec3& corner : corners) ids.push_back(sim.add(corner, 1.0 / static_cast<double>(corners.size())));
  std::map<std::pair<int, int>, int> edges;
  for (const auto& [a, b, c] : faces) {
    sim.system.faces.push_back({{ids[a], ids[b], ids[c]}});
    for (const auto& [i, j] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      if (edges.try_emplace(std::minmax(i, j)).second) sim.join(ids[i], ids[j], k, glm::distance(corners[i], corners[j]));
  }
  sim.system.forces = {gas_force(gas)};
  return sim;
}

// A regular polygon of this many corners on a circle of radius 1 m, of 1 kg in total, with springs along its edges.
inline TestSim gas_ring(int corners, double k, const GasOptions& gas) {
  TestSim sim;
  sim.system.dimensions = 2;
  sim.system.gravity = Vec3(0.0);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * gas_pi * i / corners;
    sim.add({std::cos(angle), std::sin(angle), 0.0}, 1.0 / corners);
  }
  for (int i = 0; i < corners; ++i) {
    const PointId first = sim.system.points()[i].id, second = sim.system.points()[(i + 1) % corners].id;
    sim.join(first, second, k, glm::distance(sim.position(first), sim.position(second)));
  }
  sim.system.forces = {gas_force(gas)};
  return sim;
}

// A scene whose first force is the pressure, compiled.
struct PackedGas {
  Plan plan;
  Motion motion;
  explicit PackedGas(const TestSim& sim) : plan(make_plan(sim.system)) { pack(plan, sim.state, motion); }
  const ForceValues& values() const { return plan.forces[0].values; }
  double volume(std::size_t enclosure = 0) const {
    return std::abs(signed_volume(plan, plan.force_data.enclosures.enclosures[enclosure], motion.x.data()));
  }
  double potential(double time = 0.0) const { return pressure_force.potential(plan, values(), time, motion.x.data()); }
  Field force(double time = 0.0) const { return force_at(motion.x, time); }
  Field force_at(const Field& x, double time = 0.0) const {
    Field f(x.size(), 0.0);
    pressure_force.add(plan, values(), time, x.data(), motion.v.data(), f.data());
    return f;
  }
};

inline double length_of(const Field& f) {
  double square = 0.0;
  for (const double component : f) square += component * component;
  return std::sqrt(square);
}

}  // namespace hooke
