// Breaking springs, tearing and cutting of cloth; limits of hand speed and strain.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "edit/apply.h"
#include "edit/history.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/hand.h"
#include "sim/hash.h"
#include "support/apply_now.h"
#include "support/convergence.h"
#include "support/scratch_folder.h"
#include "support/trial.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;

Scene parse(const std::string& text) { return parse_scene(text, "test").scene; }

// A sheet of 8 x 8 points, hung by two corners, that tears under its own weight.
Scene weak_sheet(const Integrator& method) {
  Scene scene = parse(R"({"hooke": 1, "break_strain": 0.12, "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0],
    "down": [0, -1, 0.3], "points": [8, 8], "mass": 1, "stiffness": 120, "damping": 0.2, "nail": ["top_left", "top_right"]}],
    "simulation": {"substeps": 20}})");
  scene.settings.integrator = &method;
  return scene;
}

void run(Lab& lab, int frames) {
  for (int i = 0; i < frames; ++i) ASSERT_TRUE(lab.step()) << "frame " << i;
}
void submit_and_apply(Lab& lab, const Control& control) {
  lab.submit(control);
  apply_now(lab);
}

class Tearing : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Tearing, testing::ValuesIn(every_method()), method_name);

// the spring breaks in the first substep at whose end it exceeds its strain; then its end falls freely
TEST_P(Tearing, ASpringBreaksAtItsStrainAndExertsNoForceAfterwards) {
  Trial trial;
  const PointId top = trial.nail(Vec3(0.0)), weight = trial.add({0.0, -1.0, 0.0}, 1.0, {0.0, -3.0, 0.0});
  const SpringId spring = trial.join(top, weight, 50.0, 1.0);
  trial.system.spring(0).break_strain = 0.2;
  Plan plan = make_plan(trial.system);
  Frame step;
  const Settings settings{.integrator = &method(), .substeps = 20};
  double broke = 0.0;
  Vec3 v(0.0);
  for (int i = 0; i < 20; ++i) {
    step.begin(plan, trial.system, settings, trial.state);
    while (!step.done()) step.substep(plan);
    step.end(plan, trial.state);
    if (step.broken().empty()) continue;
    EXPECT_EQ(broke, 0.0) << "a spring breaks only once";
    EXPECT_EQ(trial.system.springs()[step.broken()[0]].id, spring);
    EXPECT_GE(-trial.state.position[1].y, 1.2);
    broke = trial.state.time;
    v = trial.state.velocity[1];
    // at least 1/2 k (l - l0)^2
    EXPECT_LE(trial.state.ledger.net_input, -0.5 * 50.0 * 0.2 * 0.2);
    EXPECT_GT(trial.state.ledger.net_input, -0.5 * 50.0 * 0.22 * 0.22);
  }
  ASSERT_GT(broke, 0.0);
  EXPECT_NEAR(trial.state.velocity[1].y, v.y - 9.81 * (trial.state.time - broke), 1e-9);
}

TEST_P(Tearing, ASheetTearsWithItsFacesAndUndoRestoresItExactly) {
  const Scene start = weak_sheet(method());
  Lab lab(start);
  run(lab, 30);
  const System torn = lab.scene().system;
  ASSERT_LT(torn.spring_count(), start.system.spring_count() - 4);
  ASSERT_LT(torn.faces.size(), start.system.faces.size());
  // no face is left along a broken spring
  std::set<std::pair<PointId, PointId>> left;
  for (const Spring& spring : torn.springs()) left.insert(std::minmax(spring.first, spring.second));
  for (const Spring& spring : start.system.springs())
    for (const Face& face : torn.faces)
      for (int c = 0; c < 3; ++c) {
        const auto edge = std::minmax(face.points[c], face.points[(c + 1) % 3]);
        if (edge == std::minmax(spring.first, spring.second)) {
          EXPECT_TRUE(left.contains(edge));
        }
      }

  lab.publish();
  EXPECT_EQ(lab.status()->history.undo_name, "tear");
  const State state = lab.scene().state;
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system, start.system);
  EXPECT_EQ(lab.scene().state.position, state.position);
  EXPECT_EQ(lab.scene().state.velocity, state.velocity);
  submit_and_apply(lab, Redo{});
  EXPECT_EQ(lab.scene().system, torn);
}

