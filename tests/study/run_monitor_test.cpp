// The run monitor does not warn about correct runs.
#include "study/run_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "lab/lab_parts.h"
#include "sim/control/automatic.h"
#include "sim/forces/energy/energy.h"
#include "sim/forces/force_terms.h"
#include "sim/step/divergence.h"
#include "study/benchmark.h"
#include "study/hard_cases/monitored_run.h"
#include "support/force_with.h"
#include "support/parts.h"

namespace hooke {
namespace {

// Six points and nine springs under some of the listed forces, with values of moderate size.
TestNetwork random_scene(std::uint64_t seed) {
  Random random(seed);
  const auto one_in = [&](std::uint64_t count) { return random.next_bits() % count == 0; };
  TestNetwork network;
  const double max_damping = one_in(2) ? 0.5 : 0.0;
  std::vector<PointId> points;
  for (int i = 0; i < 6; ++i) {
    const Vec3 position = random.vector(1.0), velocity = random.vector(2.0);
    points.push_back(i == 0 ? network.nail(position) : network.add(position, random.uniform(0.1, 2.0), velocity));
  }
  for (int s = 0; s < 9; ++s) {
    const std::uint64_t first = random.next_bits() % 6, second = (first + 1 + random.next_bits() % 5) % 6;
    const double stiffness = random.uniform(1.0, 200.0), rest_length = random.uniform(0.1, 2.0);
    network.join(points[first], points[second], stiffness, rest_length, random.uniform(0.0, max_damping));
  }
  if (one_in(3)) network.system.gravity = Vec3(0.0);
  network.system.drag = one_in(2) ? 0.0 : random.uniform(0.0, 2.0);
  for (const ForceTerm& term : force_terms()) {
    if (term.prepare != nullptr || !one_in(3)) continue;  // there are no faces
    Force force{.term = &term, .values = default_values(term)};
    for (std::size_t i = 0; i < term.numbers.size(); ++i) force.values[i] *= random.uniform(0.5, 3.0);
    network.system.forces.push_back(force);
  }
  initialize_supply(network.system, network.state);
  return network;
}

// The state after `seconds` from a high-order method at a fine tolerance.
State exact_end(const TestNetwork& network, double seconds) {
  MonitoredRun run(network, {.integrator = find_integrator("dop853"), .substeps = 1, .tolerance = 1e-6});
  run.run(seconds);
  return run.state();
}

// The dashpot takes 4 % of the energy within the first frame, and is gone after it.
TEST(RunMonitor, ExpectsTheLossOfADashpotThatBreaks) {
  TestNetwork pair;
  pair.system.gravity = Vec3(0.0);
  pair.join(pair.add({-0.5, 0.0, 0.0}, 1.0, {-5.0, 0.0, 0.0}), pair.add({0.5, 0.0, 0.0}, 1.0, {5.0, 0.0, 0.0}), 100.0, 1.0, 1.0);
  pair.system.spring(0)->break_strain = 0.1;
  MonitoredRun run(pair, {.integrator = find_integrator("velocity_verlet"), .substeps = 20});
  run.run(0.1);
  EXPECT_EQ(run.lab().scene().system.spring_count(), 0);
  EXPECT_TRUE(run.monitor().warnings({}).empty()) << run.monitor().warnings({})[0];
}

// `auto` estimates the error of every frame, whether the settings are its own or those that it chose.
TEST(RunMonitor, AddsUpTheErrorsEstimatedByAuto) {
  TestNetwork pendulum;
  pendulum.join(pendulum.nail({0.0, 0.0, 0.0}), pendulum.add({1.0, 0.0, 0.0}, 1.0), 100.0);
  for (const bool is_chosen : {false, true}) {
    Lab lab(MonitoredRun(pendulum, {.integrator = &automatic_method()}).lab().scene(), KeepStart::No);
    RunMonitor monitor(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state, 20);
    for (int i = 0; i < 20; ++i) {
      const Settings& settings = lab.scene().settings;
      monitor.begin_frame(lab.scene().system, settings, lab.scene().state);
      ASSERT_TRUE(lab.step());
      monitor.end_frame(lab.plan(), is_chosen ? settings_used(settings, lab.scene().state) : settings, lab.scene().system,
                        lab.scene().state, lab.last_frame().motion());
    }
    EXPECT_GT(monitor.estimated_error(), 0.0) << is_chosen;
    EXPECT_LT(monitor.estimated_error(), automatic_case_tolerance * 20.0 / 60.0) << is_chosen;
  }
}

class RunMonitorOfScenes : public InParts<3> {};
INSTANTIATE_TEST_SUITE_P(Daily, RunMonitorOfScenes, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, RunMonitorOfScenes, testing::Range(1, RunMonitorOfScenes::parts));

TEST_P(RunMonitorOfScenes, DoesNotWarnAboutCorrectRuns) {
  constexpr double seconds = 1.0, correct = 2e-2;  // [s], [m]
  constexpr int scenes = 300;
  int stable = 0, warned = 0;
  std::string false_warnings;
  for (std::uint64_t seed = 1; seed <= scenes; ++seed) {
    if (!has(static_cast<int>(seed) - 1)) continue;
    const TestNetwork network = random_scene(seed);
    MonitoredRun run(network, settings_for(default_integrator(), network.system, {.min = 20, .fraction = 0.25, .max = 2000}));
    // a step beyond the stability limit is not expected to be correct
    if (run.settings().substep() > largest_stable_step(default_integrator(), bound_spectrum(network.system))) continue;
    ++stable;
    run.run(seconds);
    const std::vector<std::string> warnings = run.monitor().warnings({});
    if (warnings.empty() && !run.stopped()) continue;
    ++warned;
    // only warnings about correct runs count
    const double error = run.stopped() ? 0.0 : rms_distance(network.system, run.state(), exact_end(network, seconds));
    if (error <= correct) false_warnings += "\nscene " + std::to_string(seed) + ": " + (run.stopped() ? "stopped" : warnings.front());
  }
  EXPECT_GE(stable, 250 / parts);
  EXPECT_LT(warned, scenes / 10 / parts);
  EXPECT_EQ(false_warnings, "");
}

// Nets at rest that a pull on the center of mass moves, damped up to a hundred times faster than a substep resolves: all energy is the work
// of the pull.
TEST(RunMonitor, DoesNotWarnAboutForcesFasterThanASubstep) {
  constexpr double seconds = 1.0, correct = 2e-2;  // [s], [m]
  const ForceTerm& term = *find_force_term("mass_center");
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    TestNetwork network = random_scene(seed);
    Random random(seed);
    for (Index i = 0; i < network.system.point_count(); ++i) {
      network.system.point(i).mass *= 0.1;
      network.system.point(i).nailed = false;
    }
    for (Index s = 0; s < network.system.spring_count(); ++s) {
      SpringEdit spring = network.system.spring(s);
      spring->rest_length += strain(network.system, network.state, *spring) * spring->rest_length;
      spring->damping = 0.0;
    }
    network.state.velocity.assign(network.state.velocity.size(), Vec3(0.0));
    network.system.gravity = Vec3(0.0);
    network.system.drag = 0.0;
    Force pull{.term = &term, .values = default_values(term)};
    pull.values[3] = random.uniform(0.0, 1000.0);
    pull.values[4] = 1000.0 * std::pow(10.0, -random.uniform(0.0, 3.0));
    network.system.forces = {pull};
    initialize_supply(network.system, network.state);
    const State exact = exact_end(network, seconds);
    for (const char* id : {"dop853", "implicit_midpoint", "tr_bdf2", "esdirk4", "implicit_euler"}) {
      MonitoredRun run(network, {.integrator = find_integrator(id), .substeps = 20});
      run.run(seconds);
      if (run.stopped() || rms_distance(network.system, run.state(), exact) > correct) continue;
      ++checked;
      const auto warnings = run.monitor().warnings({});
      EXPECT_TRUE(warnings.empty()) << "scene " << seed << ", " << id << ": " << warnings.front();
    }
  }
  EXPECT_GT(checked, 80);
}

// The energy of a symplectic method oscillates about a modified energy that it conserves: at w h = 0.06, that of symplectic Euler by 6 %.
TEST(RunMonitor, DoesNotCallTheOscillationOfASymplecticMethodAGain) {
  TestNetwork network;
  network.add({0.72, 0.49, 0.0}, 0.1418, {18.8, -18.6, 0.0});
  const ForceTerm& term = *find_force_term("mass_center");
  network.system.forces = {{.term = &term, .values = {0.7, 0.0, 0.0, 817.0, 6.2}}};
  initialize_supply(network.system, network.state);
  MonitoredRun run(network, {.integrator = find_integrator("symplectic_euler"), .substeps = 20});
  run.run(1.0);
  EXPECT_LT(run.monitor().energy_rise(), 2e-3);
}

// In a large net, the modified energy of each lowest state is computed at once: as from copies of the states.
TEST(RunMonitor, FindsTheSameRiseInALargeNetAsFromStatesThatAreKept) {
  constexpr int n = 320;
  static_assert(n * n >= min_points_of_large_run);
  TestNetwork net;
  net.system.gravity = Vec3(0.0);
  Random random(1);
  std::vector<PointId> points;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) points.push_back(net.add(Vec3(0.1 * column, 0.1 * row, 0.0) + random.vector(0.03), 1.0));
  for (int i = 0; i < n * n; ++i) {
    if (i % n != n - 1) net.join(points[i], points[i + 1], 100.0, 0.1);
    if (i < n * (n - 1)) net.join(points[i], points[i + n], 100.0, 0.1);
  }
  initialize_supply(net.system, net.state);
  for (const char* method : {"velocity_verlet", "symplectic_euler"}) {
    MonitoredRun run(net, {.integrator = find_integrator(method), .substeps = 1});
    const auto energy = [&] { return compute_energy(run.system(), run.state()).total() - run.state().supply.net_input; };
    const Plan plan = make_plan(run.system());
    const auto difference = [&](const State& state) {
      Motion motion;
      pack(plan, state, motion);
      return run.settings().integrator->modified_energy(plan, motion, run.settings().substep());
    };
    std::pair lowest(energy(), run.state());
    double rise = 0.0, raw = 0.0;
    for (int frame = 0; frame < 12; ++frame) {
      ASSERT_TRUE(run.frame());
      std::pair next(energy(), run.state());
      const double change = next.first - lowest.first, modified = change + difference(next.second) - difference(lowest.second);
      raw = std::max(raw, change);
      if (change > rise && change * modified > 0.0) rise = std::max(rise, std::min(change, modified));
      if (change < 0.0) lowest = std::move(next);
    }
    EXPECT_GT(raw, 0.0) << method;
    EXPECT_LT(rise, raw);
    EXPECT_EQ(run.monitor().energy_rise(), rise / run.state().supply.scale) << method;
  }
}

