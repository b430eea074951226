// The laboratory: edits and their inverses, the clock, detection of divergence.
#include "lab/lab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "scene/parameters.h"
#include "sim/hash.h"
#include "sim/integrator.h"
#include "support/apply_now.h"

namespace hooke {
namespace {

// A 4 x 4 net with a spacing of 0.1 m, its upper corners nailed, above a floor.
Scene small_net() {
  Scene scene;
  scene.name = "net";
  std::vector<PointId> points;
  for (int i = 0; i < 16; ++i) {
    const PointId id = scene.system.new_point_id();
    points.push_back(id);
    scene.system.append_point({.id = id, .nailed = i == 0 || i == 3, .mass = 0.01});
    scene.state.position.emplace_back(0.1 * (i % 4), -0.1 * (i / 4), 0.0);
    scene.state.velocity.emplace_back(0.0);
  }
  const auto attach = [&](int i, int j) {
    scene.system.append_spring(
        {.id = scene.system.new_spring_id(), .first = points[i], .second = points[j], .stiffness = 50.0, .rest_length = 0.1});
  };
  for (int i = 0; i < 16; ++i) {
    if (i % 4 < 3) attach(i, i + 1);
    if (i / 4 < 3) attach(i, i + 4);
  }
  scene.system.faces.push_back({{points[0], points[1], points[5]}});
  scene.system.colliders.push_back({.shape = Plane{.point = {0.0, -2.0, 0.0}}});
  return scene;
}

// What an edit may change and undo must restore; time is not included.
struct Content {
  System system;
  std::vector<Vec3> position, velocity;
  Settings settings;
  Defaults defaults;
  bool operator==(const Content&) const = default;
};

Content content_of(const Scene& scene) {
  return {scene.system, scene.state.position, scene.state.velocity, scene.settings, scene.defaults};
}

// Edits of every kind, with random values and on random points and springs, some of which do not exist. A kind without a `draw` overload
// does not compile.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed) {}