TEST_P(Tearing, IsReproducibleBitForBitAndContinuesFromAFileBitForBit) {
  Lab first(weak_sheet(method())), second(weak_sheet(method()));
  run(first, 20);
  run(second, 20);
  EXPECT_EQ(hash_state(first.scene().state), hash_state(second.scene().state));
  ASSERT_LT(first.scene().system.spring_count(), weak_sheet(method()).system.spring_count());

  Lab from_file(parse(format_scene(first.scene())));
  EXPECT_EQ(from_file.scene().system.faces.size(), first.scene().system.faces.size());
  // the step memory of an adaptive method is not stored in files
  if (method().stability == Stability::Adaptive) return;
  run(first, 10);
  run(from_file, 10);
  EXPECT_EQ(first.scene().state.position, from_file.scene().state.position);
  EXPECT_EQ(first.scene().state.velocity, from_file.scene().state.velocity);
}

TEST(Tearing, UnderTheHandIsUndoneTogetherWithTheDrag) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.gravity = Vec3(0.0);
  Lab lab(scene);
  const PointId corner = scene.system.points()[63].id;
  lab.submit(GrabPoint{{.point = corner, .kind = GrabKind::Hold, .target = scene.state.position[63]}}, 7);
  for (int i = 1; i <= 40; ++i) {
    lab.submit(MoveHand{scene.state.position[63] + Vec3(0.05 * i, -0.05 * i, 0.0)}, 7);
    ASSERT_TRUE(lab.step());
  }
  lab.submit(ReleaseHand{}, 7);
  ASSERT_TRUE(lab.step());
  EXPECT_LT(lab.scene().system.spring_count(), scene.system.spring_count());
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system, scene.system);
  lab.publish();
  EXPECT_EQ(lab.status()->history.undo_name, "");
}

// springs that break in a frame that is discarded or left unfinished are not broken
TEST(Tearing, ADiscardedFrameBreaksNothing) {
  const Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  Lab whole(scene), cut_short(scene);
  cut_short.submit(SetRunning{true});
  int substeps = 0;
  for (int i = 0; i < 40; ++i) {
    cut_short.advance(frame, [&] { return ++substeps % 21 != 0; });
    cut_short.submit(Move{});  // discards the frame in progress with everything that broke in it
  }
  const long frames = [&] {
    cut_short.publish();
    return cut_short.status()->run.frames;
  }();
  run(whole, static_cast<int>(frames));
  ASSERT_LT(whole.scene().system.spring_count(), scene.system.spring_count());
  EXPECT_EQ(whole.scene().state.position, cut_short.scene().state.position);
  EXPECT_EQ(whole.scene().system, cut_short.scene().system);
}

// The run of a tearing sheet: its state after each frame.
struct TornRun {
  Lab lab{weak_sheet(*find_integrator("velocity_verlet"))};
  std::vector<System> systems{lab.scene().system};
  std::vector<std::uint64_t> hashes{hash_state(lab.scene().state)};
  explicit TornRun(int frames) {
    for (int i = 0; i < frames; ++i) go_on();
    EXPECT_GT(std::set<Index>(counts.begin(), counts.end()).size(), 3u) << "the sheet must tear in several frames";
  }
  void go_on() {
    ASSERT_TRUE(lab.step());
    systems.push_back(lab.scene().system);
    hashes.push_back(hash_state(lab.scene().state));
    counts.push_back(lab.scene().system.spring_count());
  }
  void expect_at(std::size_t moment) const {
    EXPECT_EQ(hash_state(lab.scene().state), hashes[moment]) << "moment " << moment;
    EXPECT_TRUE(lab.scene().system == systems[moment]) << "moment " << moment;
  }
  std::vector<Index> counts;
};