// Nets without dissipation, stretched by up to 30 %, at a quarter of the limit. With HOOKE_PRINT set, the figures of
// docs/development/accuracy.md.
TEST(RunMonitor, RarelyWarnsAboutNetsAtTheRecommendedStep) {
  const bool prints = std::getenv("HOOKE_PRINT") != nullptr;
  const std::uint64_t nets = prints ? 2000 : 60;
  for (const char* id : {"symplectic_euler", "velocity_verlet"}) {
    std::uint64_t warned = 0;
    for (std::uint64_t seed = 0; seed < nets; ++seed) {
      Random random(seed);
      TestNetwork network;
      network.system.gravity = Vec3(0.0);
      for (int i = 0; i < 8; ++i) network.add(random.vector(1.0), std::pow(10.0, random.uniform(-1.0, 1.0)), random.vector(2.0));
      for (int i = 1; i < 8; ++i)
        for (int j = 0; j < i; ++j) {
          const Vec3 d = network.state.position[i] - network.state.position[j];
          const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) * random.uniform(0.7, 1.3);
          network.join(network.system.points()[i].id, network.system.points()[j].id, 1e3 * random.uniform(0.3, 3.0), length);
        }
      initialize_supply(network.system, network.state);
      MonitoredRun run(network, settings_for(*find_integrator(id), network.system, {.min = 1, .fraction = 0.25, .max = 5000}));
      run.run(3.0);
      EXPECT_FALSE(run.stopped());
      warned += run.monitor().warnings({}).empty() ? 0 : 1;
    }
    if (prints) std::printf("%s: %d of %d warned about\n", id, static_cast<int>(warned), static_cast<int>(nets));
    EXPECT_LE(warned, nets / 20) << id;
  }
}