  static constexpr std::size_t kinds = std::variant_size_v<Command>;
  Command next(Lab& lab) { return next(lab, std::make_index_sequence<kinds>()); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

 private:
  template <std::size_t... i>
  Command next(Lab& lab, std::index_sequence<i...>) {
    using Draw = Command (*)(RandomEdits&, Lab&);
    constexpr Draw draws[] = {[](RandomEdits& edits, Lab& of) -> Command {
      return edits.draw(std::type_identity<std::variant_alternative_t<i, Command>>(), of);
    }...};
    return draws[pick(static_cast<int>(kinds))](*this, lab);
  }

  template <class T>
  using Kind = std::type_identity<T>;
  Insert draw(Kind<Insert>, Lab& lab) {
    if (pick(2) == 0) return {.points = {{.point = {.id = lab.new_point_id(), .mass = number()}, .position = place()}}};
    return {.springs = {{.spring = {.id = lab.new_spring_id(), .first = point(lab), .second = point(lab), .rest_length = number()}}}};
  }
  Remove draw(Kind<Remove>, Lab& lab) {
    if (pick(2) == 0) return {.points = {point(lab)}};
    return {.springs = {spring(lab), spring(lab)}};
  }
  SetNailed draw(Kind<SetNailed>, Lab& lab) { return {{{point(lab), pick(2) == 0}, {point(lab), pick(2) == 0, {1.0, 2.0, 3.0}}}}; }
  Move draw(Kind<Move>, Lab& lab) { return {{{point(lab), place(), place()}}}; }
  SetPointColor draw(Kind<SetPointColor>, Lab& lab) {
    if (pick(3) == 0) return {{{point(lab), std::nullopt}}};
    return {{{point(lab), Color{1, 2, 3}}, {point(lab), Color{4, 5, static_cast<std::uint8_t>(pick(256))}}}};
  }
  SetPointProperty draw(Kind<SetPointProperty>, Lab& lab) {
    return {pick(2) == 0 ? PointProperty::Mass : PointProperty::Radius, {{point(lab), number()}}};
  }
  SetSpringProperty draw(Kind<SetSpringProperty>, Lab& lab) {
    return {static_cast<SpringProperty>(pick(4)), {{spring(lab), number()}, {spring(lab), number()}}};
  }
  SetParameter draw(Kind<SetParameter>, Lab&) { return {parameter(), number() * 10.0}; }
  // as an inverse command would contain them: values that were in effect
  RestoreParameter draw(Kind<RestoreParameter>, Lab& lab) {
    const Parameter* drag = find_parameter(pick(2) == 0 ? "drag" : "hand_speed");
    return {drag, drag->read(lab.scene()) + number()};
  }
  SetIntegrator draw(Kind<SetIntegrator>, Lab&) {
    return {&integrators()[static_cast<std::size_t>(pick(static_cast<int>(integrators().size())))]};
  }
  // at a point, or at a position between three points
  GrabPoint draw(Kind<GrabPoint>, Lab& lab) {
    const PointId first = point(lab);
    if (pick(2) == 0) return {{.point = first, .kind = pick(2) == 0 ? GrabKind::Hold : GrabKind::Pull, .target = place()}};
    return {{.point = first, .patch = Patch{{first, point(lab), point(lab)}, {0.25, 0.25, 0.5}}, .target = place()}};
  }
  GrabCollider draw(Kind<GrabCollider>, Lab&) { return {{pick(3), place()}}; }
  MoveHand draw(Kind<MoveHand>, Lab&) { return {place()}; }
  ReleaseHand draw(Kind<ReleaseHand>, Lab&) { return {}; }
  SetGravity draw(Kind<SetGravity>, Lab&) { return {place()}; }
  SetColliders draw(Kind<SetColliders>, Lab&) {
    std::vector<Collider> colliders(static_cast<std::size_t>(pick(3)), {.shape = Sphere{place() - Vec3(0.0, 9.0, 0.0), number()}});
    return {std::move(colliders)};
  }
  SetForces draw(Kind<SetForces>, Lab&) {
    const ForceTerm& term = force_terms()[static_cast<std::size_t>(pick(static_cast<int>(force_terms().size())))];
    return {{{&term, pick(2) == 0, default_values(term)}}};
  }
  SetTexture draw(Kind<SetTexture>, Lab&) { return {pick(2) == 0 ? "linen" : "", number(), {}}; }
  GoToState draw(Kind<GoToState>, Lab& lab) {
    State state = lab.scene().state;
    for (Vec3& position : state.position) position += 0.01 * place();
    return {std::make_shared<const State>(std::move(state))};
  }
  SetTorn draw(Kind<SetTorn>, Lab&) { return {static_cast<std::uint32_t>(pick(2))}; }
  // only as part of an inverse
  MarkTorn draw(Kind<MarkTorn>, Lab& lab) { return {lab.scene().state.torn}; }
  Replace draw(Kind<Replace>, Lab& lab) {
    Scene scene = lab.scene();
    scene.system.drag = number();
    return {std::make_shared<const Scene>(std::move(scene))};
  }

  double number() { return std::uniform_real_distribution<double>(0.01, 2.0)(random_); }
  Vec3 place() { return {number(), number(), number()}; }
  PointId point(const Lab& lab) { return PointId{static_cast<std::uint32_t>(pick(lab.scene().system.point_count() + 3))}; }
  SpringId spring(const Lab& lab) { return SpringId{static_cast<std::uint32_t>(pick(lab.scene().system.spring_count() + 3))}; }
  const Parameter* parameter() { return &parameters()[static_cast<std::size_t>(pick(static_cast<int>(parameters().size())))]; }

  std::mt19937 random_;
};

TEST(Undo, RevertsEveryEditExactlyWhilePaused) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    Lab lab(small_net());
    RandomEdits edits(seed);
    std::vector<Content> contents;
    std::vector<std::string> names;
    for (int i = 0; i < 40; ++i) {
      // releasing belongs to the undo step of the grab
      lab.submit(Command(ReleaseHand{}));
      apply_now(lab);
      Content content = content_of(lab.scene());
      lab.submit(edits.next(lab));
      apply_now(lab);
      contents.push_back(std::move(content));
    }
    lab.submit(Command(ReleaseHand{}));
    apply_now(lab);
    const Content last = content_of(lab.scene());

