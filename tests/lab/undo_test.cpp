// Edits of every kind and their inverses.
#include "lab/lab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "formats/scene_file.h"
#include "scene/parameters.h"
#include "sim/forces/force_terms.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "support/apply_now.h"
#include "support/small_net.h"

namespace hooke {
namespace {

// Edits of every kind, with random values and on random points and springs, some of which do not exist. A kind without a `draw` overload
// does not compile.
class RandomEdits {
 public:
  explicit RandomEdits(unsigned seed) : random_(seed) {}

  static constexpr std::size_t kinds = std::variant_size_v<CommandVariant>;
  Command next(Lab& lab) { return next(lab, std::make_index_sequence<kinds>()); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

 private:
  template <std::size_t... i>
  Command next(Lab& lab, std::index_sequence<i...>) {
    using Draw = Command (*)(RandomEdits&, Lab&);
    constexpr Draw draws[] = {[](RandomEdits& edits, Lab& of) -> Command {
      return edits.draw(std::type_identity<std::variant_alternative_t<i, CommandVariant>>(), of);
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
  SetLoad draw(Kind<SetLoad>, Lab& lab) { return {{{point(lab), place()}, {point(lab), Vec3(0.0)}}}; }
  SetFixedAxes draw(Kind<SetFixedAxes>, Lab& lab) { return {{{point(lab), static_cast<std::uint8_t>(pick(8))}}}; }
  SetPointProperty draw(Kind<SetPointProperty>, Lab& lab) {
    return {pick(2) == 0 ? PointProperty::Mass : PointProperty::Radius, {{point(lab), number()}}};
  }
  SetSpringProperty draw(Kind<SetSpringProperty>, Lab& lab) {
    return {static_cast<SpringProperty>(pick(4)), {{spring(lab), number()}, {spring(lab), number()}}};
  }
  SetVelocity draw(Kind<SetVelocity>, Lab& lab) { return {{{point(lab), place()}}}; }
  SetSpringLaw draw(Kind<SetSpringLaw>, Lab& lab) {
    if (pick(2) == 0) return {{{spring(lab), std::nullopt}}};
    return {{{spring(lab), SpringLaw{.force = SpringForce::Cable, .amplitude = 0.1 * number()}}}};
  }
  SetText draw(Kind<SetText>, Lab&) { return {"a title", "", std::to_string(pick(9))}; }
  SetPlots draw(Kind<SetPlots>, Lab&) { return {{"y" + std::to_string(pick(2))}}; }
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

// The drag has moved what the point is attached to as well.
TEST(Undo, OfADragInARunReturnsToTheStateBeforeIt) {
  const Vec3 up(0.0, 0.0, 0.1);
  using Drag = void (*)(Lab&, const Vec3&);
  const Drag drags[] = {
      [](Lab& lab, const Vec3& to) {
        if (!lab.scene().system.grab)
          lab.submit(Command(GrabPoint{{.point = lab.scene().system.points()[12].id, .kind = GrabKind::Pull, .target = to}}), 7);
        lab.submit(Command(MoveHand{to}), 7);
      },
      [](Lab& lab, const Vec3& to) {
        lab.submit(Command(Move{{{lab.scene().system.points()[12].id, to, Vec3(0.0)}}}), 7);
      },
      [](Lab& lab, const Vec3&) {
        if (!lab.scene().state.hand.collider) lab.submit(Command(GrabCollider{{0, Vec3(0.0, -2.0, 0.0)}}), 7);
        lab.submit(Command(MoveHand{Vec3(0.0, -0.2, 0.0)}), 7);
      },
  };
  for (const Drag drag : drags) {
    Lab lab(small_net()), untouched(small_net());
    for (int i = 0; i < 20; ++i) lab.step(), untouched.step();
    const Content before = content_of(lab.scene());
    const Vec3 taken = lab.scene().state.position[12];
    for (int i = 1; i <= 10; ++i) {
      drag(lab, taken + static_cast<double>(i) * up);
      lab.step();
    }
    lab.submit(Command(ReleaseHand{}));
    for (int i = 0; i < 20; ++i) lab.step();
    const Content after = content_of(lab.scene());
    const std::uint64_t hash_after = hash_state(lab.scene().state);
    EXPECT_FALSE(before == after);

    lab.submit(Undo{});
    apply_now(lab);
    EXPECT_EQ(content_of(lab.scene()), before);
    EXPECT_EQ(hash_state(lab.scene().state), hash_state(untouched.scene().state));
    EXPECT_TRUE(lab.status()->history.undo_name.empty());
    lab.submit(Redo{});
    apply_now(lab);
    EXPECT_EQ(content_of(lab.scene()), after);
    EXPECT_EQ(hash_state(lab.scene().state), hash_after);

    // the run goes on as if the drag had not happened
    lab.submit(Undo{});
    for (int i = 0; i < 20; ++i) lab.step(), untouched.step();
    EXPECT_EQ(hash_state(lab.scene().state), hash_state(untouched.scene().state));
  }
}

// The sheet has sprung back since the ball was lifted off it: put back alone, the ball would be below the sheet, and fall.
TEST(Undo, OfALiftLeavesTheBallAboveTheTrampoline) {
  Lab lab(load_scene(find_scene("trampoline")).scene);
  const auto height = [&] { return lab.scene().state.position[0].y; };
  while (height() > -0.15) lab.step();
  lab.submit(Command(GrabPoint{{.point = lab.scene().system.points()[0].id, .kind = GrabKind::Hold, .target = {0.0, height(), 0.0}}}));
  for (int i = 1; i <= 30; ++i) {
    lab.submit(Command(MoveHand{{0.0, -0.15 + 0.02 * i, 0.0}}));
    lab.step();
  }
  lab.submit(Command(ReleaseHand{}));
  lab.submit(Undo{});
  for (int i = 0; i < 30; ++i) lab.step();
  EXPECT_GT(height(), -0.4);
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

}  // namespace
}  // namespace hooke