TEST(Tearing, IsRevertedByGoingBackInTimeAndRepeatedLater) {
  TornRun run(40);
  for (std::size_t moment = 40; moment-- > 0;) {
    submit_and_apply(run.lab, StepBack{});
    run.expect_at(moment);
  }
  for (const std::size_t moment : {40, 17, 25, 3, 39, 0, 40}) {
    submit_and_apply(run.lab, GoToTime{static_cast<double>(moment) * frame});
    run.expect_at(moment);
  }
  // from there it continues as before
  submit_and_apply(run.lab, GoToTime{10 * frame});
  for (std::size_t moment = 11; moment <= 40; ++moment) {
    ASSERT_TRUE(run.lab.step());
    run.expect_at(moment);
  }
}

TEST(Tearing, IsUndoneStepByStepThroughTimeJumps) {
  TornRun run(40);
  const std::size_t whole =
      static_cast<std::size_t>(std::ranges::upper_bound(run.counts, run.counts[0], std::greater()) - run.counts.begin());
  submit_and_apply(run.lab, GoToTime{static_cast<double>(whole) * frame});
  run.expect_at(whole);
  // with other parameters the sheet does not tear, until it is made as weak as before
  run.lab.submit(SetParameter{find_parameter("break_strain"), 10.0});
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(run.lab.step());
  EXPECT_EQ(run.lab.scene().system.spring_count(), run.systems[0].spring_count());
  run.lab.submit(SetParameter{find_parameter("break_strain"), 0.08});
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(run.lab.step());
  const System otherwise = run.lab.scene().system;
  ASSERT_LT(otherwise.spring_count(), run.systems[0].spring_count());

  submit_and_apply(run.lab, Undo{});  // the tear
  EXPECT_EQ(run.lab.scene().system.spring_count(), run.systems[0].spring_count());
  submit_and_apply(run.lab, Undo{});
  submit_and_apply(run.lab, Undo{});  // both settings
  submit_and_apply(run.lab, Undo{});  // the time jump
  run.expect_at(40);
  submit_and_apply(run.lab, Undo{});  // the first tear
  EXPECT_TRUE(run.lab.scene().system == run.systems[0]);
  for (int i = 0; i < 5; ++i) submit_and_apply(run.lab, Redo{});
  EXPECT_TRUE(run.lab.scene().system == otherwise);
}

TEST(Tearing, KeepsEditsWhenTimeGoesBack) {
  TornRun run(40);
  const System& last = run.systems[40];
  const SpringId cut = last.springs()[last.spring_count() / 2].id;
  run.lab.submit(Remove{{}, {cut}});
  submit_and_apply(run.lab, GoToTime{0.0});
  EXPECT_EQ(run.lab.scene().system.index_of(cut), no_index);
  EXPECT_EQ(run.lab.scene().system.spring_count(), run.systems[0].spring_count() - 1);
  // a tear that was undone is present again at the time when it was
  submit_and_apply(run.lab, Undo{});
  submit_and_apply(run.lab, Undo{});
  run.expect_at(40);
  submit_and_apply(run.lab, Undo{});
  EXPECT_TRUE(run.lab.scene().system == run.systems[0]);
  submit_and_apply(run.lab, GoToTime{20 * frame});
  run.expect_at(20);
}

TEST(Tearing, IsKnownAfterGoingToTheStart) {
  TornRun run(40);
  submit_and_apply(run.lab, GoToStart{});
  run.expect_at(0);
  submit_and_apply(run.lab, GoToTime{30 * frame});
  run.expect_at(30);
  submit_and_apply(run.lab, Undo{});
  run.expect_at(0);
  for (std::size_t moment = 1; moment <= 25; ++moment) {
    ASSERT_TRUE(run.lab.step());
    run.expect_at(moment);
  }
  submit_and_apply(run.lab, StepBack{});
  run.expect_at(24);
}