    int undone = 0;
    while (!lab.status()->history.undo_name.empty()) {
      lab.submit(Undo{});
      apply_now(lab);
      ++undone;
    }
    EXPECT_EQ(content_of(lab.scene()), contents.front()) << "seed " << seed;
    while (!lab.status()->history.redo_name.empty()) {
      lab.submit(Redo{});
      apply_now(lab);
      --undone;
    }
    EXPECT_EQ(undone, 0);
    EXPECT_EQ(content_of(lab.scene()), last) << "seed " << seed;
  }
}

TEST(Undo, OfADeletedPointRestoresItWhileTheOthersHaveMoved) {
  Lab lab(small_net());
  for (int i = 0; i < 20; ++i) lab.step();
  const PointId corner = lab.scene().system.points()[15].id;
  const Vec3 position = lab.scene().state.position[15], velocity = lab.scene().state.velocity[15];
  const std::vector<Spring> springs = lab.scene().system.springs();

  lab.submit(Command(Remove{.points = {corner}}));
  for (int i = 0; i < 20; ++i) lab.step();
  EXPECT_EQ(lab.scene().system.point_count(), 15);
  const State moved = lab.scene().state;

  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().state.position[15], position);
  EXPECT_EQ(lab.scene().state.velocity[15], velocity);
  EXPECT_EQ(lab.scene().system.springs(), springs);
  EXPECT_EQ(lab.scene().state.time, moved.time);
  for (int i = 0; i < 15; ++i) EXPECT_EQ(lab.scene().state.position[i], moved.position[i]);
}

TEST(Undo, OfANailRestoresTheVelocity) {
  Lab lab(small_net());
  for (int i = 0; i < 20; ++i) lab.step();
  const PointId point = lab.scene().system.points()[10].id;
  const Vec3 velocity = lab.scene().state.velocity[10];
  ASSERT_GT(glm::length(velocity), 0.01);
  lab.submit(Command(SetNailed{{{point, true}}}));
  apply_now(lab);
  EXPECT_EQ(lab.scene().state.velocity[10], Vec3(0.0));
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().state.velocity[10], velocity);
  EXPECT_FALSE(lab.scene().system.points()[10].nailed);
}

TEST(Undo, RevertsADragOfASliderInOneStep) {
  Lab lab(small_net());
  const Parameter* drag = find_parameter("drag");
  for (int i = 1; i <= 30; ++i) lab.submit(Command(SetParameter{drag, 0.1 * i}), 7);
  lab.submit(Command(SetParameter{drag, 9.0}), 8);
  apply_now(lab);
  EXPECT_EQ(lab.scene().system.drag, 9.0);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_NEAR(lab.scene().system.drag, 3.0, 1e-12);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().system.drag, 0.0);
  EXPECT_TRUE(lab.status()->history.undo_name.empty());
}

TEST(Undo, OfADragRestoresThePositionBeforeTheGrab) {
  Lab lab(small_net());
  const PointId point = lab.scene().system.points()[12].id;
  const Vec3 taken = lab.scene().state.position[12];
  lab.submit(Command(GrabPoint{{.point = point, .kind = GrabKind::Hold, .target = taken}}));
  for (int i = 1; i <= 10; ++i) {
    lab.submit(Command(MoveHand{taken + Vec3(0.0, 0.0, 0.02 * i)}));
    lab.step();
  }
  EXPECT_EQ(lab.scene().state.position[12], taken + Vec3(0.0, 0.0, 0.02 * 10));
  lab.submit(Command(ReleaseHand{}));
  apply_now(lab);
  EXPECT_NEAR(lab.scene().state.velocity[12].z, 1.2, 1e-9);  // released at the velocity of the hand: 0.02 m per frame of 1/60 s
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().state.position[12], taken);
}

TEST(Undo, RestoresAFileValueOutsideTheRangeOfItsSlider) {
  Scene scene = small_net();
  scene.settings.substeps = 5000;
  Lab lab(scene);
  lab.submit(Command(SetParameter{find_parameter("substeps"), 10}));
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().settings.substeps, 5000);
}

