// Every method of the table against its declared properties and its strengths.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "sim/forces/terms/rows.h"
#include "sim/methods/rows.h"
#include "support/convergence.h"
#include "support/nets.h"

namespace hooke {
namespace {

const Integrator& method(std::string_view id) { return *find_integrator(id); }

TEST(Integrators, AreTheConstantsOfTheirFiles) {
  EXPECT_EQ(&velocity_verlet, find_integrator("velocity_verlet"));
  EXPECT_EQ(&velocity_verlet, &default_integrator());
  EXPECT_EQ(&tr_bdf2, &stiff_integrator());
  for (const Integrator& row : integrators()) EXPECT_EQ(&row, find_integrator(row.id)) << row.id;
}

class Method : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Method, testing::ValuesIn(every_method()), method_name);

// One mass attached to a nail by a spring of this rest length, x'' = -w^2 x - lambda x' - c x', after `count` steps from (x, h v) = start:
// the same two numbers.
std::array<double, 2> stepped(const Integrator& row, const Oscillator& oscillator, double h, const std::array<double, 2>& start, int count,
                              double rest_length = 0.5) {
  const double s = 0.01;
  TestSim sim;
  sim.system.dimensions = 2;
  sim.system.gravity = Vec3(0.0);
  sim.system.drag = oscillator.h_drag / h;
  if (oscillator.h_rate > 0.0)
    sim.system.forces = {{.term = &mass_center_force, .values = {0.0, 0.0, 0.0, 0.0, oscillator.h_rate / h * 2.0}}};
  const PointId point = sim.add({s * start[0], 0.0, 0.0}, 2.0, {s * start[1] / h, 0.0, 0.0});
  sim.join(point, sim.nail({-rest_length, 0.0, 0.0}), 2.0 * oscillator.h_omega_squared / (h * h), rest_length,
           2.0 * oscillator.h_lambda / h);
  sim.run(row, h * count, count);
  return {sim.position(point).x / s, h * sim.velocity(point).x / s};
}

// A step's closed form is that of its matrix; or, of a method that keeps the acceleration of the step before, that of a recurrence.
void expect_closed_form(const Integrator& row, const Oscillator& oscillator, double tolerance) {
  constexpr double h = 0.125;
  const Amplification closed = row.amplification(oscillator);
  SCOPED_TRACE(testing::Message() << "h w = " << std::sqrt(oscillator.h_omega_squared) << ", h lambda = " << oscillator.h_lambda
                                  << ", h c = " << oscillator.h_drag << ", h q = " << oscillator.h_rate);
  if (closed.third == 0.0) {
    const std::array from_x = stepped(row, oscillator, h, {1.0, 0.0}, 1), from_v = stepped(row, oscillator, h, {0.0, 1.0}, 1);
    EXPECT_NEAR(closed.trace, from_x[0] + from_v[1], tolerance);
    EXPECT_NEAR(closed.determinant, from_x[0] * from_v[1] - from_x[1] * from_v[0], tolerance);
    return;
  }
  for (const std::array<double, 2>& start : {std::array{1.0, 0.0}, {0.0, 1.0}})
    for (const int first : {1, 2}) {
      std::array<double, 4> x{};
      for (int k = 0; k < 4; ++k) x[k] = stepped(row, oscillator, h, start, first + k, 0.0)[0];
      const double size = 1.0 + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]);
      EXPECT_NEAR(x[3], closed.trace * x[2] - closed.determinant * x[1] + closed.third * x[0], 20.0 * tolerance * size);
    }
}

TEST_P(Method, AmplifiesAModeDampedByAListedForceByItsClosedForm) {
  for (const double omega : {0.0, 0.7, 1.9})
    for (const double lambda : {0.0, 0.3})
      for (const double drag : {0.0, 0.4})
        for (const double rate : {0.2, 1.7}) {
          const Oscillator oscillator{omega * omega, lambda, drag, rate};
          expect_closed_form(method(), oscillator, 1e-11);
        }
}

TEST_P(Method, AmplifiesAModeByItsClosedForm) {
  for (const double omega : {0.01, 0.7, 1.9, 2.6})
    for (const double lambda : {0.0, 0.3, 1.5})
      for (const double drag : {0.0, 0.4}) {
        const Oscillator oscillator{omega * omega, lambda, drag};
        expect_closed_form(method(), oscillator, 1e-12);
      }
}

