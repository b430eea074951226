// The order of the methods through contact of springs and faces: that declared, neither more nor less.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <map>

#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

// A free rope of three points falls across a nailed one, off its middle, turns and slides on it.
TestSim rope_over_rope(double friction) {
  TestSim sim;
  sim.join(sim.nail({-0.3, 0.0, 0.02}), sim.nail({0.4, 0.05, -0.03}), 100.0, 0.7);
  const PointId a = sim.add({0.02, 0.06, -0.25}, 0.1, {0.1, -0.5, 0.0}), b = sim.add({0.0, 0.08, 0.15}, 0.2, {0.0, -0.7, 0.1}),
                c = sim.add({-0.03, 0.1, 0.4}, 0.1);
  sim.join(a, b, 40.0, 0.4);
  sim.join(b, c, 40.0, 0.25);
  sim.system.contact = {.springs = true, .thickness = 0.02, .friction = friction};
  return sim;
}

TestSim slippery_ropes() { return rope_over_rope(0.0); }
TestSim rough_ropes() { return rope_over_rope(0.4); }

// A face falls on an edge of another, which moves freely too.
TestSim faces_in_flight() {
  TestSim sim;
  const auto add_face = [&](const std::array<Vec3, 3>& x, const Vec3& velocity) {
    std::array<PointId, 3> ids{};
    for (int i = 0; i < 3; ++i) ids[i] = sim.add(x[i], 0.1 + 0.05 * i, velocity);
    for (int i = 0; i < 3; ++i) sim.join(ids[i], ids[(i + 1) % 3], 60.0, glm::distance(x[i], x[(i + 1) % 3]));
    sim.system.faces.push_back({ids});
  };
  add_face({Vec3(-0.3, 0.0, 0.02), Vec3(0.4, 0.05, -0.03), Vec3(0.0, -0.5, 0.1)}, Vec3(0.0));
  add_face({Vec3(0.02, 0.06, -0.25), Vec3(-0.03, 0.1, 0.4), Vec3(0.2, 0.6, 0.1)}, {0.1, -0.8, 0.0});
  sim.system.gravity = Vec3(0.0);
  sim.system.contact = {.faces = true, .thickness = 0.02, .friction = 0.3};
  return sim;
}

constexpr double contact_seconds = 0.4;

State after_contact(TestSim sim, const Integrator& method, int steps) {
  sim.run(method, contact_seconds, steps);
  return sim.state;
}

// Of the RMS error over neighboring numbers of steps, because it depends on where in its step the impact falls.
double order_in_contact(const Integrator& method, TestSim (*make)()) {
  static std::map<TestSim (*)(), State> references;
  if (!references.contains(make)) references[make] = after_contact(make(), *find_integrator("runge_kutta4"), 1 << 16);
  const State& reference = references[make];
  const auto error_at = [&](int steps) {
    double sum = 0.0;
    constexpr int neighbors = 16;
    for (int i = 0; i < neighbors; ++i)
      sum += std::pow(distance(after_contact(make(), method, steps + i * steps / neighbors), reference), 2);
    return std::sqrt(sum / neighbors);
  };
  const double coarse = error_at(200), fine = error_at(1600);
  if (std::getenv("HOOKE_PRINT") != nullptr) std::printf("%s: %.3g m, %.3g m\n", std::string(method.id).c_str(), coarse, fine);
  return std::log2(coarse / fine) / 3.0;
}

class SurfaceOrder : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, SurfaceOrder, testing::ValuesIn(every_method()), method_name);

TEST_P(SurfaceOrder, OfRopesIsThatDeclared) {
  for (const auto make : {slippery_ropes, rough_ropes})
    EXPECT_NEAR(order_in_contact(method(), make), std::min(method().order_with.contact, surface_contact_order), 0.2);
}

TEST_P(SurfaceOrder, OfFacesIsThatDeclared) {
  EXPECT_NEAR(order_in_contact(method(), faces_in_flight), std::min(method().order_with.contact, surface_contact_order), 0.2);
}

}  // namespace
}  // namespace hooke