TEST(Edits, OfRemovedItemsOrInvalidValuesDoNothing) {
  Lab lab(small_net());
  const Content before = content_of(lab.scene());
  const PointId missing{99};
  lab.submit(Command(Remove{.points = {missing}, .springs = {SpringId{99}}}));
  lab.submit(Command(Move{{{missing, Vec3(1.0), Vec3(0.0)}, {lab.scene().system.points()[1].id, Vec3(NAN), Vec3(0.0)}}}));
  lab.submit(Command(SetNailed{{{missing, true}}}));
  lab.submit(Command(SetPointProperty{PointProperty::Mass, {{lab.scene().system.points()[1].id, -1.0}, {missing, 1.0}}}));
  lab.submit(Command(SetSpringProperty{SpringProperty::Stiffness, {{lab.scene().system.springs()[0].id, INFINITY}}}));
  lab.submit(Command(GrabPoint{{.point = missing}}));
  const PointId a{0}, b{1}, c{2};
  const std::array<double, 3> weights{0.5, 0.3, 0.2};
  lab.submit(Command(GrabPoint{{.point = a, .patch = Patch{{a, b, missing}, weights}}}));
  lab.submit(Command(GrabPoint{{.point = a, .patch = Patch{{a, b, b}, weights}}}));
  lab.submit(Command(GrabPoint{{.point = a, .patch = Patch{{a, b, c}, {0.5, 0.8, -0.3}}}}));
  lab.submit(Command(GrabPoint{{.point = a, .patch = Patch{{a, b, c}, {0.5, 0.5, 0.5}}}}));
  lab.submit(Command(GrabPoint{{.point = a, .patch = Patch{{a, b, c}, weights}, .kind = GrabKind::Hold}}));
  lab.submit(Command(GrabPoint{{.point = PointId{3}, .patch = Patch{{a, b, c}, weights}}}));
  lab.submit(Command(GrabPoint{{.point = a, .stiffness = -1.0}}));
  lab.submit(Command(MoveHand{Vec3(1.0)}));
  lab.submit(Command(Insert{.points = {{.point = {.id = lab.scene().system.points()[0].id}}, {.point = {.id = PointId{50}, .mass = 0.0}}},
                            .springs = {{.spring = {.id = SpringId{80}, .first = missing, .second = PointId{0}}}}}));
  apply_now(lab);
  EXPECT_EQ(content_of(lab.scene()), before);
}

TEST(Edits, OfA2DSceneStayInItsPlane) {
  Scene scene = small_net();
  scene.system.dimensions = 2;
  Lab lab(scene);
  lab.submit(Command(Insert{.points = {{.point = {.id = lab.new_point_id()}, .position = {0.1, 0.2, 0.3}, .velocity = {0.0, 0.0, 1.0}}}}));
  lab.submit(Command(Move{{{lab.scene().system.points()[5].id, Vec3(1.0), Vec3(1.0)}}}));
  apply_now(lab);
  for (const Vec3& x : lab.scene().state.position) EXPECT_EQ(x.z, 0.0);
  for (const Vec3& v : lab.scene().state.velocity) EXPECT_EQ(v.z, 0.0);
}

TEST(Edits, DuringARunAffectOnlyTheirOwnItems) {
  // an edit that is undone between two frames leaves the run unchanged
  Lab lab(small_net()), untouched(small_net());
  RandomEdits edits(3);
  for (int frame = 0; frame < 60; ++frame) {
    const Content before = content_of(lab.scene());
    lab.submit(edits.next(lab));
    lab.submit(Command(ReleaseHand{}));
    apply_now(lab);
    if (!(content_of(lab.scene()) == before)) {
      lab.submit(Undo{});
      apply_now(lab);
    }
    lab.step();
    untouched.step();
    ASSERT_EQ(hash_state(lab.scene().state), hash_state(untouched.scene().state)) << "frame " << frame;
  }
}

TEST(Clock, StepsTheFramesThatTheElapsedTimeRequires) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  for (int i = 0; i < 100; ++i) lab.advance(0.01, [] { return true; });
  EXPECT_NEAR(lab.scene().state.time, 1.0, 1.0 / 60.0 + 1e-9);
  lab.submit(Command(SetParameter{find_parameter("speed"), 0.5}));
  const double before = lab.scene().state.time;
  for (int i = 0; i < 100; ++i) lab.advance(0.01, [] { return true; });
  EXPECT_NEAR(lab.scene().state.time - before, 0.5, 1.0 / 60.0 + 1e-9);
}

