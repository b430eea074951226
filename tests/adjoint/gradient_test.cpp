// Derivatives of a run against central differences of runs; python/tests/test_gradient.py has more scenes, and what is refused.
#include "sim/adjoint/gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "sim/methods/integrator.h"
#include "sim/step/step.h"
#include "sim/step/supply.h"

namespace hooke {
namespace {

struct Chain {
  System system;
  State state;
  void join(int i, int j, double stiffness, double damping, double rest_length) {
    system.append_spring({.id = system.new_spring_id(),
                          .first = system.points()[i].id,
                          .second = system.points()[j].id,
                          .stiffness = stiffness,
                          .damping = damping,
                          .rest_length = rest_length});
  }
};

// Six points with loads in air that moves, the first one nailed, with springs to the next and to the second next one.
Chain make_chain() {
  Chain chain;
  chain.system.drag = 0.3;
  chain.system.wind = Vec3(1.0, 0.0, 0.0);
  for (int i = 0; i < 6; ++i) {
    chain.system.append_point({.id = chain.system.new_point_id(), .nailed = i == 0, .mass = 0.5 + 0.1 * i});
    chain.system.point(i).load = Vec3(0.2 * i, -0.3, 0.1);
    chain.state.position.emplace_back(0.3 * i, -0.03 * i * i, 0.05 * i);
    chain.state.velocity.push_back(i == 0 ? Vec3(0.0) : Vec3(0.1 * i, 0.2, -0.1));
  }
  for (int i = 0; i < 5; ++i) chain.join(i, i + 1, 200.0 + 20.0 * i, 0.5 + 0.2 * i, 0.3);
  for (int i = 0; i < 4; ++i) chain.join(i, i + 2, 50.0 + 20.0 * i, 3.0, 0.5);
  initialize_supply(chain.system, chain.state);
  return chain;
}

TEST(Gradient, IsTheLimitOfDifferences) {
  const Chain chain = make_chain();
  std::vector<Vec3> position, velocity;
  for (int i = 0; i < 6; ++i) {
    position.emplace_back(std::sin(i), std::cos(3.0 * i), 0.3 * i - 1.0);
    velocity.emplace_back(0.1, 0.05 * i, -0.1);
  }
  for (const char* id : {"velocity_verlet", "runge_kutta4"}) {
    const Settings settings{.integrator = find_integrator(id)};
    const auto value = [&](const Chain& start) {
      Plan plan = make_plan(start.system);
      State state = start.state;
      Frame frame;
      for (int n = 0; n < 10; ++n) {
        frame.begin(plan, start.system, settings, state);
        while (!frame.done()) frame.substep(plan);
        frame.end(plan, state);
      }
      double sum = 0.0;
      for (int i = 0; i < 6; ++i) sum += glm::dot(position[i], state.position[i]) + glm::dot(velocity[i], state.velocity[i]);
      return sum;
    };
    const auto expect = [&](double derivative, double step, const std::function<void(Chain&, double)>& move) {
      const auto at = [&](double distance) {
        Chain moved = chain;
        move(moved, distance);
        return value(moved);
      };
      const double measured = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
      EXPECT_NEAR(derivative, measured, 1e-6 * (1e-2 + std::abs(measured))) << id;
    };
    const Gradient gradient = compute_gradient(chain.system, settings, chain.state, 10, {{10}, position, velocity}, [](long, long) {});
    for (int s = 0; s < 9; ++s) {
      expect(gradient.stiffness[s], 0.1, [s](Chain& moved, double k) { moved.system.spring(s)->stiffness += k; });
      expect(gradient.rest_length[s], 1e-5, [s](Chain& moved, double l) { moved.system.spring(s)->rest_length += l; });
      expect(gradient.damping[s], 1e-3, [s](Chain& moved, double d) { moved.system.spring(s)->damping += d; });
    }
    for (int i = 1; i < 6; ++i) expect(gradient.mass[i], 1e-4, [i](Chain& moved, double m) { moved.system.point(i).mass += m; });
    for (int i = 0; i < 6; ++i)
      for (int c = 0; c < 3; ++c) {
        expect(gradient.position[i][c], 1e-5, [i, c](Chain& moved, double x) { moved.state.position[i][c] += x; });
        expect(gradient.velocity[i][c], 1e-4, [i, c](Chain& moved, double v) { moved.state.velocity[i][c] += i == 0 ? 0.0 : v; });
      }
  }
}

}  // namespace
}  // namespace hooke
