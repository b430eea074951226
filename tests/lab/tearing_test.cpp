// Springs that break: in a run, under the hand, in the history, in files and recordings.
#include <gtest/gtest.h>

#include "formats/scene_file.h"
#include "lab/lab.h"
#include "scene/parameters.h"
#include "sim/forces/hand.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/convergence.h"
#include "support/run_lab.h"
#include "support/scratch_folder.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

constexpr double frame = 1.0 / 60.0;  // [s]

class Tearing : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Tearing, testing::ValuesIn(every_method()), method_name);

// the spring breaks in the first substep at whose end it exceeds its strain; then its end falls freely
TEST_P(Tearing, ASpringBreaksAtItsStrainAndExertsNoForceAfterwards) {
  TestSim sim;
  const PointId top = sim.nail(Vec3(0.0)), weight = sim.add({0.0, -1.0, 0.0}, 1.0, {0.0, -3.0, 0.0});
  const SpringId spring = sim.join(top, weight, 50.0, 1.0);
  sim.system.spring(0)->break_strain = 0.2;
  Plan plan = make_plan(sim.system);
  Frame step;
  const Settings settings{.integrator = &method(), .substeps = 20};
  double broke = 0.0;
  Vec3 v(0.0);
  for (int i = 0; i < 20; ++i) {
    step.begin(plan, sim.system, settings, sim.state);
    while (!step.done()) step.substep(plan);
    step.end(plan, sim.state);
    if (step.broken().empty()) continue;
    EXPECT_EQ(broke, 0.0) << "a spring breaks only once";
    EXPECT_EQ(sim.system.springs()[step.broken()[0]].id, spring);
    EXPECT_GE(-sim.state.position[1].y, 1.2);
    broke = sim.state.time;
    v = sim.state.velocity[1];
    // at least 1/2 k (l - l0)^2
    EXPECT_LE(sim.state.supply.net_input, -0.5 * 50.0 * 0.2 * 0.2);
    EXPECT_GT(sim.state.supply.net_input, -0.5 * 50.0 * 0.22 * 0.22);
  }
  ASSERT_GT(broke, 0.0);
  EXPECT_NEAR(sim.state.velocity[1].y, v.y - 9.81 * (sim.state.time - broke), 1e-9);
}

// its ends approach each other, so that it would be within its limit after the first substep
TEST_P(Tearing, ASpringStretchedBeyondItsLimitByAnEditBreaksAtOnce) {
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  const Vec3 velocity{-3.0, 0.0, 0.0};
  const PointId nail = sim.nail(Vec3(0.0)), end = sim.add({1.21, 0.0, 0.0}, 1.0, velocity);
  sim.join(nail, end, 50.0, 1.0);
  sim.system.spring(0)->break_strain = 0.2;
  Plan plan = make_plan(sim.system);
  Frame step;
  step.begin(plan, sim.system, {.integrator = &method(), .substeps = 1}, sim.state);
  while (!step.done()) step.substep(plan);
  step.end(plan, sim.state);
  EXPECT_EQ(step.broken().size(), 1u);
  EXPECT_LT(glm::distance(sim.state.velocity[1], velocity), 1e-12);
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

}  // namespace
}  // namespace hooke