// a modulus above 1 for some mode or for none, as declared
TEST_P(Method, IsAsStableAsItDeclares) {
  double peak = 0.0, final_norm = 0.0;
  for (double omega = 1e-3; omega < 1e6; omega *= 1.01) {
    const Amplification mode = method().amplification({.h_omega_squared = omega * omega});
    const double discriminant = 0.25 * mode.trace * mode.trace - mode.determinant;
    final_norm = discriminant < 0.0 ? std::sqrt(mode.determinant) : 0.5 * std::abs(mode.trace) + std::sqrt(discriminant);
    peak = std::max(peak, final_norm);
  }
  switch (method().stability) {
    case Stability::None:
      EXPECT_EQ(largest_stable_step(method(), {.omega = 1.0}), 0.0);
      break;
    case Stability::Conditional:
      EXPECT_GT(largest_stable_step(method(), {.omega = 1.0}), 1.0);
      EXPECT_GT(peak, 2.0);
      break;
    case Stability::Adaptive:
      EXPECT_GT(peak, 2.0);
      break;
    case Stability::EachSpring:
    case Stability::LStable:
      EXPECT_LT(peak, 1.0 + 1e-12);
      EXPECT_LT(final_norm, 1e-3);
      break;
    case Stability::AStable:
      EXPECT_LT(peak, 1.0 + 1e-12);
      EXPECT_GT(final_norm, 0.9);
      break;
  }
}

// one step of 1/60 s on a net that is stretched and sheared: linear systems are solved as often as the row says
TEST_P(Method, SolvesItsEquationsAsItDeclares) {
  TestSim sim = net(5, 1e5, 0.2);
  for (Vec3& x : sim.state.position) x = {1.3 * x.x + 0.2 * x.y, 1.2 * x.y, 0.1 * x.x};
  Plan plan = make_plan(sim.system);
  Frame frame;
  frame.begin(plan, sim.system, {.integrator = &method(), .frame_rate = 60.0, .substeps = 1}, sim.state);
  while (!frame.done()) frame.substep(plan);
  switch (method().implicit_solve) {
    case ImplicitSolve::None:
      EXPECT_EQ(frame.motion().counts.solves, 0);
      break;
    case ImplicitSolve::Once:
      EXPECT_EQ(frame.motion().counts.solves, 1);
      break;
    case ImplicitSolve::Repeated:
      EXPECT_LE(frame.motion().counts.factorizations, 1);
      break;
    case ImplicitSolve::Iterative:
      EXPECT_GT(frame.motion().counts.solves, 1);
      break;
  }
}

// a new frame, plan and workspace for every frame gives the same result as reusing them
TEST_P(Method, KeepsNoHiddenStateOutsideState) {
  TestSim sim = net(5, 1e3, 0.2);
  sim.system.drag = 0.5;
  const Settings settings{.integrator = &method(), .frame_rate = 100.0, .substeps = 3};
  State reused = sim.state, fresh = sim.state;
  Plan reused_plan = make_plan(sim.system);
  Frame reused_frame;
  for (int frame = 0; frame < 10; ++frame) {
    reused_frame.begin(reused_plan, sim.system, settings, reused);
    while (!reused_frame.done()) reused_frame.substep(reused_plan);
    reused_frame.end(reused_plan, reused);

    Plan plan = make_plan(sim.system);
    Frame fresh_frame;
    fresh_frame.begin(plan, sim.system, settings, fresh);
    while (!fresh_frame.done()) fresh_frame.substep(plan);
    fresh_frame.end(plan, fresh);
  }
  EXPECT_EQ(reused, fresh);
}

// compared with Verlet at the same number of force evaluations
TEST(BlanesMoan, IsMoreAccurateThanVerletAtTheSameCost) {
  const auto error = [](const Integrator& row, int steps) {
    TestSim sim = net(8, 1e2, 0.0), exact = sim;
    sim.run(row, 0.5, steps);
    exact.run(method("runge_kutta4"), 0.5, 20000);
    return distance(sim.state, exact.state);
  };
  EXPECT_LT(error(method("blanes_moan4"), 100), 1e-3 * error(method("velocity_verlet"), 600));
}

struct Adapted {
  State state;
  long force_evaluations;
  double local_error;
};