TEST(Clock, ResumesAfterALongSleepWithoutAJump) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  lab.advance(10.0, [] { return true; });
  EXPECT_LE(lab.scene().state.time, 0.26);
}

TEST(Clock, SlowsDownInsteadOfAccumulatingDelay) {
  Lab lab(small_net());
  lab.submit(SetRunning{true});
  // there is time for only one substep per call, and a frame has 20
  for (int i = 0; i < 200; ++i) lab.advance(1.0 / 60.0, [] { return false; });
  EXPECT_NEAR(lab.scene().state.time * 60.0, 10.0, 1.0);
  EXPECT_NEAR(lab.status()->run.speed, 0.05, 0.05);
  // once there is enough time again, missed frames are not caught up
  const double before = lab.scene().state.time;
  lab.advance(1.0 / 60.0, [] { return true; });
  EXPECT_LE(lab.scene().state.time - before, 3.0 / 60.0 + 1e-9);
}

TEST(Clock, AnInterruptedFrameGivesTheSameBits) {
  Lab whole(small_net()), cut(small_net());
  for (int i = 0; i < 10; ++i) whole.step();
  cut.submit(SetRunning{true});
  int substeps = 0;
  while (cut.status()->run.frames < 10) cut.advance(0.02, [&] { return ++substeps % 3 != 0; });
  EXPECT_EQ(hash_state(cut.scene().state), hash_state(whole.scene().state));
}

TEST(Clock, StepsOneFrameWhenPausedAndReportsIt) {
  Lab lab(small_net());
  lab.submit(StepOnce{});
  apply_now(lab);
  EXPECT_NEAR(lab.scene().state.time, 1.0 / 60.0, 1e-15);
  EXPECT_FALSE(lab.status()->run.running);
}

TEST(Start, KeepsTheCurrentMethodOnRestart) {
  Lab lab(small_net());
  const Content start = content_of(lab.scene());
  lab.step();
  lab.submit(Command(SetParameter{find_parameter("substeps"), 33}));
  lab.submit(Command(Remove{.points = {lab.scene().system.points()[3].id}}));
  for (int i = 0; i < 30; ++i) lab.step();
  const Content run = content_of(lab.scene());
  lab.submit(GoToStart{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().system, start.system);
  EXPECT_EQ(lab.scene().state.position, start.position);
  EXPECT_EQ(lab.scene().state.time, 0.0);
  EXPECT_EQ(lab.scene().settings.substeps, 33);
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_EQ(content_of(lab.scene()), run);
}

TEST(Start, IsTheStateBeforeTheFirstRunHoweverOftenItIsSaved) {
  Lab lab(small_net());
  lab.submit(Command(Remove{.points = {lab.scene().system.points()[3].id}}));
  apply_now(lab);
  const Content built = content_of(lab.scene());
  for (int i = 0; i < 10; ++i) lab.step();
  lab.submit(MarkSaved{});
  for (int i = 0; i < 10; ++i) lab.step();
  lab.submit(GoToStart{});
  apply_now(lab);
  EXPECT_EQ(lab.scene().system, built.system);
  EXPECT_EQ(lab.scene().state.position, built.position);
  EXPECT_EQ(lab.scene().state.time, 0.0);
}

TEST(Divergence, RecommendsAStableMethodWhereNoNumberOfSubstepsIsStable) {
  const Settings settings;
  const Advice advice = suggest_stepping({.omega = 1e12}, settings);
  EXPECT_EQ(advice.integrator, find_integrator("tr_bdf2"));
  EXPECT_EQ(advice.substeps, settings.substeps);
  EXPECT_EQ(suggest_stepping({.omega = 1e4}, settings).integrator, settings.integrator);
}

TEST(Divergence, PausesAtTheLastGoodFrameAndRecommendsSubsteps) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("symplectic_euler");
  scene.settings.substeps = 1;  // omega h is about 3.5 here, above the limit 2
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s).stiffness = 100.0;
  Lab lab(scene);
  lab.submit(SetRunning{true});
  for (int i = 0; i < 600 && lab.status()->diagnosis.message.empty(); ++i) lab.advance(1.0 / 60.0, [] { return true; });
  const Status& status = *lab.status();
  ASSERT_FALSE(status.diagnosis.message.empty());
  EXPECT_FALSE(status.run.running);
  EXPECT_TRUE(is_finite(status.snapshot->state));
  EXPECT_NE(status.diagnosis.message.find("point "), std::string::npos) << status.diagnosis.message;
  EXPECT_NE(status.diagnosis.message.find("spring "), std::string::npos) << status.diagnosis.message;
  ASSERT_TRUE(status.diagnosis.advice.has_value());
  EXPECT_EQ(status.diagnosis.advice->integrator, find_integrator("symplectic_euler"));

  // the recommendation is stable
  scene.settings.substeps = status.diagnosis.advice->substeps;
  Lab advised(scene);
  for (int i = 0; i < 1200; ++i) ASSERT_TRUE(advised.step()) << "frame " << i;
}

