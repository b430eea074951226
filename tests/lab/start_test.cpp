// "Back to start", "Set as start", "Reset parameters", and which edits change the document.
#include <gtest/gtest.h>

#include <cmath>

#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/forces/terms/gas_leak.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/flat_scene.h"
#include "support/gas_bodies.h"

namespace hooke {
namespace {

const Parameter& row(std::string_view name) { return *find_parameter(name); }

// A pendulum of two springs of different stiffness, and a floor.
Scene pendulum() {
  TestSim sim;
  const PointId nail = sim.nail({0.0, 0.5, 0.0}), middle = sim.add({0.2, 0.3, 0.0}), bob = sim.add({0.4, 0.1, 0.0});
  sim.join(nail, middle, 242.0, 0.3);
  sim.join(middle, bob, 125.0, 0.3);
  Scene scene = flat_scene("Pendulum", sim);
  scene.system.colliders = {{.shape = Plane{{0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}};
  return scene;
}

struct StartFixture {
  explicit StartFixture(Scene scene = pendulum()) : start(scene), lab(std::move(scene)) {}

  template <class Request>
  void ask(Request request, Gesture gesture = 0) {
    lab.submit(std::move(request), gesture);
    apply_now(lab);
  }
  void edit(Command command) { ask(std::move(command)); }
  void frames(int count) {
    for (int i = 0; i < count; ++i) ASSERT_TRUE(lab.step());
  }
  PointId point(Index i) const { return lab.scene().system.points()[i].id; }
  const System& system() const { return lab.scene().system; }
  const State& state() const { return lab.scene().state; }
  bool unsaved() {
    lab.publish();
    return lab.status()->history.unsaved;
  }
  std::vector<std::string> changes() {
    lab.publish();
    return lab.status()->history.list->unsaved;
  }

  Scene start;
  Lab lab;
};

TEST(BackToStart, RestoresTheStateAndKeepsTheParametersTunedDuringTheRun) {
  StartFixture run;
  run.frames(10);
  run.edit(SetParameter{&row("stiffness"), 300.0});
  run.edit(SetParameter{&row("substeps"), 77.0});
  run.edit(SetParameter{&row("gravity"), 1.6});
  run.edit(SetPointProperty{PointProperty::Mass, {{run.point(2), 3.0}}});
  run.edit(SetParameter{&row("friction"), 0.7});
  run.frames(10);
  run.ask(GoToStart{});
  EXPECT_EQ(run.state().position, run.start.state.position);
  EXPECT_EQ(run.state().velocity, run.start.state.velocity);
  EXPECT_EQ(run.state().time, 0.0);
  EXPECT_EQ(run.system().springs()[0].stiffness, 300.0);
  EXPECT_EQ(run.system().springs()[1].stiffness, 300.0);
  EXPECT_EQ(run.lab.scene().settings.substeps, 77);
  EXPECT_EQ(run.system().gravity, (Vec3{0.0, -1.6, 0.0}));
  EXPECT_EQ(run.system().points()[2].mass, 3.0);
  EXPECT_EQ(run.system().colliders[0].friction, 0.7);
}

TEST(BackToStart, RunsToTheSameBitsAgain) {
  StartFixture run;
  run.frames(30);
  const std::uint64_t first = hash_state(run.state());
  run.ask(GoToStart{});
  run.frames(30);
  EXPECT_EQ(hash_state(run.state()), first);
}

TEST(BackToStart, KeepsWhatWasBuiltDuringTheRunWhereItWasPut) {
  StartFixture run;
  run.frames(10);
  const PointId added = run.lab.new_point_id();
  run.edit(Insert{.points = {{.point = {.id = added}, .position = {-0.4, 0.2, 0.0}}}});
  run.edit(Insert{.springs = {{.spring = {.id = run.lab.new_spring_id(), .first = added, .second = run.point(1), .stiffness = 10.0}}}});
  run.edit(SetNailed{{{run.point(2), true}}});
  run.frames(10);
  run.ask(GoToStart{});
  ASSERT_EQ(run.system().point_count(), 4);
  EXPECT_EQ(run.system().spring_count(), 3);
  EXPECT_EQ(run.state().position[3], (Vec3{-0.4, 0.2, 0.0}));
  EXPECT_EQ(run.state().velocity[3], Vec3(0.0));
  EXPECT_EQ(run.state().position[2], run.start.state.position[2]);
  EXPECT_TRUE(run.system().points()[2].nailed);
}

TEST(BackToStart, BringsBackWhatTheHandChangedInTheRun) {
  StartFixture run;
  run.frames(5);
  run.ask(ReleaseNails{});
  run.edit(GrabCollider{{0, {0.0, -0.8, 0.0}}});
  run.frames(3);
  run.edit(ReleaseHand{});
  run.edit(GrabPoint{{.point = run.point(2), .kind = GrabKind::Hold, .target = {0.5, 0.5, 0.0}}});
  run.frames(5);
  EXPECT_FALSE(run.system().points()[0].nailed);
  run.ask(GoToStart{});
  EXPECT_TRUE(run.system().points()[0].nailed);
  EXPECT_EQ(run.system().colliders, run.start.system.colliders);
  EXPECT_FALSE(run.system().grab.has_value());
  EXPECT_EQ(run.state().position, run.start.state.position);
  // and undo leads back into the run
  run.ask(Undo{});
  EXPECT_FALSE(run.system().points()[0].nailed);
  EXPECT_GT(run.state().time, 0.0);
}

TEST(BackToStart, KeepsWhatIsBuiltBeforeTheFirstFrame) {
  StartFixture run;
  run.edit(Move{{{run.point(2), {0.5, 0.0, 0.0}, Vec3(0.0)}}});
  run.ask(ReleaseNails{});
  run.edit(SetNailed{{{run.point(1), true}}});
  run.ask(GoToStart{});
  EXPECT_EQ(run.state().position[2], (Vec3{0.5, 0.0, 0.0}));
  run.frames(5);
  run.ask(GoToStart{});
  EXPECT_EQ(run.state().position[2], (Vec3{0.5, 0.0, 0.0}));
  // releasing all nails by its key never changes the start
  EXPECT_TRUE(run.system().points()[0].nailed);
  EXPECT_TRUE(run.system().points()[1].nailed);
}

TEST(BackToStart, AStartMovedAfterAnEarlierRunIsKeptWhenTheTimelineIsUsed) {
  StartFixture run;
  run.frames(20);
  run.ask(GoToTime{0.0});
  ASSERT_EQ(run.state().time, 0.0);
  run.edit(Move{{{run.point(2), {0.5, 0.0, 0.0}, Vec3(0.0)}}});
  run.ask(GoToTime{0.2});
  run.ask(GoToStart{});
  EXPECT_EQ(run.state().position[2], (Vec3{0.5, 0.0, 0.0}));
}

// A ball of gas, to which the panel of forces gives another leak.
struct LeakyFixture : StartFixture {
  explicit LeakyFixture(double time = 0.0) : StartFixture(leaky_ball(time)) {}
  static Scene leaky_ball(double time) {
    const TestSim sim = gas_ball(1, 50.0, {.pressure = 100.0, .leak = 0.5});
    Scene scene;
    scene.system = sim.system;
    scene.state = sim.state;
    scene.state.time = time;
    scene.settings.substeps = 20;
    initialize_supply(scene.system, scene.state);
    return scene;
  }
  const Force& gas() const { return system().forces.at(0); }
  void set_leak(double leak) {
    SetForces set{system().forces};
    set.forces[0].values[3] = leak;
    continue_leak(gas(), state().time, set.forces[0]);
    edit(set);
  }
  void set_value(std::size_t index, double value) {
    SetForces set{system().forces};
    set.forces[0].values[index] = value;
    edit(set);
  }
};

TEST(BackToStart, BringsBackTheGasThatHasLeakedAndKeepsTheNewLeak) {
  LeakyFixture run;
  run.frames(10);
  run.set_leak(2.0);
  run.frames(10);
  run.set_leak(0.1);
  ASSERT_GT(run.gas().values[4], 0.0);
  // the timeline changes no forces
  const Force tuned = run.gas();
  run.ask(GoToTime{0.0});
  ASSERT_EQ(run.state().time, 0.0);
  EXPECT_EQ(run.gas(), tuned);
  run.ask(Undo{});
  run.ask(GoToStart{});
  EXPECT_EQ(run.gas(), gas_force({.pressure = 100.0, .leak = 0.1}));
  // and again, after undoing that
  run.ask(Undo{});
  ASSERT_GT(run.gas().values[4], 0.0);
  run.ask(GoToStart{});
  EXPECT_EQ(run.gas(), gas_force({.pressure = 100.0, .leak = 0.1}));
}

TEST(BackToStart, KeepsWhatThePumpAndTheStartOfTheLeakWereSetTo) {
  LeakyFixture run;
  run.frames(10);
  run.set_leak(2.0);
  run.set_value(0, 300.0);
  run.ask(GoToStart{});
  EXPECT_EQ(run.gas(), gas_force({.pressure = 300.0, .leak = 2.0}));
  run.frames(10);
  run.set_value(4, 0.1);
  run.ask(GoToStart{});
  EXPECT_EQ(run.gas(), gas_force({.pressure = 300.0, .leak = 2.0, .leak_start = 0.1}));
}

// Of a document that starts in the middle of a run, what had leaked before is gone.
TEST(BackToStart, KeepsWhatHadLeakedBeforeTheStart) {
  LeakyFixture run(3.0);
  run.frames(10);
  run.set_leak(2.0);
  run.ask(GoToStart{});
  const Force& gas = run.gas();
  EXPECT_EQ(gas.values[4], 3.0);
  EXPECT_EQ(gas.values[3], 2.0);
  EXPECT_NEAR(gas.values[0], 100.0 * std::exp(-0.5 * 3.0), 1e-12);
}

TEST(SetAsStart, MakesTheStateOnScreenTheOneToGoBackTo) {
  StartFixture run;
  run.frames(12);
  run.ask(ReleaseNails{});
  const State state = run.state();
  run.ask(SetStart{});
  EXPECT_EQ(run.changes(), std::vector<std::string>{"set the start"});
  run.frames(12);
  run.ask(GoToStart{});
  EXPECT_EQ(run.state().position, state.position);
  EXPECT_EQ(run.state().velocity, state.velocity);
  EXPECT_EQ(run.state().time, state.time);
  EXPECT_FALSE(run.system().points()[0].nailed);
}

TEST(ResetParameters, RestoresThoseOfTheFileInOneStepAndKeepsTheState) {
  StartFixture run;
  const System opened = run.system();
  run.edit(SetParameter{&row("stiffness"), 300.0});
  run.frames(10);
  run.edit(SetParameter{&row("substeps"), 77.0});
  run.edit(SetParameter{&row("gravity"), 1.6});
  run.edit(SetParameter{&row("radius"), 0.05});
  run.edit(SetParameter{&row("friction"), 0.7});
  run.edit(SetPointProperty{PointProperty::Mass, {{run.point(2), 3.0}}});
  run.edit(SetIntegrator{find_integrator("runge_kutta4")});
  const System tuned = run.system();
  const State state = run.state();
  run.ask(ResetParameters{});
  EXPECT_EQ(run.system(), opened);
  EXPECT_EQ(run.lab.scene().settings, run.start.settings);
  EXPECT_EQ(run.state().position, state.position);
  EXPECT_EQ(run.state().time, state.time);
  EXPECT_EQ(run.lab.status()->history.undo_name, "reset parameters");
  run.ask(Undo{});
  EXPECT_EQ(run.system(), tuned);
  EXPECT_EQ(run.lab.scene().settings.substeps, 77);
}

TEST(UnsavedChanges, AreNotMadeByPlayingWithARunningScene) {
  StartFixture run;
  run.frames(3);
  run.edit(GrabPoint{{.point = run.point(2), .kind = GrabKind::Hold, .target = {0.5, 0.5, 0.0}}});
  run.frames(3);
  run.edit(ReleaseHand{});
  run.ask(ReleaseNails{});
  run.frames(3);
  run.edit(Move{{{run.point(2), {0.0, 0.0, 0.0}, Vec3(0.0)}}});
  run.edit(SetNailed{{{run.point(0), true}}});
  run.ask(GoToTime{0.0});
  run.ask(GoToStart{});
  EXPECT_FALSE(run.unsaved());
  // though all of it can be undone
  EXPECT_FALSE(run.lab.status()->history.undo_name.empty());
}

TEST(UnsavedChanges, AreThoseOfStructureParametersAndStart) {
  const auto after = [](bool runs, const Command& command) {
    StartFixture run;
    if (runs) run.frames(3);
    run.edit(command);
    return run.changes();
  };
  StartFixture ids;
  for (const bool runs : {false, true}) {
    EXPECT_EQ(after(runs, SetParameter{&row("stiffness"), 185.0}), std::vector<std::string>{"set Stiffness k to 185 N/m"});
    EXPECT_EQ(after(runs, Remove{.points = {ids.point(2)}}), std::vector<std::string>{"delete 1 point"});
    EXPECT_EQ(after(runs, SetNailed{{{ids.point(1), true}}}), std::vector<std::string>{"nail 1 point"});
  }
  // where the scene starts, its positions are its start
  const Move move{{{ids.point(2), {0.5, 0.0, 0.0}, Vec3(0.0)}}};
  EXPECT_EQ(after(false, move), std::vector<std::string>{"move 1 point"});
  EXPECT_EQ(after(true, move), std::vector<std::string>{});
}

TEST(UnsavedChanges, EndWhereTheSavedDocumentIsReachedAgain) {
  StartFixture run;
  run.edit(SetParameter{&row("drag"), 1.0});
  run.ask(MarkSaved{});
  EXPECT_FALSE(run.unsaved());
  run.edit(SetParameter{&row("drag"), 2.0});
  EXPECT_TRUE(run.unsaved());
  run.ask(Undo{});
  EXPECT_FALSE(run.unsaved());
  run.ask(Undo{});
  EXPECT_EQ(run.changes(), std::vector<std::string>{"undo set Drag c to 1 1/s"});
  // the saved document cannot be reached any more
  run.edit(SetParameter{&row("gravity"), 5.0});
  EXPECT_EQ(run.changes().size(), 2u);
  run.ask(Undo{});
  EXPECT_TRUE(run.unsaved());
  run.ask(MarkSaved{});
  EXPECT_FALSE(run.unsaved());
}

TEST(UnsavedChanges, AreMadeByADragThatContinuesAfterSaving) {
  StartFixture run;
  run.ask(Command(SetParameter{&row("drag"), 1.0}), 5);
  run.ask(MarkSaved{});
  run.ask(Command(SetParameter{&row("drag"), 2.0}), 5);
  EXPECT_TRUE(run.unsaved());
}

TEST(RunTo, AnEarlierTimeGoesBackToIt) {
  StartFixture run;
  run.frames(30);
  run.ask(RunTo{0.25});
  EXPECT_NEAR(run.state().time, 0.25, 1e-9);
  EXPECT_FALSE(run.lab.status()->run.running);
}

}  // namespace
}  // namespace hooke