Adapted run_adaptive(const TestSim& sim, double seconds, int substeps, double tolerance) {
  Plan plan = make_plan(sim.system);
  Frame frame;
  State state = sim.state;
  frame.begin(plan, sim.system,
              {.integrator = &method("dop853"), .frame_rate = 1.0 / seconds, .substeps = substeps, .tolerance = tolerance}, state);
  while (!frame.done()) frame.substep(plan);
  frame.end(plan, state);
  return {state, frame.force_evaluations(), frame.motion().local_error};
}

TEST(Dop853, MeetsItsTolerance) {
  for (const double d : {0.0, 0.9}) {
    const TestSim sim = net(8, 1e4, d);
    TestSim exact = sim;
    exact.run(method("runge_kutta4"), 0.5, 50000);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const Adapted adapted = run_adaptive(sim, 0.5, 1, tolerance);
      EXPECT_LT(distance(adapted.state, exact.state), tolerance) << "d = " << d;
      EXPECT_GT(adapted.local_error, 0.0);
      EXPECT_EQ(adapted.state.time, 0.5);
    }
    EXPECT_LT(run_adaptive(sim, 0.5, 1, 1e-6).force_evaluations, 12000) << "d = " << d;
  }
}

// a thousand ends of substeps cost one step each and do not change the result
TEST(Dop853, EndsExactlyOnEverySubstep) {
  const TestSim sim = net(8, 1e2, 0.0);
  const Adapted whole = run_adaptive(sim, 0.5, 1, 1e-9), cut = run_adaptive(sim, 0.5, 1000, 1e-9);
  EXPECT_LT(distance(whole.state, cut.state), 1e-9);
  EXPECT_LT(cut.force_evaluations, 12100);
}

TEST(Dop853, RemembersItsStepFromFrameToFrame) {
  TestSim sim = net(8, 1e2, 0.0);
  const Adapted first = run_adaptive(sim, 0.5, 1, 1e-9);
  EXPECT_GT(first.state.memory.step, 1e-3);
  EXPECT_GT(first.state.memory.error, 0.0);
  sim.system.point(9).mass *= 1e-4;  // a sudden increase in stiffness is detected within the frame
  sim.state = first.state;
  const Adapted second = run_adaptive(sim, 0.1, 1, 1e-9);
  EXPECT_LT(second.state.memory.step, 0.1 * first.state.memory.step);
}

TEST(Dop853, TerminatesWhereNoStepIsShortEnough) {
  TestSim sim = net(4, 1e2, 0.0);
  sim.state.velocity[9].x = 1e308;
  const Adapted adapted = run_adaptive(sim, 1.0 / 60.0, 1, 1e-6);
  EXPECT_LT(adapted.force_evaluations, 10000);
}

// One sweep per step is enough for convergence: the error against the exact motion decreases with the step.
TEST(Xpbd, IsOfFirstOrderWithDashpotsAndDrag) {
  TestSim sim = net(6, 1e2, 0.05);
  sim.system.drag = 0.5;
  TestSim exact = sim;
  exact.run(method("dop853"), 0.25, 64);
  expect_order(
      [&](int steps) {
        TestSim simulated = sim;
        simulated.run(method("xpbd"), 0.25, steps);
        return distance(simulated.state, exact.state);
      },
      25000, 1.0, 0.02);
}

// points may hang only as far from the nails as the cloth allows: it is 1 m wide, its diagonal 1.41 m
TEST(Xpbd, StaysBoundedOnAFineClothFarBeyondTheExplicitLimit) {
  for (const double hertz : {1000.0, 2000.0, 4000.0}) {
    TestSim sim = cloth(128);
    EXPECT_GT(1.0 / hertz, 2.7 * largest_stable_step(method("velocity_verlet"), make_plan(sim.system).spectrum));
    sim.run(method("xpbd"), 0.4, static_cast<int>(0.4 * hertz));
    double max_distance = 0.0, speed = 0.0;
    for (const Vec3& x : sim.state.position) max_distance = std::max(max_distance, glm::length(x));
    for (const Vec3& v : sim.state.velocity) speed = std::max(speed, glm::length(v));
    EXPECT_LT(max_distance, 2.0) << hertz << " Hz";
    EXPECT_LT(speed, 10.0) << hertz << " Hz";
  }
}

TEST(Xpbd, HangsAtTheEquilibriumOfItsSpringsWithDragAndDashpots) {
  TestSim sim;
  sim.system.drag = 50.0;
  const PointId point = sim.add({0.0, -1.3, 0.0}, 0.5);
  sim.join(sim.nail({0.0, 0.0, 0.0}), point, 40.0, 1.0, 3.0);
  sim.run(method("xpbd"), 60.0, 3600);
  EXPECT_NEAR(sim.position(point).y, -1.0 - 0.5 * 9.81 / 40.0, 1e-12);
}