// A net at rest in moving air, which carries it away.
TEST(RunMonitor, DoesNotWarnAboutAWindThatSetsTheSceneInMotion) {
  for (const Integrator& method : integrators()) {
    TestNetwork network;
    const PointId first = network.add({0.0, 0.0, 0.0}), second = network.add({0.5, 0.1, 0.0}, 0.4);
    network.join(first, second, 20.0, 0.6);
    network.system.gravity = Vec3(0.0);
    network.system.drag = 0.6;
    network.system.wind = {-4.0, 0.0, 1.0};
    initialize_supply(network.system, network.state);
    MonitoredRun run(network, {.integrator = &method, .substeps = 20});
    run.run(2.0);
    EXPECT_FALSE(run.stopped()) << method.id;
    EXPECT_TRUE(run.monitor().warnings({}).empty()) << method.id << ": rise " << run.monitor().energy_rise();
  }
}

// A point that the hand holds and moves, far heavier than the others, under a pull of the center of mass: its own motion is the hand's.
TEST(RunMonitor, DoesNotWarnAboutAHandInAPullOfTheCenterOfMass) {
  for (const bool nailed : {false, true}) {
    TestNetwork network;
    const PointId held = nailed ? network.nail(Vec3(0.0)) : network.add(Vec3(0.0), 50.0), other = network.add({0.5, 0.1, 0.0}, 0.4);
    network.system.point(network.index(held)).mass = 50.0;
    network.join(held, other, 20.0, 0.6);
    const ForceTerm& term = *find_force_term("mass_center");
    Force pull{.term = &term, .values = default_values(term)};
    pull.values[3] = 500.0;
    pull.values[4] = 0.0;
    network.system.forces = {pull};
    network.system.scripted_hand = ScriptedHand{.point = held, .from = Vec3(0.0), .center = {0.4, 0.0, 0.0}, .speed = 2.0, .seconds = 2.0};
    initialize_supply(network.system, network.state);
    MonitoredRun run(network, {.integrator = find_integrator("velocity_verlet"), .substeps = 100});
    run.run(1.5);
    EXPECT_FALSE(run.stopped());
    const auto warnings = run.monitor().warnings({});
    EXPECT_TRUE(warnings.empty()) << warnings.front();
  }
}