TEST(Divergence, OfUndampedExplicitEulerRecommendsAStableMethod) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("explicit_euler");
  Lab lab(scene);
  bool held = true;
  for (int i = 0; i < 6000 && held; ++i) held = lab.step();
  ASSERT_FALSE(held);
  lab.publish();
  EXPECT_NE(lab.status()->diagnosis.message.find("the energy grew by"), std::string::npos) << lab.status()->diagnosis.message;
  ASSERT_TRUE(lab.status()->diagnosis.advice.has_value());
  EXPECT_NE(lab.status()->diagnosis.advice->integrator, find_integrator("explicit_euler"));
}

// dashpots damp motion along the springs; transverse motion grows at every step
TEST(Divergence, OfDampedExplicitEulerWithinItsLimitRecommendsAStableMethod) {
  Scene scene = small_net();
  scene.settings.integrator = find_integrator("explicit_euler");
  for (Index s = 0; s < scene.system.spring_count(); ++s) scene.system.spring(s).damping = 0.2;
  for (Index i = 4; i < 16; ++i) scene.state.velocity[i].z = 0.1;
  const double limit = largest_stable_step(*scene.settings.integrator, bound_spectrum(scene.system));
  scene.settings.substeps = static_cast<int>(std::ceil(1.0 / 60.0 / limit));
  Lab lab(scene);
  bool held = true;
  for (int i = 0; i < 6000 && held; ++i) held = lab.step();
  ASSERT_FALSE(held);
  lab.publish();
  EXPECT_NE(lab.status()->diagnosis.message.find("the energy grew by"), std::string::npos) << lab.status()->diagnosis.message;
  EXPECT_NE(lab.status()->diagnosis.advice->integrator, find_integrator("explicit_euler"));
}

TEST(Parameters, ReadBackWhatWasWrittenWithinTheirRange) {
  Scene scene = small_net();
  // springs of every family
  std::vector<Spring> springs = scene.system.springs();
  for (std::size_t s = 0; s < springs.size(); ++s) springs[s].family = static_cast<SpringFamily>(s % spring_families);
  scene.system.set_springs(springs);
  scene.sheet = std::make_shared<const SheetWeights>(
      SheetWeights{std::vector<double>(scene.system.points().size(), 0.3), std::vector<double>(springs.size(), 0.7)});
  for (const Parameter& parameter : parameters()) {
    bool applies = parameter.applies == nullptr;
    for (int parameterization = 3; parameterization >= 0; --parameterization) {
      scene.parameterization = static_cast<SpringParameterization>(parameterization);
      applies = applies || parameter.applies(scene);
    }
    EXPECT_TRUE(applies) << parameter.name;
    for (const double value : {parameter.min, parameter.max, parameter.default_value}) {
      parameter.write(scene, value);
      EXPECT_NEAR(parameter.read(scene), value, 1e-12 * std::abs(value)) << parameter.name;
    }
    EXPECT_EQ(clamp_to(parameter, -1e300), parameter.min) << parameter.name;
    EXPECT_EQ(clamp_to(parameter, 1e300), parameter.max) << parameter.name;
    EXPECT_EQ(clamp_to(parameter, NAN), parameter.default_value) << parameter.name;
    EXPECT_FALSE(parameter.description.empty());
    EXPECT_EQ(find_parameter(parameter.name), &parameter);
    parameter.write(scene, parameter.default_value);
  }
}

}  // namespace
}  // namespace hooke