// RMS difference [m] of the positions from those of implicit Euler, solved to convergence, after 0.1 s of a net.
double distance_from_implicit_euler(const TestSim& start, const Integrator& row, int iterations) {
  const auto after = [&](const Integrator& integrator) {
    TestSim sim = start;
    Plan plan = make_plan(sim.system);
    Frame frame;
    frame.begin(plan, sim.system, {.integrator = &integrator, .frame_rate = 10.0, .substeps = 6, .iterations = iterations}, sim.state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, sim.state);
    return sim.state;
  };
  return distance(after(row), after(implicit_euler));
}

class Iterating : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Iterating, testing::ValuesIn(methods_that([](const Integrator& row) { return row.iterates(); })),
                         method_name);

// with dashpots, a hand that pulls a face, a cable, a strut, a cubic spring and a muscle
TEST_P(Iterating, ConvergesToImplicitEuler) {
  TestSim sim = net(6, 100.0, 0.02);
  const auto set_law = [&](Index spring, const SpringLaw& law) { sim.system.spring(spring)->law = law; };
  set_law(20, {.force = SpringForce::Cable});
  set_law(25, {.force = SpringForce::Strut});
  set_law(30, {.force = SpringForce::Cubic, .k3 = 50.0});
  set_law(35, {.amplitude = 0.3, .frequency = 2.0});
  sim.system.grab = Grab{.point = sim.system.points()[30].id, .kind = GrabKind::Pull};
  sim.state.hand = {.position = sim.state.position[30], .target = sim.state.position[30] + Vec3(0.0, 0.0, 0.3)};
  double before = 1.0;
  for (const int iterations : {1, 5, 25}) {
    const double now = distance_from_implicit_euler(sim, method(), iterations);
    EXPECT_LT(now, before) << iterations << " iterations";
    before = 0.7 * now;
  }
  EXPECT_LT(distance_from_implicit_euler(sim, method(), 1000), 1e-7);
}

// the number of iterations does not matter
TEST_P(Iterating, FallsFreelyAndRestsWhereItsForcesBalance) {
  for (const int iterations : {1, 3}) {
    TestSim sim = net(6, 100.0, 0.02);
    for (Index i = 0; i < sim.system.point_count(); ++i) sim.state.velocity[i] = Vec3(0.0);
    EXPECT_LT(distance_from_implicit_euler(sim, method(), iterations), 1e-12) << "at rest, " << iterations << " iterations";

    sim = curtain(6, 100.0, 0.02);
    for (Index i = 0; i < sim.system.point_count(); ++i) {
      sim.system.point(i).nailed = false;
      sim.state.velocity[i] = {1.0, 2.0, 0.5};
    }
    EXPECT_LT(distance_from_implicit_euler(sim, method(), iterations), 1e-9) << "falling, " << iterations << " iterations";
  }
}

TEST(ProjectiveDynamics, FactorizesOnlyWhereSpringsMassesNailsOrTheStepHaveChanged) {
  TestSim sim = net(6, 100.0, 0.02);
  Plan plan = make_plan(sim.system);
  Frame frame;
  const auto factorizations = [&](int substeps) {
    refresh_values(plan, sim.system);
    frame.begin(plan, sim.system, {.integrator = &projective_dynamics, .frame_rate = 60.0, .substeps = substeps}, sim.state);
    while (!frame.done()) frame.substep(plan);
    const long count = frame.motion().counts.factorizations;
    frame.end(plan, sim.state);
    return count;
  };
  EXPECT_EQ(factorizations(4), 1);
  EXPECT_EQ(factorizations(4), 0);
  sim.system.spring(3)->stiffness *= 2.0;
  EXPECT_EQ(factorizations(4), 1);
  sim.system.point(20).nailed = true;
  EXPECT_EQ(factorizations(4), 1);
  sim.system.point(21).mass *= 2.0;
  EXPECT_EQ(factorizations(4), 1);
  EXPECT_EQ(factorizations(5), 1);
  sim.system.gravity *= 0.5;
  sim.state.velocity[25] += Vec3(1.0);
  EXPECT_EQ(factorizations(5), 0);
}

}  // namespace
}  // namespace hooke