// Points that are far faster than the air around them: all their energy is dissipated, within a substep.
TEST(RunMonitor, DoesNotCallTheBrakingOfFastPointsByStillAirAGain) {
  for (const double speed : {10.0, 1000.0})
    for (const char* id : {"implicit_euler", "baraff_witkin", "implicit_midpoint", "tr_bdf2", "esdirk4", "dop853"}) {
      TestNetwork network;
      network.system.gravity = Vec3(0.0);
      const PointId point = network.add(Vec3(0.0), 1e-3, {speed, 0.0, 0.0});
      network.system.point(network.index(point)).radius = 0.5;
      network.system.forces = {force_with("wind", {{"x", 0.0}, {"z", 0.0}})};
      initialize_supply(network.system, network.state);
      MonitoredRun run(network, {.integrator = find_integrator(id), .substeps = 5});
      run.run(0.5);
      EXPECT_FALSE(run.stopped()) << id << " at " << speed << " m/s";
      EXPECT_LT(run.monitor().energy_rise(), 0.02) << id << " at " << speed << " m/s";
    }
}

// A point that starts inside a floor, in a field that pulls it there: what moves it out does work on the field, but the method gains
// nothing.
TEST(RunMonitor, DoesNotCallThePushOutOfAColliderAgainstAForceAGain) {
  for (const char* force : {"wall", "center", "mass_center"}) {
    TestNetwork network;
    network.system.gravity = Vec3(0.0);
    network.add({0.0, -0.5, 0.0});
    network.system.forces = {std::string_view(force) == "wall" ? force_with(force, {{"strength", -10.0}, {"power", 0.0}, {"core", 0.5}})
                             : std::string_view(force) == "center"
                                 ? force_with(force, {{"y", -3.0}, {"strength", 10.0}, {"power", 0.0}})
                                 : force_with(force, {{"y", -3.0}, {"stiffness", 10.0}, {"damping", 0.0}})};
    network.system.colliders = {{.shape = Plane{}}};
    initialize_supply(network.system, network.state);
    for (const char* id : {"velocity_verlet", "dop853"}) {
      MonitoredRun run(network, {.integrator = find_integrator(id), .substeps = 20});
      run.run(0.5);
      const auto warnings = run.monitor().warnings({});
      EXPECT_TRUE(warnings.empty()) << force << ", " << id << ": " << warnings.front();
    }
  }
}

