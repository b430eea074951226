// Scenes of every kind on which the estimates of errors are compared with the errors.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "support/folds.h"
#include "support/nets.h"

namespace hooke {

struct AccuracyScene {
  std::string_view name;
  TestSim (*make)();
  bool has_contact = false;
};

namespace accuracy_scene {

inline TestSim drum() {
  TestSim sim = cloth(8);
  for (Index i = 0; i < 64; ++i) sim.system.point(i).nailed = i < 8 || i >= 56 || i % 8 == 0 || i % 8 == 7;
  return sim;
}

inline TestSim rope() {
  TestSim sim;
  PointId last = sim.nail(Vec3(0.0));
  for (int i = 1; i < 16; ++i) {
    const PointId next = sim.add({i / 15.0, 0.0, 0.0}, 0.1 / 16);
    sim.join(last, next, 1e3, 1.0 / 15.0);
    last = next;
  }
  return sim;
}

// A cloth that falls on a ball.
inline TestSim contact() {
  TestSim sim = cloth(8);
  for (Index i = 0; i < 64; ++i) sim.system.point(i).nailed = false;
  sim.system.colliders.push_back({.shape = Sphere{{0.5, -0.5, -0.35}, 0.3}, .restitution = 0.0, .friction = 0.3});
  return sim;
}

inline TestSim wind() {
  TestSim sim = net(8, 1e2, 0.0);
  sim.system.drag = 0.3;
  const ForceTerm* term = find_force_term("wind");
  sim.system.forces.push_back({.term = term, .values = default_values(*term)});
  for (Index i = 0; i < 64; ++i) sim.system.point(i).radius = 0.03;
  return sim;
}

// A scripted hand takes a point of a cloth, moves and releases it.
inline TestSim held() {
  TestSim sim = cloth(8);
  sim.system.scripted_hand = ScriptedHand{.point = sim.system.points()[60].id,
                                          .from = sim.state.position[60],
                                          .center = {0.5, -0.9, 0.2},
                                          .axis = {0.0, 0.0, 1.0},
                                          .speed = 1.0,
                                          .begin = 0.2,
                                          .seconds = 0.5};
  return sim;
}

inline TestSim pulled() {
  TestSim sim = net(8, 1e2, 0.0);
  const Vec3 from = sim.state.position[60];
  sim.system.grab = Grab{.point = sim.system.points()[60].id, .stiffness = 50.0};
  sim.state.hand = {.position = from, .target = from + Vec3(0.2, 0.0, 0.3)};
  sim.system.hand_speed = 1.0;
  return sim;
}

}  // namespace accuracy_scene

inline const std::vector<AccuracyScene>& accuracy_scenes() {
  static const std::vector<AccuracyScene> scenes{
      {"net", [] { return net(8, 1e2, 0.0); }},
      {"stiff_net", [] { return net(8, 1e4, 0.0); }},
      {"drum", accuracy_scene::drum},
      {"rope", accuracy_scene::rope},
      {"curtain", [] { return curtain(8, 1e2, 0.0); }},
      {"dashpots", [] { return net(8, 1e3, 0.5); }},
      {"contact", accuracy_scene::contact, true},
      {"wind", accuracy_scene::wind},
      {"held", accuracy_scene::held},
      {"pulled", accuracy_scene::pulled},
  };
  return scenes;
}

namespace accuracy_scene {

// Balls in pairs joined by springs, in a row that a ball is thrown into.
inline TestSim row_of_balls() {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.points = true, .restitution = 0.8, .friction = 0.2};
  PointId last{};
  for (int i = 0; i < 7; ++i) {
    const PointId id = sim.add({0.13 * i, 0.004 * (i % 2), 0.0}, 0.1);
    sim.system.point(i).radius = 0.05;
    if (i > 0 && i % 2 == 0) sim.join(last, id, 30.0, 0.13);
    last = id;
  }
  sim.state.velocity[0] = {3.0, 0.1, 0.0};
  return sim;
}

// A rope falls across a bar and slides off it.
inline TestSim rope_on_bar() {
  TestSim sim;
  sim.join(sim.nail({-0.3, 0.0, 0.02}), sim.nail({0.4, 0.05, -0.03}), 100.0, 0.7);
  PointId last{};
  for (int i = 0; i < 8; ++i) {
    const PointId id = sim.add({0.02 - 0.01 * i, 0.06 + 0.01 * i, 0.08 * i - 0.3}, 0.03);
    if (i > 0) sim.join(last, id, 200.0, 0.08, 0.01);
    last = id;
  }
  sim.system.contact = {.springs = true, .thickness = 0.02, .friction = 0.3};
  return sim;
}

// Two sheets meet at 4 m/s.
inline TestSim meeting_sheets() {
  TestSim sim = colliding_sheets(5);
  folds::touch(sim);
  for (Vec3& v : sim.state.velocity) v *= 0.2;
  return sim;
}

// A sheet drops on its edge and folds.
inline TestSim folding_sheet() {
  TestSim sim = dropped_sheet(7);
  folds::touch(sim);
  return sim;
}

}  // namespace accuracy_scene

// Things that touch each other.
inline const std::vector<AccuracyScene>& contact_accuracy_scenes() {
  static const std::vector<AccuracyScene> scenes{
      {"row_of_balls", accuracy_scene::row_of_balls, true},
      {"rope_on_bar", accuracy_scene::rope_on_bar, true},
      {"meeting_sheets", accuracy_scene::meeting_sheets, true},
      {"folding_sheet", accuracy_scene::folding_sheet, true},
  };
  return scenes;
}

// Steps that the method is stable with, as a user would set them.
inline Settings accuracy_settings(const Integrator& method, const System& system) {
  constexpr double frame = 1.0 / 60.0;
  Settings settings{.integrator = &method, .substeps = 8};
  const double limit = largest_stable_step(method, make_plan(system).spectrum);
  if (method.stability == Stability::Conditional) settings.substeps = std::max(4, static_cast<int>(std::ceil(2.0 * frame / limit)));
  if (method.stability == Stability::None) settings.substeps = 400;
  if (method.stability == Stability::EachSpring) settings.substeps = 20;
  if (method.stability == Stability::LStable && method.order > 1) settings.substeps = 3;
  return settings;
}

}  // namespace hooke
