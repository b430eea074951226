// Drag: while the scene runs, the hand holds or pulls a point, and letting go throws it; in a pause the point is put where
// the cursor is. One step of undo either way.
#include <glm/geometric.hpp>

#include "app/tools.h"

namespace hooke {
namespace {

// A quarter of what its springs hold it with: firm, and hardly faster than the scene itself. A loose point swings about the
// cursor twice a second: k = m (2 pi f)^2.
double fitting_pull(const System& system, PointId id) {
  double sum = 0.0;
  for (const Spring& spring : system.springs())
    if (spring.first == id || spring.second == id) sum += spring.stiffness;
  if (sum > 0.0) return 0.25 * sum;
  constexpr double omega = 2.0 * 3.14159265358979323846 * 2.0;  // [rad/s]
  return system.points()[system.index_of(id)].mass * omega * omega;
}

class DragTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    point_ = bench.point_at(pointer.at);
    if (!point_) return;
    gesture_ = bench.begin_gesture();
    has_hand_ = has_moved_ = false;
    anchor_ = target_ = bench.snapshot().position(*point_);
    // the point does not jump to the cursor: it keeps its place beside it
    offset_ = anchor_ - bench.place_beside(pointer.at, anchor_);
    follow(pointer, bench);
  }

  void follow(const Pointer& pointer, Workbench& bench) override {
    if (!point_ || bench.system().index_of(*point_) == no_index) return;
    const Vec3 target = bench.place_beside(pointer.at, anchor_) + offset_;
    const bool moved = target != target_;
    target_ = target;
    if (bench.status->running) {
      if (!has_hand_)
        take_hold(bench);
      else if (moved)
        bench.lab.submit(MoveHand{target_}, gesture_);
    } else {
      let_go(bench);
      if (moved) bench.lab.submit(Move{{{*point_, target_, Vec3(0.0)}}}, gesture_);
      has_moved_ = has_moved_ || moved;
    }
  }

  void release(const Pointer& pointer, Workbench& bench) override {
    follow(pointer, bench);
    let_go(bench);
    point_.reset();
  }

  bool cancel(Workbench& bench) override {
    if (!point_) return false;
    const bool changed = has_hand_ || has_moved_;
    let_go(bench);
    if (changed) bench.lab.submit(Undo{});
    point_.reset();
    return true;
  }

  std::string next_step(const Workbench& bench) const override {
    if (!point_) return "press on a point and move it";
    return bench.status->running ? "move, and let go to throw; Esc takes it back" : "move, and let go; Esc takes it back";
  }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.hovered_point = point_ ? point_ : bench.point_at(pointer.at);
    if (has_hand_ && bench.system().grab && bench.system().grab->kind == GrabKind::Pull && bench.system().index_of(*point_) != no_index)
      marks.ghost_spring = std::pair{bench.snapshot().position(*point_), target_};
  }

 private:
  // A nailed point cannot be pulled: it is held.
  void take_hold(Workbench& bench) {
    const Defaults& defaults = bench.status->defaults;
    const bool nailed = bench.system().points()[bench.system().index_of(*point_)].nailed;
    const double stiffness = defaults.pull_stiffness > 0.0 ? defaults.pull_stiffness : fitting_pull(bench.system(), *point_);
    bench.lab.submit(
        GrabPoint{{.point = *point_, .kind = nailed ? GrabKind::Hold : defaults.grab, .target = target_, .stiffness = stiffness}},
        gesture_);
    has_hand_ = true;
  }

  void let_go(Workbench& bench) {
    if (std::exchange(has_hand_, false)) bench.lab.submit(ReleaseHand{}, gesture_);
  }

  std::optional<PointId> point_;
  Gesture gesture_ = 0;
  bool has_hand_ = false, has_moved_ = false;
  Vec3 anchor_{0.0}, offset_{0.0}, target_{0.0};
};

}  // namespace

std::unique_ptr<Tool> make_drag_tool() { return std::make_unique<DragTool>(); }

}  // namespace hooke
