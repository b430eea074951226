// Drag: while the scene runs, the hand holds or pulls a point, or pulls a cloth between its points; a released point keeps the velocity of
// the hand. While it is paused, the point (on a cloth, the nearest one) follows the cursor. In both cases a drag is one undo step.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/tools/collider_drag.h"
#include "app/tools/tools.h"
#include "sim/forces/energy/energy.h"

namespace hooke {
namespace {

// A quarter of the stiffness of the attached springs: firm, but hardly faster than the scene itself. A point without springs oscillates
// about the cursor at 2 Hz: k = m (2 pi f)^2.
double fitting_pull(const System& system, const Patch& patch) {
  double stiffness = 0.0, mass = 0.0;
  for (const Spring& spring : system.springs())
    for (std::size_t p = 0; p < 3; ++p)
      if (spring.first == patch.points[p] || spring.second == patch.points[p]) stiffness += patch.weights[p] * system.stiffness_of(spring);
  if (stiffness > 0.0) return 0.25 * stiffness;
  for (std::size_t p = 0; p < 3; ++p) mass += patch.weights[p] * system.points()[system.index_of(patch.points[p])].mass;
  constexpr double omega = 2.0 * 3.14159265358979323846 * 2.0;  // [rad/s]
  return mass * omega * omega;
}

PointId nearest_corner(const Patch& patch) {
  return patch.points[static_cast<std::size_t>(std::ranges::max_element(patch.weights) - patch.weights.begin())];
}

// What a press would grab: a point, or a position on a cloth.
struct GrabTarget {
  PointId point;
  std::optional<Patch> patch;
  Vec3 place;
};
std::optional<GrabTarget> grab_target_at(const ToolContext& context, const glm::dvec2& cursor) {
  if (const auto point = context.point_at(cursor)) return GrabTarget{*point, std::nullopt, context.snapshot().position(*point)};
  const auto hit = context.surface_at(cursor);
  if (!hit) return std::nullopt;
  return GrabTarget{nearest_corner(hit->patch), hit->patch, hit->position};
}

class DragTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    pressed_at_ = pointer.at;
    grab_target_ = grab_target_at(context, pointer.at);
    if (!grab_target_ && !collider_.begin(pointer.at, DraggableColliders::All, context)) context.notice = "There is nothing here to drag";
    if (!grab_target_) return;
    gesture_ = context.begin_gesture();
    has_hand_ = has_moved_ = false;
    target_ = grab_target_->place;
    start_ = context.snapshot().position(grab_target_->point);
    // the point does not jump to the cursor: it keeps its offset
    offset_ = target_ - context.point_in_view_plane(pointer.at, target_);
    follow(pointer, context);
  }

  void follow(const Pointer& pointer, ToolContext& context) override {
    collider_.follow(pointer.at, context);
    if (!is_there(context)) return;
    const Vec3 target = context.point_in_view_plane(pointer.at, grab_target_->place) + offset_;
    const bool moved = target != target_;
    target_ = target;
    if (context.status->run.running) {
      if (!has_hand_)
        take_hold(context);
      else if (moved)
        context.lab.submit(MoveHand{target_}, gesture_);
    } else {
      let_go(context);
      if (moved) context.lab.submit(Move{{{grab_target_->point, start_ + (target_ - grab_target_->place), Vec3(0.0)}}}, gesture_);
      has_moved_ = has_moved_ || moved;
    }
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    follow(pointer, context);
    if ((grab_target_ || collider_.is_dragging()) && pointer.at == pressed_at_ && !context.status->run.running)
      context.notice = "Hold the button and move to drag";
    let_go(context);
    collider_.end(context);
    grab_target_.reset();
  }

  bool cancel(ToolContext& context) override {
    if (collider_.is_dragging()) {
      collider_.revert(context);
      return true;
    }
    if (!grab_target_) return false;
    const bool changed = has_hand_ || has_moved_;
    let_go(context);
    if (changed) context.lab.submit(Undo{});
    grab_target_.reset();
    return true;
  }

  std::string next_step(const ToolContext& context) const override {
    if (collider_.is_dragging()) return "move and release; Esc undoes";
    if (!grab_target_ && !context.system().colliders.empty()) return "drag a point, the cloth or a body";
    if (!grab_target_) return context.system().faces.empty() ? "drag a point" : "drag a point or the cloth";
    return context.status->run.running ? "move, and release to throw; Esc undoes" : "move and release; Esc undoes";
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    const auto grab_target = grab_target_ || collider_.is_dragging() ? grab_target_ : grab_target_at(context, pointer.at);
    marks.hovered_collider = collider_.collider();
    if (!grab_target && !collider_.is_dragging())
      if (const auto hit = collider_to_drag(context, pointer.at, DraggableColliders::All); hit && hit->bounded)
        marks.hovered_collider = hit->collider;
    if (grab_target && !grab_target->patch) marks.hovered_point = grab_target->point;
    const bool is_pulling = has_hand_ && context.system().grab && context.system().grab->kind == GrabKind::Pull;
    const Vec3 taken = is_pulling    ? grabbed_position(context.system(), context.snapshot().state)
                       : grab_target ? grab_target->place
                                     : Vec3(0.0);
    if (grab_target && grab_target->patch && (is_pulling || !grab_target_)) marks.ghost_point = taken;
    if (is_pulling) marks.ghost_spring = std::pair{taken, target_};
  }

 private:
  bool is_there(const ToolContext& context) const {
    const auto is_missing = [&](PointId id) { return context.system().index_of(id) == no_index; };
    return grab_target_ && !is_missing(grab_target_->point) &&
           !(grab_target_->patch && std::ranges::any_of(grab_target_->patch->points, is_missing));
  }

  // A nailed point cannot be pulled, so it is held; a position between points cannot be held, so it is pulled.
  void take_hold(ToolContext& context) {
    const Defaults& defaults = context.status->document->defaults;
    const bool nailed = context.system().points()[context.system().index_of(grab_target_->point)].nailed;
    const GrabKind kind = grab_target_->patch ? GrabKind::Pull : nailed ? GrabKind::Hold : defaults.grab;
    const Patch patch = grab_target_->patch.value_or(Patch{{grab_target_->point, grab_target_->point, grab_target_->point}});
    const double stiffness = defaults.pull_stiffness > 0.0 ? defaults.pull_stiffness : fitting_pull(context.system(), patch);
    context.lab.submit(
        GrabPoint{{.point = grab_target_->point, .patch = grab_target_->patch, .kind = kind, .target = target_, .stiffness = stiffness}},
        gesture_);
    has_hand_ = true;
  }

  void let_go(ToolContext& context) {
    if (std::exchange(has_hand_, false)) context.lab.submit(ReleaseHand{}, gesture_);
  }

  std::optional<GrabTarget> grab_target_;
  ColliderDrag collider_;  // used where there is no point
  Gesture gesture_ = 0;
  bool has_hand_ = false, has_moved_ = false;
  glm::dvec2 pressed_at_{0.0};
  Vec3 start_{0.0};                 // of the point
  Vec3 offset_{0.0}, target_{0.0};  // of the grabbed position
};

}  // namespace

std::unique_ptr<Tool> make_drag_tool() { return std::make_unique<DragTool>(); }

}  // namespace hooke
