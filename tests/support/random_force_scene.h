// Random scenes with every kind of listed force, grabs, walls and wind.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_terms.h"
#include "support/random_scene.h"

namespace hooke {

enum class ForceSceneKind {
  Bounded,  // only forces whose stiffness and rate are bounded
  Any,
};

// A network of up to twelve points with up to three listed forces with random, sometimes extreme parameters; some scenes have walls, a pull
// by the hand or a scripted hand.
inline TestSim random_force_scene(std::uint64_t seed, ForceSceneKind kind) {
  Random random(seed + 0x5eed);
  const Index points = 2 + random.below(11);
  TestSim sim = random_sim(seed, points, random.below(3 * points), random.one_in(4) ? 2 : 3, random.one_in(2) ? 20.0 : 0.0);
  System& system = sim.system;
  for (Index i = 0; i < points; ++i) system.point(i).radius = 0.02;
  if (random.one_in(3)) system.drag = random.uniform(0.0, 5.0);
  if (random.one_in(3)) system.gravity = Vec3(0.0);
  // far enough below and beside the points that nothing touches at the start
  for (Index wall = random.below(4); wall > 0; --wall) {
    const Vec3 normal = glm::normalize(Vec3(random.uniform(-1.0, 1.0), random.uniform(0.2, 1.0), 0.0));
    system.colliders.push_back({.shape = Plane{.point = -2.5 * normal, .normal = normal},
                                .restitution = random.uniform(0.0, 1.0),
                                .friction = random.uniform(0.0, 1.0)});
  }
  for (Index count = random.below(4); count > 0; --count) {
    const auto terms = force_terms();
    const ForceTerm& term = terms[static_cast<std::size_t>(random.below(static_cast<Index>(terms.size())))];
    if (kind == ForceSceneKind::Bounded && term.id == "wind") continue;
    Force force{.term = &term, .values = default_values(term)};
    for (std::size_t n = 0; n < term.numbers.size(); ++n) {
      const ForceParameter& number = term.numbers[n];
      const bool is_place = number.unit == "m" && number.min < 0.0;
      if (is_place)
        force.values[n] = random.uniform(-1.0, 1.0);
      else if (number.name == "core")
        force.values[n] = std::pow(10.0, random.uniform(-2.0, 0.0));
      else if (random.one_in(2))
        force.values[n] = random.uniform(number.min, number.max) * (random.one_in(3) ? 1.0 : 0.05);
    }
    if (kind == ForceSceneKind::Bounded && term.id == "center") force.values[4] = std::max(-1.0, force.values[4]);
    system.forces.push_back(force);
  }
  const PointId point = system.points()[random.below(points)].id;
  if (random.one_in(4)) {
    system.grab = Grab{
        .point = point, .kind = random.one_in(2) ? GrabKind::Pull : GrabKind::Hold, .stiffness = std::pow(10.0, random.uniform(0.0, 4.0))};
    sim.state.hand = {.position = sim.position(point), .target = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0}};
  } else if (random.one_in(4)) {
    const Vec3 from = sim.position(point);
    system.scripted_hand = ScriptedHand{.point = point,
                                        .from = from,
                                        .center = from + Vec3(0.3, 0.0, 0.0),
                                        .speed = random.uniform(0.1, 10.0),
                                        .seconds = random.uniform(0.1, 1.0)};
  }
  return sim;
}

}  // namespace hooke
