// Drag: while the scene runs, the hand holds or pulls a point, or pulls a cloth by a place between its points, and letting go
// throws it; in a pause the point, the nearest one on a cloth, goes with the cursor. One step of undo either way.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/collider_drag.h"
#include "app/tools.h"
#include "sim/energy.h"

namespace hooke {
namespace {

// A quarter of what its springs hold it with: firm, and hardly faster than the scene itself. A loose point swings about the
// cursor twice a second: k = m (2 pi f)^2.
double fitting_pull(const System& system, const Patch& patch) {
  double stiffness = 0.0, mass = 0.0;
  for (const Spring& spring : system.springs())
    for (std::size_t p = 0; p < 3; ++p)
      if (spring.first == patch.points[p] || spring.second == patch.points[p]) stiffness += patch.shares[p] * system.stiffness_of(spring);
  if (stiffness > 0.0) return 0.25 * stiffness;
  for (std::size_t p = 0; p < 3; ++p) mass += patch.shares[p] * system.points()[system.index_of(patch.points[p])].mass;
  constexpr double omega = 2.0 * 3.14159265358979323846 * 2.0;  // [rad/s]
  return mass * omega * omega;
}

PointId nearest_corner(const Patch& patch) {
  return patch.points[static_cast<std::size_t>(std::ranges::max_element(patch.shares) - patch.shares.begin())];
}

// What a press would take: a point, or a place on a cloth.
struct Grip {
  PointId point;
  std::optional<Patch> patch;
  Vec3 place;
};
std::optional<Grip> grip_at(const Workbench& bench, const glm::dvec2& cursor) {
  if (const auto point = bench.point_at(cursor)) return Grip{*point, std::nullopt, bench.snapshot().position(*point)};
  const auto hit = bench.surface_at(cursor);
  if (!hit) return std::nullopt;
  return Grip{nearest_corner(hit->patch), hit->patch, hit->position};
}

class DragTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    grip_ = grip_at(bench, pointer.at);
    if (!grip_) collider_.begin(pointer.at, Takes::All, bench);
    if (!grip_) return;
    gesture_ = bench.begin_gesture();
    has_hand_ = has_moved_ = false;
    target_ = grip_->place;
    start_ = bench.snapshot().position(grip_->point);
    // the point does not jump to the cursor: it keeps its place beside it
    offset_ = target_ - bench.place_beside(pointer.at, target_);
    follow(pointer, bench);
  }

  void follow(const Pointer& pointer, Workbench& bench) override {
    collider_.follow(pointer.at, bench);
    if (!is_there(bench)) return;
    const Vec3 target = bench.place_beside(pointer.at, grip_->place) + offset_;
    const bool moved = target != target_;
    target_ = target;
    if (bench.status->running) {
      if (!has_hand_)
        take_hold(bench);
      else if (moved)
        bench.lab.submit(MoveHand{target_}, gesture_);
    } else {
      let_go(bench);
      if (moved) bench.lab.submit(Move{{{grip_->point, start_ + (target_ - grip_->place), Vec3(0.0)}}}, gesture_);
      has_moved_ = has_moved_ || moved;
    }
  }

  void release(const Pointer& pointer, Workbench& bench) override {
    follow(pointer, bench);
    let_go(bench);
    collider_.end(bench);
    grip_.reset();
  }

  bool cancel(Workbench& bench) override {
    if (collider_.is_dragging()) {
      collider_.take_back(bench);
      return true;
    }
    if (!grip_) return false;
    const bool changed = has_hand_ || has_moved_;
    let_go(bench);
    if (changed) bench.lab.submit(Undo{});
    grip_.reset();
    return true;
  }

  std::string next_step(const Workbench& bench) const override {
    if (collider_.is_dragging()) return "move it, and let go; Esc takes it back";
    if (!grip_ && !bench.system().colliders.empty()) return "press on a point, the cloth or what they lie on, and move it";
    if (!grip_) return bench.system().faces.empty() ? "press on a point and move it" : "press on a point or on the cloth and move it";
    return bench.status->running ? "move, and let go to throw; Esc takes it back" : "move, and let go; Esc takes it back";
  }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    const auto grip = grip_ || collider_.is_dragging() ? grip_ : grip_at(bench, pointer.at);
    marks.hovered_collider = collider_.collider();
    if (!grip && !collider_.is_dragging())
      if (const auto hit = collider_to_drag(bench, pointer.at, Takes::All); hit && hit->bounded) marks.hovered_collider = hit->collider;
    if (grip && !grip->patch) marks.hovered_point = grip->point;
    const bool is_pulling = has_hand_ && bench.system().grab && bench.system().grab->kind == GrabKind::Pull;
    const Vec3 taken = is_pulling ? grabbed_place(bench.system(), bench.snapshot().state) : grip ? grip->place : Vec3(0.0);
    if (grip && grip->patch && (is_pulling || !grip_)) marks.ghost_point = taken;
    if (is_pulling) marks.ghost_spring = std::pair{taken, target_};
  }

 private:
  bool is_there(const Workbench& bench) const {
    const auto is_gone = [&](PointId id) { return bench.system().index_of(id) == no_index; };
    return grip_ && !is_gone(grip_->point) && !(grip_->patch && std::ranges::any_of(grip_->patch->points, is_gone));
  }

  // A nailed point cannot be pulled: it is held. A place between points cannot be held: it is pulled.
  void take_hold(Workbench& bench) {
    const Defaults& defaults = bench.status->defaults;
    const bool nailed = bench.system().points()[bench.system().index_of(grip_->point)].nailed;
    const GrabKind kind = grip_->patch ? GrabKind::Pull : nailed ? GrabKind::Hold : defaults.grab;
    const Patch patch = grip_->patch.value_or(Patch{{grip_->point, grip_->point, grip_->point}});
    const double stiffness = defaults.pull_stiffness > 0.0 ? defaults.pull_stiffness : fitting_pull(bench.system(), patch);
    bench.lab.submit(GrabPoint{{.point = grip_->point, .patch = grip_->patch, .kind = kind, .target = target_, .stiffness = stiffness}},
                     gesture_);
    has_hand_ = true;
  }

  void let_go(Workbench& bench) {
    if (std::exchange(has_hand_, false)) bench.lab.submit(ReleaseHand{}, gesture_);
  }

  std::optional<Grip> grip_;
  ColliderDrag collider_;  // instead, where there is no point
  Gesture gesture_ = 0;
  bool has_hand_ = false, has_moved_ = false;
  Vec3 start_{0.0};                 // of the point
  Vec3 offset_{0.0}, target_{0.0};  // of the place
};

}  // namespace

std::unique_ptr<Tool> make_drag_tool() { return std::make_unique<DragTool>(); }

}  // namespace hooke
