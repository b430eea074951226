// Remedies for runs that diverge: every recommended setting is stable.
#include "study/remedy/remedy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>

#include "lab/lab.h"
#include "sim/model/force_term.h"
#include "study/hard_cases/test_network.h"
#include "study/run_monitor.h"
#include "support/force_with.h"
#include "support/parts.h"

namespace hooke {
namespace {

constexpr double seconds = 2.0;
const std::atomic<bool> never = false;

struct DivergingScene {
  std::string name;
  Scene scene;
};

Scene scene_of(TestNetwork network, const char* method, int substeps) {
  Scene scene;
  scene.system = std::move(network.system);
  scene.state = std::move(network.state);
  scene.settings.integrator = find_integrator(method);
  scene.settings.substeps = substeps;
  return scene;
}

// A sheet of 5 x 5 points, 1 m, 1 kg, free, each point displaced at random by up to `shake` [m].
TestNetwork shaken_sheet(double stiffness, double shake, std::uint64_t seed) {
  TestNetwork sheet = make_sheet({.rows = 5,
                                  .columns = 5,
                                  .across = {0.25, 0.0, 0.0},
                                  .down = {0.0, -0.25, 0.0},
                                  .mass = 0.04,
                                  .stiffness = stiffness,
                                  .diagonal_stiffness = stiffness});
  sheet.system.gravity = Vec3(0.0);
  Random random(seed);
  for (Vec3& x : sheet.state.position) x += random.vector(shake);
  return sheet;
}

bool runs_through(const Scene& scene, double duration) {
  Lab lab(scene, KeepStart::No);
  for (long frame = std::lround(duration * scene.settings.frame_rate); frame > 0; --frame)
    if (!lab.step()) return false;
  return true;
}

// Of the step and of the run monitor, as `hooke run` prints them.
std::vector<std::string> warnings_of(const Scene& scene, double duration) {
  std::vector<std::string> list;
  for (const auto& warning : {unused_setting_warning(scene.settings), step_warning(scene.system, scene.state, scene.settings),
                              oscillation_warning(scene.system, scene.settings)})
    if (warning) list.push_back(*warning);
  Lab lab(scene, KeepStart::No);
  RunMonitor monitor(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state, 0);
  for (long frame = std::lround(duration * scene.settings.frame_rate); frame > 0 && lab.step(); --frame)
    monitor.end_frame(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state, lab.last_frame().motion());
  std::ranges::move(monitor.warnings({}), std::back_inserter(list));
  return list;
}

// Diverging scenes of several kinds.
std::vector<DivergingScene> diverging_scenes() {
  std::vector<DivergingScene> list;
  const auto add = [&](std::string name, Scene scene) { list.push_back({std::move(name), std::move(scene)}); };
  std::uint64_t seed = 1;

  // a step beyond the stability limit
  for (const char* method : {"symplectic_euler", "velocity_verlet", "blanes_moan4", "runge_kutta4"})
    for (const double stiffness : {3e4, 1e5, 3e5, 1e6})
      add(std::string("step ") + method, scene_of(shaken_sheet(stiffness, 0.02, seed++), method, 2));

  // a method that amplifies every undamped mode
  for (const double stiffness : {1e2, 1e3, 1e4})
    add("explicit_euler", scene_of(shaken_sheet(stiffness, 0.05, seed++), "explicit_euler", 20));

  // listed forces that are too strong for the step
  for (const char* method : {"velocity_verlet", "runge_kutta4", "symplectic_euler", "blanes_moan4", "implicit_euler"}) {
    Scene scene = scene_of(shaken_sheet(1e2, 0.05, seed++), method, 4);
    for (Vec3& v : scene.state.velocity) v.x = 1.0;
    scene.system.forces.push_back(force_with("mass_center", {{"stiffness", 100.0}, {"damping", 900.0}}));
    add(std::string("mass_center ") + method, std::move(scene));
  }
  for (const char* method : {"velocity_verlet", "runge_kutta4", "symplectic_euler"}) {
    Scene scene = scene_of(shaken_sheet(1e2, 0.05, seed++), method, 1);
    scene.system.forces.push_back(force_with("center", {{"strength", 1000.0}, {"power", -3.0}}));
    add(std::string("center ") + method, std::move(scene));
  }

  // springs that rotate far, at the linear stability limit
  for (int i = 0; i < 12; ++i) {
    Scene scene = scene_of(shaken_sheet(2e3, 0.2, 100 + seed++), i % 2 == 0 ? "velocity_verlet" : "symplectic_euler", 1);
    scene.settings.substeps = *StepLimits(bound_spectrum(scene.system)).stable_substeps(*scene.settings.integrator, 60.0);
    add("rotation", std::move(scene));
  }

  // contact with a step far too long for the springs
  for (const char* method : {"velocity_verlet", "implicit_midpoint", "xpbd"}) {
    Scene scene = scene_of(shaken_sheet(1e5, 0.02, seed++), method, method[0] == 'v' ? 8 : 1);
    scene.system.gravity = {0.0, -9.8, 0.0};
    scene.system.colliders.push_back({.shape = Plane{{0.0, -1.5, 0.0}, {0.0, 1.0, 0.0}}, .restitution = 0.5, .friction = 0.5});
    add(std::string("contact ") + method, std::move(scene));
  }

  // a hand whose spring is too stiff for the step
  for (const char* method : {"velocity_verlet", "symplectic_euler", "runge_kutta4", "blanes_moan4"}) {
    Scene scene = scene_of(shaken_sheet(1e2, 0.02, seed++), method, 4);
    scene.system.grab = Grab{.point = scene.system.points()[12].id, .kind = GrabKind::Pull, .stiffness = 1e5};
    scene.state.hand = {.position = scene.state.position[12], .target = {3.0, 0.0, 0.0}};
    add(std::string("hand ") + method, std::move(scene));
  }
  return list;
}

// The causes that `find_remedy` may name for each kind of divergence.
bool is_expected_cause(const std::string& kind, Remedy::Cause cause) {
  using enum Remedy::Cause;
  if (kind.starts_with("step") || kind.starts_with("explicit_euler")) return cause == StepTooLong;
  if (kind.starts_with("rotation")) return cause == Springs;
  if (kind.starts_with("mass_center") || kind.starts_with("center")) return cause == Force || cause == StepTooLong;
  if (kind.starts_with("hand")) return cause == Hand || cause == StepTooLong;
  return cause != NotReproduced;
}

class Remedies : public InParts<8> {};
INSTANTIATE_TEST_SUITE_P(Daily, Remedies, testing::Values(0));
INSTANTIATE_TEST_SUITE_P(Nightly, Remedies, testing::Range(1, Remedies::parts));

TEST_P(Remedies, AreStable) {
  int number = 0, diverged = 0, cured = 0, without_warning = 0;
  std::map<std::string, int> stable;
  for (const DivergingScene& scene_case : diverging_scenes()) {
    if (!has(number++)) continue;
    if (runs_through(scene_case.scene, seconds)) {
      ++stable[scene_case.name];
      continue;
    }
    ++diverged;
    const Remedy remedy = find_remedy(scene_case.scene, seconds, never);
    const std::string description = scene_case.name + ": " + describe(remedy, scene_case.scene.settings);
    EXPECT_TRUE(is_expected_cause(scene_case.name, remedy.cause)) << description;
    if (!remedy.cheapest) continue;
    ++cured;
    Scene scene = scene_case.scene;
    scene.settings.integrator = remedy.cheapest->advice.integrator;
    scene.settings.substeps = remedy.cheapest->advice.substeps;
    EXPECT_TRUE(runs_through(scene, 2.0 * seconds)) << description;
    EXPECT_EQ(warnings_of(scene, remedy.cheapest->seconds), remedy.cheapest->warnings) << description;
    without_warning += remedy.cheapest->warnings.empty() ? 1 : 0;
  }
  std::string names;
  for (const auto& [name, count] : stable) names += name + " ";
  EXPECT_GE(diverged, 3) << "not diverged: " << names;
  EXPECT_GE(cured, diverged - 1);
  EXPECT_GE(without_warning, cured - 1);
}

// The number of substeps that is shown below the slider and the recommended one differ by a margin.
TEST(Remedy, KeepsTheMarginBelowTheLinearLimit) {
  const Scene scene = scene_of(shaken_sheet(1e5, 0.02, 1), "velocity_verlet", 2);
  const Remedy remedy = find_remedy(scene, seconds, never);
  ASSERT_TRUE(remedy.cheapest);
  const TestedSetting& same = remedy.same_method ? *remedy.same_method : *remedy.cheapest;
  ASSERT_EQ(same.advice.integrator, scene.settings.integrator);
  const auto limit = StepLimits(bound_spectrum(scene.system)).stable_substeps(*same.advice.integrator, scene.settings.frame_rate);
  EXPECT_EQ(same.advice.substeps, 4 * *limit);
}

// The cheapest setting of any method comes first, and one that keeps the method second.
TEST(Remedy, IsTheCheapestSettingAndOneThatKeepsTheMethod) {
  const Scene scene = scene_of(shaken_sheet(1e8, 0.02, 1), "runge_kutta4", 4);
  ASSERT_FALSE(runs_through(scene, 0.5));
  const Remedy remedy = find_remedy(scene, 0.5, never);
  ASSERT_TRUE(remedy.cheapest) << describe(remedy, scene.settings);
  EXPECT_NE(remedy.cheapest->advice.integrator, scene.settings.integrator) << describe(remedy, scene.settings);
  EXPECT_LT(remedy.cheapest->duration, 1.0) << describe(remedy, scene.settings);
  if (!remedy.same_method) return;
  EXPECT_EQ(remedy.same_method->advice.integrator, scene.settings.integrator);
  EXPECT_GT(remedy.same_method->duration, remedy.cheapest->duration);
}

// A plate below a sheet that diverges, at 500 Hz: 134 substeps resolve it, fewer keep the sheet stable.
TEST(Remedy, ResolvesCollidersThatOscillate) {
  for (const char* method : {"velocity_verlet", "symplectic_euler", "explicit_euler", "implicit_midpoint"}) {
    Scene scene = scene_of(shaken_sheet(method[0] == 'i' ? 1e7 : 3e4, 0.02, 3), method, 2);
    scene.system.colliders.push_back(
        {.shape = Plane{.point = {0.0, -20.0, 0.0}}, .path = {.amplitude = {0.0, 1e-3, 0.0}, .frequency = 500.0}});
    const auto expect_resolved = [&](const std::optional<TestedSetting>& tested) {
      if (!tested) return;
      Settings settings = scene.settings;
      settings.integrator = tested->advice.integrator;
      settings.substeps = tested->advice.substeps;
      EXPECT_FALSE(oscillation_warning(scene.system, settings)) << method << ": " << describe(tested->advice);
    };
    const Remedy remedy = find_remedy(scene, 0.2, never);
    ASSERT_TRUE(remedy.cheapest || remedy.cause == Remedy::Cause::NotReproduced) << method;
    expect_resolved(remedy.cheapest);
    expect_resolved(remedy.same_method);
    if (!remedy.cheapest) continue;
    EXPECT_TRUE(remedy.cheapest->warnings.empty()) << method << ": " << describe(remedy, scene.settings);
  }
}

TEST(Remedy, IsAbsentForAStableRun) {
  const Remedy remedy = find_remedy(scene_of(shaken_sheet(1e2, 0.02, 1), "velocity_verlet", 20), 0.5, never);
  EXPECT_EQ(remedy.cause, Remedy::Cause::NotReproduced);
  EXPECT_FALSE(remedy.cheapest);
}

TEST(Remedy, StopsWhenItsWorkLimitIsReached) {
  const Scene scene = scene_of(shaken_sheet(1e2, 0.02, 1), "velocity_verlet", 20);
  const Remedy remedy = find_remedy(scene, seconds, never, 2e5);
  EXPECT_FALSE(remedy.cheapest);
  EXPECT_EQ(remedy.cause, Remedy::Cause::SearchLimit);
  EXPECT_GT(remedy.reached, 0.0);
  EXPECT_LT(remedy.reached, seconds);
  const std::string description = describe(remedy, scene.settings);
  EXPECT_NE(description.find("the work limit of the search was reached at t = "), std::string::npos) << description;
}

// With any work limit: a limit that is reached is not evidence.
TEST(Remedy, NamesACauseOnlyWhereItWasTested) {
  int limited = 0, not_found = 0;
  for (const DivergingScene& scene_case : diverging_scenes()) {
    if (!scene_case.name.starts_with("rotation") && !scene_case.name.starts_with("hand")) continue;
    const Remedy::Cause full = find_remedy(scene_case.scene, seconds, never).cause;
    if (full == Remedy::Cause::NotReproduced || full == Remedy::Cause::StepTooLong) continue;
    for (double work = 1e3;; work *= 1.2) {
      const Remedy::Cause cause = find_remedy(scene_case.scene, seconds, never, work).cause;
      if (cause == full) break;
      limited += cause == Remedy::Cause::SearchLimit ? 1 : 0;
      not_found += cause == Remedy::Cause::NotFound ? 1 : 0;
      ASSERT_TRUE(cause == Remedy::Cause::SearchLimit || cause == Remedy::Cause::NotFound)
          << scene_case.name << " " << work << " " << static_cast<int>(cause);
    }
  }
  EXPECT_GT(limited, 0);
  EXPECT_GT(not_found, 0);
}

// Where no fixed step that was tried is short enough: a fall through a center whose core is a millionth of the way.
TEST(Remedy, CanBeAMethodThatChoosesItsSteps) {
  TestNetwork network;
  network.add({0.3, 0.0, 0.0});
  network.system.gravity = Vec3(0.0);
  network.system.forces = {force_with("center", {{"strength", 1.0}, {"power", 2.0}, {"core", 1e-6}})};
  Scene scene = scene_of(std::move(network), "velocity_verlet", 20);
  ASSERT_FALSE(runs_through(scene, seconds));
  const Remedy remedy = find_remedy(scene, seconds, never);
  ASSERT_TRUE(remedy.cheapest) << describe(remedy, scene.settings);
  EXPECT_EQ(remedy.cheapest->advice.integrator->id, "dop853");
  scene.settings.integrator = remedy.cheapest->advice.integrator;
  scene.settings.substeps = remedy.cheapest->advice.substeps;
  EXPECT_TRUE(runs_through(scene, 2.0 * seconds));
  EXPECT_EQ(warnings_of(scene, remedy.cheapest->seconds), remedy.cheapest->warnings);
}

// A stiff chain of `points`, and steep centers at x [m] and 1 m further, in which no step that is stable for its springs is short enough.
Scene chain_and_centers(int points, double x, const char* method, int substeps) {
  TestNetwork network;
  for (int i = 0; i < points; ++i) network.add({0.2 * i, 0.3, 0.0}, 0.05);
  for (Index i = 1; i < points; ++i) network.join(network.system.points()[i - 1].id, network.system.points()[i].id, 1e5);
  for (const double at : {x, x + 1.0})
    network.system.forces.push_back(force_with("center", {{"x", at}, {"y", 0.25}, {"strength", -0.3}, {"power", 2.4}, {"core", 3e-4}}));
  return scene_of(std::move(network), method, substeps);
}

// What a run with the advice would print about its step is part of the advice.
TEST(Remedy, StatesTheWarningsOfTheAdvisedRun) {
  int warned = 0;
  for (const char* method : {"explicit_euler", "velocity_verlet", "runge_kutta4"}) {
    Scene scene = chain_and_centers(12, 50.0, method, 3);
    scene.state.velocity[3] = {3.0, 2.0, 1.0};
    ASSERT_FALSE(runs_through(scene, seconds));
    const Remedy remedy = find_remedy(scene, seconds, never, 7e7);
    const std::string description = describe(remedy, scene.settings);
    ASSERT_TRUE(remedy.cheapest) << description;
    scene.settings.integrator = remedy.cheapest->advice.integrator;
    scene.settings.substeps = remedy.cheapest->advice.substeps;
    const std::vector<std::string> warnings = warnings_of(scene, remedy.cheapest->seconds);
    EXPECT_EQ(remedy.cheapest->warnings, warnings) << description;
    for (const std::string& warning : warnings) EXPECT_NE(description.find(warning), std::string::npos) << description;
    EXPECT_EQ(description.find("but there ") != std::string::npos, !warnings.empty()) << description;
    warned += warnings.empty() ? 0 : 1;
  }
  EXPECT_GT(warned, 0);
}

// A stiff bar of grains in wind, which nothing resolves: with Implicit Euler the energy rises to several times what was supplied.
TEST(Remedy, IsNeverASettingThatGainsMoreEnergyThanWasSupplied) {
  TestNetwork bar;
  const double mass[] = {1.7e-8, 5.5e-8, 1.9e-7};
  for (Index i = 0; i < 3; ++i) {
    bar.add({0.1, 0.1 * i, 0.0}, mass[i]);
    bar.system.point(i).radius = i == 0 ? 0.02 : 0.05;
  }
  bar.join(bar.system.points()[0].id, bar.system.points()[1].id, 2.4e8, 0.1, 1.8e-4);
  bar.system.gravity = {0.0, -0.094, 0.0};
  bar.system.contact = {.points = true, .restitution = 0.41, .friction = 2.0};
  bar.system.forces = {force_with("wind", {{"x", -12.0}, {"y", -2.5}})};
  initialize_supply(bar.system, bar.state);
  const Scene scene = scene_of(std::move(bar), "symplectic_euler", 5);
  ASSERT_FALSE(runs_through(scene, 0.5));
  const Remedy remedy = find_remedy(scene, 0.5, never);
  const auto gain_of = [&](const Advice& advice) {
    Scene copy = scene;
    copy.settings.integrator = advice.integrator;
    copy.settings.substeps = advice.substeps;
    Lab lab(copy, KeepStart::No);
    double gain = 0.0;
    for (int frame = 0; frame < 30 && lab.step(); ++frame) {
      const State& state = lab.scene().state;
      gain = std::max(gain, (compute_energy(lab.scene().system, state).total() - state.supply.net_input) / state.supply.scale);
    }
    return gain;
  };
  EXPECT_GT(gain_of({find_integrator("implicit_euler"), 5}), 1.5);
  if (remedy.cheapest) {
    EXPECT_LT(gain_of(remedy.cheapest->advice), 1.5) << describe(remedy, scene.settings);
  }
}

// Numbers of substeps that would take minutes: what was not tried is said.
TEST(Remedy, NamesTheSettingsThatTheWorkLimitExcludes) {
  Scene scene = chain_and_centers(60, 50.0, "velocity_verlet", 3);
  scene.state.velocity[3] = {3.0, 2.0, 1.0};
  ASSERT_FALSE(runs_through(scene, seconds));
  const Remedy remedy = find_remedy(scene, seconds, never, 2e7);
  EXPECT_GT(remedy.settings_cut_short, 0);
  EXPECT_GT(remedy.settings_left, 0);
  if (remedy.cheapest) return;
  const std::string description = describe(remedy, scene.settings);
  EXPECT_NE(description.find("of them only up to the work limit of the search; "), std::string::npos) << description;
}

// [ns], of the first frame.
double work_of_frame(const Scene& scene) {
  Lab lab(scene, KeepStart::No);
  TrialWork work(lab.plan());
  double sum = 0.0;
  lab.watch_substeps([&] { sum += work.since_last(lab.last_frame(), false); });
  lab.step();
  return sum + work.since_last(lab.last_frame(), true);
}

// Laws with powers, and the steps that a method chooses, are counted.
TEST(Remedy, CountsTheWorkOfForcesAndOfStepsThatAMethodChooses) {
  Scene scene = chain_and_centers(60, 0.05, "velocity_verlet", 40), without = scene;
  without.system.forces.clear();
  EXPECT_GT(work_of_frame(scene), 4.0 * work_of_frame(without));
  EXPECT_NEAR(work_of_frame(chain_and_centers(60, 0.05, "velocity_verlet", 80)), 2.0 * work_of_frame(scene), 0.1 * work_of_frame(scene));
  // a frame through a core takes hundreds of steps, whatever the number of substeps
  Scene adaptive = chain_and_centers(12, 0.05, "dop853", 1);
  EXPECT_GT(work_of_frame(adaptive), 10.0 * work_of_frame(chain_and_centers(12, 0.05, "velocity_verlet", 1)));
}

TEST(Remedy, NamesWhatKeepsTheMethodWhereThatIsTooExpensiveToTest) {
  Remedy remedy{.cause = Remedy::Cause::StepTooLong, .cheapest = TestedSetting{{find_integrator("baraff_witkin"), 16}, 0.6, 2.5, {}}};
  remedy.untested = TestedSetting{{find_integrator("runge_kutta4"), 2156}, 0.03, 50.0, {}};
  const std::string text = describe(remedy, {.integrator = find_integrator("runge_kutta4")});
  EXPECT_NE(text.find("(Runge-Kutta 4 with 2156 substeps per frame, at 0.02\u00d7 real time, takes too long to be tested)"), text.npos)
      << text;
}

// A remedy that is slower than real time is named with its speed.
TEST(Remedy, NamesTheSpeedOfASlowSetting) {
  const Scene scene = scene_of(shaken_sheet(1e5, 0.02, 1), "velocity_verlet", 2);
  Remedy remedy = find_remedy(scene, seconds, never);
  ASSERT_TRUE(remedy.cheapest);
  Scene advised = scene;
  advised.settings.integrator = remedy.cheapest->advice.integrator;
  advised.settings.substeps = remedy.cheapest->advice.substeps;
  const double expected = 1e-9 * scene.settings.frame_rate * work_of_frame(advised);
  EXPECT_NEAR(remedy.cheapest->duration, expected, 0.3 * expected);
  remedy.same_method.reset();
  EXPECT_EQ(describe(remedy, scene.settings).find("real time"), std::string::npos);
  remedy.cheapest->duration = 36.2;
  const std::string description = describe(remedy, scene.settings);
  EXPECT_NE(description.find("; about 0.028\u00d7 real time)"), std::string::npos) << description;
}

}  // namespace
}  // namespace hooke
