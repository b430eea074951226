// Undo history: the names of steps, going to any step, and memory limits.
#include "edit/history.h"

#include <gtest/gtest.h>

#include "lab/lab.h"
#include "scene/parameters.h"
#include "support/apply_now.h"
#include "support/test_sim.h"

namespace hooke {
namespace {

Scene row_of(int points) {
  TestSim sim;
  for (int i = 0; i < points; ++i) sim.add({0.1 * i, 0.0, 0.0});
  Scene scene;
  scene.system = sim.system;
  scene.state = sim.state;
  return scene;
}

double mass_after(Lab& lab, std::size_t steps) {
  lab.submit(GoToHistoryStep{steps});
  apply_now(lab);
  return lab.scene().system.points()[0].mass;
}

TEST(History, CanGoToAnyOfAThousandNamedSteps) {
  Lab lab(row_of(2));
  const PointId point = lab.scene().system.points()[0].id;
  for (int i = 1; i <= 1000; ++i) lab.submit(Command(SetPointProperty{PointProperty::Mass, {{point, 1.0 + i}}}));
  apply_now(lab);
  ASSERT_EQ(lab.status()->history.list->names.size(), 1000u);
  EXPECT_EQ(lab.status()->history.list->done, 1000u);
  EXPECT_EQ(lab.status()->history.list->names.front(), "mass of 1 point to 2 kg");
  EXPECT_EQ(mass_after(lab, 0), 1.0);
  EXPECT_EQ(mass_after(lab, 1000), 1001.0);
  EXPECT_EQ(mass_after(lab, 417), 418.0);
  EXPECT_EQ(lab.status()->history.list->names.size(), 1000u);
  EXPECT_EQ(lab.status()->history.list->done, 417u);
  // this step does not exist
  EXPECT_EQ(mass_after(lab, 1001), 418.0);

  // an edit discards the undone steps
  lab.submit(Command(SetParameter{find_parameter("drag"), 1.0}));
  apply_now(lab);
  EXPECT_EQ(lab.status()->history.list->names.size(), 418u);
  EXPECT_EQ(lab.status()->history.list->names.back(), "set " + std::string(find_parameter("drag")->label) + " to 1 1/s");
}

TEST(History, UndoAndRedoWithNothingToUndoChangeNothing) {
  Lab lab(row_of(2));
  lab.submit(Undo{});
  lab.submit(Redo{});
  apply_now(lab);
  EXPECT_FALSE(lab.status()->history.unsaved);
  EXPECT_EQ(lab.status()->history.edits, 0);
}

TEST(History, CountsEveryEditAndUndo) {
  Lab lab(row_of(2));
  lab.submit(Command(SetParameter{find_parameter("drag"), 1.0}));
  lab.submit(Undo{});
  lab.submit(Redo{});
  apply_now(lab);
  EXPECT_EQ(lab.status()->history.edits, 3);
}

TEST(History, SharesTheListUntilItChanges) {
  Lab lab(row_of(2));
  const Parameter* drag = find_parameter("drag");
  lab.submit(Command(SetParameter{drag, 1.0}), 3);
  apply_now(lab);
  const auto list = lab.status()->history.list;
  lab.submit(Command(SetParameter{drag, 1.0}), 3);
  apply_now(lab);
  EXPECT_EQ(lab.status()->history.list, list);
  // a drag of a slider is named after its newest value
  lab.submit(Command(SetParameter{drag, 2.0}), 3);
  apply_now(lab);
  EXPECT_EQ(lab.status()->history.list->names, std::vector<std::string>{"set Drag c to 2 1/s"});
  lab.submit(Undo{});
  apply_now(lab);
  EXPECT_NE(lab.status()->history.list, list);
  EXPECT_EQ(lab.status()->history.list->done, 0u);
}

// Moves of a thousand points take 60 kB each: the memory limit allows some thousands of them, and the oldest are discarded first.
TEST(History, DiscardsTheOldestStepsBeyondItsMemoryLimit) {
  Scene scene = row_of(1000);
  History history;
  Effect effect;
  constexpr int steps = 6000;
  for (int step = 0; step < steps; ++step) {
    Move move;
    for (Index i = 0; i < scene.system.point_count(); ++i)
      move.items.push_back({scene.system.points()[i].id, Vec3(0.0, step, 0.0), Vec3(0.0)});
    history.record("step " + std::to_string(step), apply(scene, move, effect), 0);
    ASSERT_LE(history.bytes(), History::max_bytes);
  }
  EXPECT_GT(history.done(), 1000u);
  EXPECT_LT(history.done(), static_cast<std::size_t>(steps));
  EXPECT_EQ(history.list()->names.back(), "step 5999");
  const auto left = static_cast<double>(history.done());
  history.go_to(0, scene);
  EXPECT_EQ(scene.state.position[0].y, steps - 1 - left);
  EXPECT_LE(history.bytes(), History::max_bytes);
  history.clear();
  EXPECT_EQ(history.bytes(), 0u);
}

TEST(History, KeepsTheNewestStepHoweverLarge) {
  Scene scene = row_of(2);
  History history;
  Move heavy;
  heavy.items.reserve(History::max_bytes / sizeof(Move::Item) + 1);
  history.record("small", {ReleaseHand{}}, 0);
  std::vector<Command> inverse;
  inverse.emplace_back(std::move(heavy));
  history.record("heavy", std::move(inverse), 0);
  ASSERT_EQ(history.done(), 1u);
  EXPECT_EQ(history.undo_name(), "heavy");
}

}  // namespace
}  // namespace hooke