TEST(Tearing, GoesBackInARecordingToo) {
  ScratchFolder scratch;
  const auto file = std::make_shared<const std::filesystem::path>(scratch.folder / "torn.hookelog");
  TornRun run(20);
  Lab& lab = run.lab;
  lab.submit(Record{file});
  for (int i = 0; i < 20; ++i) run.go_on();
  lab.submit(StepBack{});
  lab.submit(GoToTime{8 * frame});  // before the recording began, and before most springs broke
  for (int i = 0; i < 8; ++i) lab.step();
  lab.submit(Undo{});
  lab.submit(Undo{});  // recorded as a scene that includes the tears
  for (int i = 0; i < 8; ++i) lab.step();
  lab.submit(GoToTime{5 * frame});
  for (int i = 0; i < 3; ++i) lab.step();
  lab.submit(Record{});
  apply_now(lab);
  ASSERT_EQ(lab.status()->recording.error, "");

  auto recording = std::make_shared<const Recording>(read_recording(*file));
  Lab again(*recording->start);
  again.submit(Play{recording});
  again.advance(0.0, [] { return true; });
  while (again.is_playing()) again.step();
  EXPECT_EQ(again.difference(), "");
  EXPECT_EQ(hash_state(again.scene().state), hash_state(lab.scene().state));
  EXPECT_TRUE(again.scene().system == lab.scene().system);
}

TEST(Tearing, TheBreakStrainOfASpringAppliesIfItIsSmaller) {
  System system;
  Spring spring{.rest_length = 2.0};
  EXPECT_EQ(system.break_length_of(spring), never_breaks);
  spring.break_strain = 0.5;
  EXPECT_EQ(system.break_length_of(spring), 3.0);
  system.break_strain = 0.25;
  EXPECT_EQ(system.break_length_of(spring), 2.5);
  system.break_strain = 1.0;
  EXPECT_EQ(system.break_length_of(spring), 3.0);
}

TEST(StrainLimit, LimitsEverySpringAndReportsTheRemovedEnergy) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  Lab free(scene);
  find_parameter("strain_limit_percent")->write(scene, 10.0);
  Lab held(scene);
  double max = 0.0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(free.step());
    ASSERT_TRUE(held.step());
    held.publish();
    free.publish();
    max = std::max(max, free.status()->snapshot->max_strain);
    EXPECT_LT(held.status()->snapshot->max_strain, 0.11);
  }
  EXPECT_GT(max, 0.15);
  EXPECT_LT(held.status()->run.limit_work, 0.0);
  EXPECT_EQ(free.status()->run.limit_work, 0.0);
}

// both ends move in proportion to their inverse masses: the center of mass moves as before
TEST(StrainLimit, ConservesMomentum) {
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  const PointId light = trial.add(Vec3(0.0), 1.0, {-3.0, 1.0, 0.0}), heavy = trial.add({1.0, 0.0, 0.0}, 4.0, {2.0, 0.0, 0.5});
  trial.join(light, heavy, 1.0, 1.0);
  trial.system.strain_limit = 0.05;
  const auto momentum = [&] { return compute_momentum(trial.system, trial.state); };
  const Momentum before = momentum();
  const double energy = compute_energy(trial.system, trial.state).total();
  trial.run(*find_integrator("velocity_verlet"), 0.5, 60);
  EXPECT_LT(glm::distance(trial.state.position[0], trial.state.position[1]), 1.05 * (1.0 + 1e-9));
  EXPECT_LT(glm::distance(momentum().linear, before.linear), 1e-12);
  // the difference is recorded in the ledger
  const double now = compute_energy(trial.system, trial.state).total();
  EXPECT_LT(now, energy);
  EXPECT_NEAR(trial.state.ledger.net_input, now - energy, 0.02 * (energy - now));
}