// A pendulum under a method that damps it by two thirds, in a scene that hardly dissipates anything.
TEST(RunMonitor, WarnsAboutALossThatIsNotThatOfDragDashpotsContactOrForces) {
  const auto loss_with = [](const auto& add) {
    TestNetwork network;
    const SpringId spring = network.join(network.nail(Vec3(0.0)), network.add({1.0, 0.0, 0.0}), 1e4, 1.0);
    add(network, spring);
    initialize_supply(network.system, network.state);
    MonitoredRun run(network, {.integrator = find_integrator("implicit_euler"), .substeps = 1});
    run.run(4.0);
    const auto warnings = run.monitor().warnings({});
    return warnings.empty() ? std::string() : warnings.front();
  };
  const auto add_floor = [](TestNetwork& network) { network.system.colliders = {{.shape = Plane{.point = {0.0, -1.5, 0.0}}}}; };
  const std::string without = loss_with([](TestNetwork&, SpringId) {});
  EXPECT_NE(without.find("(loss)"), std::string::npos) << without;
  EXPECT_EQ(loss_with([](TestNetwork& network, SpringId) { network.system.drag = 1e-9; }), without);
  EXPECT_EQ(
      loss_with([](TestNetwork& network, SpringId spring) { network.system.spring(network.system.index_of(spring))->damping = 1e-9; }),
      without);
  EXPECT_EQ(loss_with([&](TestNetwork& network, SpringId) { add_floor(network); }), without);
  EXPECT_EQ(loss_with([](TestNetwork& network, SpringId) {
              network.system.forces = {force_with("wind", {{"x", 0.0}, {"z", 0.0}, {"normal", 1e-12}})};
            }),
            without);
  EXPECT_EQ(loss_with([](TestNetwork& network, SpringId) {
              network.system.forces = {force_with("mass_center", {{"stiffness", 0.0}, {"damping", 1e-12}})};
            }),
            without);
  const std::string with_grain = loss_with([&](TestNetwork& network, SpringId) {
    add_floor(network);
    network.add({1.5, -1.4, 0.0}, 1e-9);  // lands on the floor
  });
  EXPECT_NE(with_grain.find("(loss)"), std::string::npos) << with_grain;
  EXPECT_EQ(loss_with([](TestNetwork& network, SpringId) { network.system.drag = 1.0; }), "");
  EXPECT_EQ(loss_with([](TestNetwork& network, SpringId) {
              network.system.forces = {force_with("mass_center", {{"stiffness", 0.0}, {"damping", 5.0}})};
            }),
            "");
}

// A free point that loses nearly all of its energy, and gains some in between.
TEST(RunMonitor, NamesTheLossOfARunThatAlsoGainsEnergy) {
  TestNetwork network;
  network.system.gravity = Vec3(0.0);
  network.add(Vec3(0.0), 1.0, {1.0, 0.0, 0.0});
  initialize_supply(network.system, network.state);
  const Settings settings{.integrator = find_integrator("runge_kutta4")};
  const Plan plan = make_plan(network.system);
  const auto warning_after = [&](std::initializer_list<double> speeds) {
    State state = network.state;
    RunMonitor monitor(plan, settings, network.system, state, 0);
    for (const double speed : speeds) {
      monitor.begin_frame(network.system, settings, state);
      state.velocity[0].x = speed;
      monitor.end_frame(plan, settings, network.system, state, {});
    }
    return monitor.warnings({}).front();
  };
  EXPECT_NE(warning_after({0.5, 0.7, 0.1}).find("99 % of the energy supplied (loss)"), std::string::npos);
  EXPECT_NE(warning_after({0.9, 1.3, 1.2}).find("(gain)"), std::string::npos);
}

// "1e+02 %" is no number that people write.
TEST(RunMonitor, WritesPercentagesWithoutExponents) {
  TestNetwork pendulum;
  pendulum.join(pendulum.nail({0.0, 0.0, 0.0}), pendulum.add({1.0, 0.0, 0.0}, 1.0), 100.0);
  for (const double factor : {3.0, 4.0, 30.0, 1e3, 1e6}) {
    MonitoredRun run(pendulum, {.integrator = &default_integrator(), .substeps = 20});
    Scene scene = run.lab().scene();
    Lab lab(scene, KeepStart::No);
    RunMonitor monitor(lab.plan(), scene.settings, scene.system, scene.state, 0);
    lab.step();
    State after = lab.scene().state;
    for (Vec3& v : after.velocity) v = {std::sqrt(factor * after.supply.scale), 0.0, 0.0};
    monitor.end_frame(lab.plan(), scene.settings, scene.system, after, lab.last_frame().motion());
    const std::vector<std::string> warnings = monitor.warnings({});
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find(" % of the energy supplied (gain)"), std::string::npos) << warnings[0];
    EXPECT_EQ(warnings[0].find("e+"), std::string::npos) << warnings[0];
  }
}

}  // namespace
}  // namespace hooke
