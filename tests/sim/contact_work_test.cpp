// The energy balance contains what contact takes and supplies.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/forces/force_terms.h"
#include "sim/methods/rows.h"
#include "sim/step/divergence.h"
#include "support/convergence.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

class ContactWork : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, ContactWork, testing::ValuesIn(every_method()), method_name);

// The floor moves the points up by 0.5 m and 0.2 m in the first step, which also shortens the spring from 0.5 m to 0.4 m. Only the error of
// the method over the frame remains.
TEST_P(ContactWork, ContainsTheWorkOfMovingOutPointsThatStartInside) {
  for (const bool is_joined : {false, true}) {
    TestSim sim;
    const PointId deep = sim.add({0.0, -0.5, 0.0}, 2.0), shallow = sim.add({0.4, -0.2, 0.0}, 0.5);
    if (is_joined) sim.join(deep, shallow, 50.0, 0.4);
    sim.system.colliders = {{.shape = Plane{}}};
    initialize_supply(sim.system, sim.state);
    const double before = compute_energy(sim.system, sim.state).elastic;
    sim.run(method(), 1.0 / 60.0, 100, 1e-8);
    const Energy energy = compute_energy(sim.system, sim.state);
    const double supplied = 9.81 * (2.0 * 0.5 + 0.5 * 0.2) + energy.elastic - before;
    EXPECT_LE(std::abs(energy.total() - sim.state.supply.net_input), 1e-2 * supplied) << is_joined;
    EXPECT_GT(sim.state.supply.scale, 0.9 * supplied);
  }
}

// A mass on a spring bounces on a floor: all that it loses is the work of the impacts, also where an adaptive step is repeated because of
// them.
TEST(ContactWork, OfRejectedStepsDoesNotCount) {
  TestSim sim;
  const PointId mass = sim.add({0.0, 0.4, 0.0}, 0.5);
  sim.join(mass, sim.nail({0.0, 1.0, 0.0}), 0.5 * 36.0, 1.0);
  sim.system.colliders = {{.shape = Plane{}, .restitution = 0.5}};
  Plan plan = make_plan(sim.system);
  const Settings settings{.integrator = &dop853, .substeps = 1, .tolerance = 1e-8};
  const double start = compute_energy(sim.system, sim.state).total();
  double work = 0.0;
  Frame frame;
  for (int i = 0; i < 60; ++i) {
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    work += frame.motion().energy[EnergyCause::Contact];
  }
  EXPECT_LT(work, -0.5);
  EXPECT_NEAR(compute_energy(sim.system, sim.state).total() - start, work, 1e-5);
}

// A spring presses a mass onto a floor that hardly moves: a method for which a step without contact changes the energy books that change as
// work of contact, hundreds of joules per second here. It is not work of the floor, which cannot do more than force times path.
TEST_P(ContactWork, OfAColliderIsLimitedByItsMotion) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const PointId mass = sim.add({0.0, 0.0, 0.0}, 0.01);
  const double stiffness = 100.0, force = stiffness * 9.0, amplitude = 1e-4, frequency = 2.0;
  sim.join(mass, sim.nail({0.0, -10.0, 0.0}), stiffness, 1.0);
  sim.system.colliders = {{.shape = Plane{}, .path = {.amplitude = {0.0, amplitude, 0.0}, .frequency = frequency}}};
  Plan plan = make_plan(sim.system);
  const Settings settings{.integrator = &method(), .substeps = 16, .tolerance = 1e-8};
  double work = 0.0;
  constexpr int frames = 30;
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    frame.begin(plan, sim.system, settings, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    work += std::abs(frame.motion().energy[EnergyCause::Colliders]);
  }
  const double path = 4.0 * amplitude * frequency * frames / settings.frame_rate;
  // each bound is of a whole substep: the impulse of contact and that of the force, at the maximum speed
  EXPECT_LE(work, 4.0 * force * path);
}

// What a body of 0.5 kg loses as it falls on something that does not move, comes to rest there, and stays.
struct FallenBody {
  TestSim sim;
  double weight = 0.5;  // [kg]

  // on a plane, on a ball, on a point, or a bar across another
  explicit FallenBody(int kind, double restitution) {
    if (kind == 3) {
      sim.system.contact = {.springs = true, .thickness = 0.02};
      sim.join(sim.nail({-1.0, 0.0, 0.0}), sim.nail({1.0, 0.0, 0.0}), 0.0, 2.0);
      sim.join(sim.add({0.0, 0.3, -0.5}, 0.5 * weight), sim.add({0.0, 0.3, 0.5}, 0.5 * weight), 10.0, 1.0);
      return;
    }
    sim.add({0.0, 0.3, 0.0}, weight);
    sim.system.point(0).radius = 0.05;
    if (kind == 0)
      sim.system.colliders = {{.shape = Plane{}, .restitution = restitution, .friction = 0.3}};
    else if (kind == 1)
      sim.system.colliders = {{.shape = Sphere{{0.0, -0.5, 0.0}, 0.5}, .restitution = restitution}};
    else {
      sim.system.contact = {.points = true, .restitution = restitution};
      sim.nail({0.0, 0.0, 0.0});
      sim.system.point(1).radius = 0.05;
    }
  }
};

// The velocities of Euler methods belong to half a step earlier or later than their places. Booked by these velocities alone, contact would
// take m g h v / 2 too little or too much, 8e-2 J here, for which the method would be blamed.
TEST_P(ContactWork, IsTheEnergyThatABodyLosesUntilItRests) {
  for (const double restitution : {0.0, 0.6})
    for (int kind = 0; kind < 4; ++kind) {
      FallenBody fall(kind, restitution);
      TestSim& sim = fall.sim;
      Plan plan = make_plan(sim.system);
      const Settings settings{.integrator = &method(), .substeps = 10, .tolerance = 1e-8};
      const double start = compute_energy(sim.system, sim.state).total(), h = settings.substep();
      double work = 0.0;
      Frame frame;
      for (int i = 0; i < 120; ++i) {
        frame.begin(plan, sim.system, settings, sim.state);
        while (!frame.done()) frame.substep(plan);
        frame.end(plan, sim.state);
        work += frame.motion().energy[EnergyCause::Contact];
      }
      const double loss = start - compute_energy(sim.system, sim.state).total();
      EXPECT_GT(loss, 0.9) << kind;
      EXPECT_NEAR(-work, loss, 4.0 * fall.weight * std::pow(9.81 * h, 2)) << kind << ", restitution " << restitution;
    }
}

// A force that brakes acts on the velocity that the weight causes in each substep, which contact takes away: it does no work, where the
// power at that velocity would be 1e-4 J in half a second.
TEST_P(ContactWork, OfForcesOnWhatRestsIsNone) {
  for (const int kind : {0, 3}) {
    FallenBody fall(kind, 0.0);
    TestSim& sim = fall.sim;
    Force brake{.term = find_force_term("mass_center"), .values = default_values(*find_force_term("mass_center"))};
    constexpr std::size_t stiffness = 3;
    brake.values[stiffness] = 0.0;
    sim.system.forces.push_back(brake);
    Plan plan = make_plan(sim.system);
    const Settings settings{.integrator = &method(), .substeps = 10, .tolerance = 1e-8};
    double work = 0.0;
    Frame frame;
    for (int i = 0; i < 150; ++i) {
      frame.begin(plan, sim.system, settings, sim.state);
      while (!frame.done()) frame.substep(plan);
      frame.end(plan, sim.state);
      if (i >= 120) work += std::abs(frame.motion().energy.forces());
    }
    EXPECT_LT(work, 1e-6) << kind;
  }
}

}  // namespace
}  // namespace hooke