// four points rotate about each other, each limited by its neighbors: no torque acts on the whole, and only the first jerk dissipates
// energy
TEST(StrainLimit, ConservesAngularMomentum) {
  Trial trial;
  trial.system.gravity = Vec3(0.0);
  const Vec3 spin(0.5, 1.0, 8.0);
  std::vector<PointId> points;
  for (const Vec3& place : {Vec3(0.5, 0.0, 0.0), Vec3(0.0, 0.5, 0.0), Vec3(-0.5, 0.0, 0.1), Vec3(0.0, -0.5, 0.0)})
    points.push_back(trial.add(place, 1.0 + place.x, glm::cross(spin, place)));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) {
      const Vec3 apart = trial.position(points[i]) - trial.position(points[j]);
      trial.join(points[i], points[j], 5.0, glm::length(apart));
    }
  trial.system.strain_limit = 0.01;
  const Momentum before = compute_momentum(trial.system, trial.state);
  trial.run(*find_integrator("velocity_verlet"), 0.2, 400);
  const double energy = compute_energy(trial.system, trial.state).kinetic;
  trial.run(*find_integrator("velocity_verlet"), 2.0, 4000);
  const Momentum after = compute_momentum(trial.system, trial.state);
  EXPECT_LT(glm::distance(after.angular, before.angular), 1e-11 * glm::length(before.angular));
  EXPECT_LT(glm::distance(after.linear, before.linear), 1e-12);
  EXPECT_NEAR(compute_energy(trial.system, trial.state).kinetic, energy, 0.01 * energy);
}

TEST(StrainLimit, DoesNotHideADivergence) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.strain_limit = 0.1;
  scene.settings.substeps = 1;
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s).stiffness = 1e4;
  Lab lab(scene);
  int frames = 0;
  while (frames < 60 && lab.step()) ++frames;
  EXPECT_LT(frames, 20);
}

TEST(Hand, WithAMaximumSpeedLagsAndReportsTheDistance) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.hand_speed = 3.0;
  for (const GrabKind kind : {GrabKind::Hold, GrabKind::Pull}) {
    Lab lab(scene);
    const Vec3 from = scene.state.position[63], target = from + Vec3(0.0, 0.0, 1.0);
    lab.submit(GrabPoint{{.point = scene.system.points()[63].id, .kind = kind, .target = from}});
    ASSERT_TRUE(lab.step());
    lab.submit(MoveHand{target});
    run(lab, 1);
    EXPECT_NEAR(glm::distance(lab.scene().state.hand.position, from), 3.0 * frame, 1e-12);
    lab.publish();
    EXPECT_NEAR(lab.status()->run.hand_lag, 1.0 - 3.0 * frame, 1e-12);
    run(lab, 20);
    lab.publish();
    EXPECT_EQ(lab.scene().state.hand.position, target);
    EXPECT_EQ(lab.status()->run.hand_lag, 0.0);
  }
}

TEST(MassFollowsRadius, ScalesBySquareWhereSwitchedOnAndIsUndone) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  const Scene start = scene;
  for (const bool follows : {false, true}) {
    scene.defaults.mass_follows_radius = follows;
    const Point before = scene.system.points()[5];
    Lab lab(scene);
    lab.submit(SetPointProperty{PointProperty::Radius, {{before.id, 3.0 * before.radius}}});
    apply_now(lab);
    EXPECT_DOUBLE_EQ(lab.scene().system.points()[5].mass, (follows ? 9.0 : 1.0) * before.mass);
    submit_and_apply(lab, Undo{});
    EXPECT_EQ(lab.scene().system, scene.system);
    submit_and_apply(lab, Redo{});
    EXPECT_DOUBLE_EQ(lab.scene().system.points()[5].mass, (follows ? 9.0 : 1.0) * before.mass);

    lab.submit(SetParameter{find_parameter("radius"), 0.5});
    apply_now(lab);
    EXPECT_EQ(lab.scene().system.points()[6].radius, 0.5);
    submit_and_apply(lab, Undo{});
    submit_and_apply(lab, Undo{});
    EXPECT_EQ(lab.scene().system, scene.system);
  }
}

TEST(MassFollowsRadius, ADragOfItsSliderIsOneStepWithTheMemoryOfOne) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.defaults.mass_follows_radius = true;
  History one, drag;
  Scene first = scene, last = scene;
  const auto set = [](History& history, Scene& on, double radius) {
    Effect effect;
    history.record("radius", apply(on, SetParameter{find_parameter("radius"), radius}, effect), 7);
  };
  set(one, first, 0.05);
  for (int i = 1; i <= 100; ++i) set(drag, last, 0.001 * i);
  EXPECT_EQ(drag.done(), 1u);
  EXPECT_EQ(drag.bytes(), one.bytes());
  drag.go_to(0, last);
  EXPECT_EQ(last.system, scene.system);
}

TEST(GrabbedCollider, FollowsTheHandDuringARunAndReturnsByOneUndo) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.colliders = {{.shape = Sphere{{0.5, -0.6, -1.0}, 0.2}}};
  Lab lab(scene);
  lab.submit(GrabCollider{{0, {0.5, -0.6, -1.0}}}, 3);
  for (int i = 1; i <= 30; ++i) {
    lab.submit(MoveHand{{0.5, -0.6, -1.0 + 0.05 * i}}, 3);
    ASSERT_TRUE(lab.step());
    EXPECT_NEAR(anchor_of(lab.scene().state.hand.collider->shape).z, -1.0 + 0.05 * i, 1e-12);
  }
  lab.submit(ReleaseHand{}, 3);
  ASSERT_TRUE(lab.step());
  EXPECT_FALSE(lab.scene().state.hand.collider);
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system.colliders, scene.system.colliders);
}

TEST(GrabbedCollider, FollowsTheMouseWhileAScriptedHandActs) {
  Scene scene = weak_sheet(*find_integrator("velocity_verlet"));
  scene.system.break_strain = 0.0;
  scene.system.colliders = {{.shape = Sphere{{0.5, -0.6, -1.0}, 0.2}}};
  const ScriptedHand hand{.point = scene.system.points()[63].id,
                          .from = scene.state.position[63],
                          .center = scene.state.position[63] - Vec3(0.2, 0.0, 0.0),
                          .speed = 1.0,
                          .seconds = 0.25};
  scene.system.scripted_hand = hand;
  Lab lab(scene), without(scene);
  lab.submit(GrabCollider{{0, {0.5, -0.6, -1.0}}}, 3);
  for (int i = 1; i <= 30; ++i) {
    lab.submit(MoveHand{{0.5, -0.6, -1.0 - 0.05 * i}}, 3);
    ASSERT_TRUE(lab.step());
    ASSERT_TRUE(without.step());
    EXPECT_NEAR(anchor_of(lab.scene().state.hand.collider->shape).z, -1.0 - 0.05 * i, 1e-12);
    if (i <= 15) {
      EXPECT_LT(glm::distance(lab.scene().state.position[63], position_at(hand, i * frame)), 1e-12) << i;
    }
  }
  lab.submit(ReleaseHand{}, 3);
  ASSERT_TRUE(lab.step());
  ASSERT_TRUE(without.step());
  // the ball moved away from the sheet, so nothing else is affected
  EXPECT_EQ(lab.scene().state.position, without.scene().state.position);
  EXPECT_EQ(lab.scene().state.ledger.net_input, without.scene().state.ledger.net_input);
  submit_and_apply(lab, Undo{});
  EXPECT_EQ(lab.scene().system, scene.system);
}

TEST(MovingColliders, AreSavedAndBoxesCannotSpin) {
  const Scene scene = parse(R"({"hooke": 1, "hand_speed": 5, "strain_limit_percent": 12.5, "break_strain": 0.5, "colliders": [
    {"type": "sphere", "center": [0, 0, 0], "radius": 1, "spin": [0, 3, 0]},
    {"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "spin": [0, -2, 0], "oscillate": [0, 0.1, 0], "frequency": 3, "phase": 0.5},
    {"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "belt": [1, 0, 0]}]})");
  EXPECT_EQ(scene.system.colliders[1].path, (ColliderPath{{0.0, 0.1, 0.0}, 3.0, 0.5, {0.0, -2.0, 0.0}, Vec3(0.0)}));
  EXPECT_EQ(parse(format_scene(scene)).system, scene.system);
  EXPECT_THROW(parse(R"({"hooke": 1, "colliders": [{"type": "box", "min": [0, 0, 0], "max": [1, 1, 1], "spin": [0, 1, 0]}]})"), InputError);
  EXPECT_THROW(parse(R"({"hooke": 1, "colliders": [{"type": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "spin": [1, 0, 0]}]})"),
               InputError);
}

}  // namespace
}  // namespace hooke
