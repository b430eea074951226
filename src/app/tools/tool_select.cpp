// Select and move: a click selects, dragging a point moves the selection, dragging from empty space selects a box.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/tools/collider_drag.h"
#include "app/tools/tools.h"
#include "app/tools/transform_handles.h"
#include "app/view/arrows.h"
#include "scene/collider_kinds.h"
#include "ui/text.h"

namespace hooke {
namespace {

constexpr const char* alt_drags = "Alt+drag from a point sets its velocity";

class SelectTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    *this = {};
    pressed_at_ = current_ = pointer.at;
    const bool add = pointer.modifiers.shift;
    if (pointer.twice && !context.selection.empty() && (context.point_at(pointer.at) || context.spring_at(pointer.at))) {
      context.selection = select_connected(context.system(), context.selection);
      return;
    }
    if (pointer.modifiers.alt) return press_velocity(context);
    if (transform_.begin(pointer, context)) {
      interaction_ = Interaction::Transforming;
      return;
    }
    if (const auto handle = handle_at(pointer.at, context)) {
      handle_ = *handle;
      gesture_ = context.begin_gesture();
      interaction_ = Interaction::Sizing;
    } else if (const auto point = context.point_at(pointer.at))
      press_point(*point, add, context);
    else if (const auto spring = context.spring_at(pointer.at))
      select(*spring, add, context.selection);
    else if (collider_.begin(pointer.at, DraggableColliders::Bounded, context))
      interaction_ = Interaction::Collider;
    else {
      interaction_ = Interaction::Box;
      if (pointer.modifiers.control) lasso_ = {pointer.at};
    }
  }

  void follow(const Pointer& pointer, ToolContext& context) override {
    current_ = pointer.at;
    if (!lasso_.empty() && lasso_.back() != pointer.at) lasso_.push_back(pointer.at);
    transform_.follow(pointer, context);
    if (interaction_ == Interaction::Waiting && context.is_drag(pressed_at_, pointer.at)) begin_move(context);
    if (interaction_ == Interaction::Moving) move(context);
    if (interaction_ == Interaction::Sizing) size(context);
    if (interaction_ == Interaction::Collider && (collider_moves_ || context.is_drag(pressed_at_, pointer.at))) {
      collider_moves_ = true;
      collider_.follow(pointer.at, context);
    }
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    follow(pointer, context);
    if (interaction_ == Interaction::Box) select_box(pointer, context);
    if (interaction_ == Interaction::Velocity) set_velocity(context);
    if (interaction_ == Interaction::Collider && !collider_moves_)
      context.selection = {.points = {}, .springs = {}, .collider = collider_.collider()};
    if (is_sized_ && context.settle())
      if (const auto sized = selected_collider(context)) context.note_gaps(*sized);
    collider_.end(context);
    if (interaction_ == Interaction::Waiting) context.selection = {{point_}, {}};
    *this = {};
  }

  bool cancel(ToolContext& context) override {
    const bool busy = interaction_ != Interaction::Nothing;
    if (interaction_ == Interaction::Moving || is_sized_) context.lab.submit(Undo{});
    collider_.revert(context);
    transform_.revert(context);
    *this = {};
    return busy;
  }

  std::string next_step(const ToolContext& context) const override {
    if (interaction_ == Interaction::Moving) return "release to finish, Esc undoes";
    if (interaction_ == Interaction::Collider || interaction_ == Interaction::Sizing) return "move and release; Esc undoes";
    if (interaction_ == Interaction::Box) return "drag a box around what to select";
    if (interaction_ == Interaction::Transforming) return transform_.text();
    if (interaction_ == Interaction::Velocity)
      return "velocity " + quantity_text(glm::length(velocity(context)), "m/s") + "; release sets it, Esc cancels";
    if (context.selection.collider) return "drag the body to move it, its handles to size it; Del deletes it";
    if (!context.selection.empty())
      return "drag a selected point to move all; Alt+drag sets its velocity; Shift+click adds; double-click selects connected";
    return "click a point or a spring; drag a box from empty space, with Ctrl a lasso";
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.hovered_collider = collider_.collider();
    mark_handles(context, marks);
    if (interaction_ == Interaction::Nothing || interaction_ == Interaction::Transforming) transform_.mark(context, marks);
    if (interaction_ == Interaction::Velocity && context.system().index_of(point_) != no_index) {
      const Vec3 from = context.snapshot().position(point_);
      marks.arrows.insert(marks.arrows.begin(),
                          {Arrows::Kind::Velocity, arrow_seconds_, {{from, from + arrow_seconds_ * velocity(context)}}});
    }
    if (interaction_ != Interaction::Nothing) return;
    marks.hovered_point = context.point_at(pointer.at);
    if (!marks.hovered_point) marks.hovered_spring = context.spring_at(pointer.at);
    if (marks.hovered_point || marks.hovered_spring) return;
    if (const auto hit = collider_to_drag(context, pointer.at, DraggableColliders::Bounded)) marks.hovered_collider = hit->collider;
  }

  std::optional<std::pair<glm::dvec2, glm::dvec2>> rubber_band() const override {
    if (interaction_ != Interaction::Box || !lasso_.empty()) return std::nullopt;
    return std::pair{pressed_at_, current_};
  }

  std::vector<glm::dvec2> stroke() const override { return lasso_; }

 private:
  enum class Interaction { Nothing, Waiting, Moving, Box, Collider, Sizing, Velocity, Transforming };

  // The selected collider where it is now; none if there is none.
  static std::optional<Collider> selected_collider(const ToolContext& context) {
    const auto& selected = context.selection.collider;
    const System& system = context.system();
    if (!selected || *selected >= static_cast<Index>(system.colliders.size())) return std::nullopt;
    return carried_colliders(system, context.snapshot().state)[static_cast<std::size_t>(*selected)];
  }

  // The length of the normal of a plane that is drawn [m].
  static double plane_size(const ToolContext& context) {
    return context.camera.meters_per_pixel(context.camera.target, context.size) * context.size.y / 3.0;
  }

  static std::optional<std::size_t> handle_at(const glm::dvec2& cursor, const ToolContext& context) {
    const auto collider = selected_collider(context);
    if (!collider) return std::nullopt;
    constexpr double reach = 10.0;  // [design units]
    const std::vector<Vec3> handles = handles_of(*collider, context.system().dimensions, plane_size(context));
    for (std::size_t i = 0; i < handles.size(); ++i)
      if (const auto seen = project_to_screen(context.view_transform(), handles[i]);
          seen && glm::distance(*seen, cursor) <= reach * context.scale)
        return i;
    return std::nullopt;
  }

  static void mark_handles(const ToolContext& context, Marks& marks) {
    const auto collider = selected_collider(context);
    if (!collider) return;
    const double size = plane_size(context);
    marks.ghost_lines = outline_of(*collider, size);
    marks.ghost_nails = handles_of(*collider, context.system().dimensions, size);
  }

  void size(ToolContext& context) {
    const auto collider = selected_collider(context);
    const bool moved = is_sized_ || context.is_drag(pressed_at_, current_);
    if (!collider || !moved) return;
    const std::vector<Vec3> handles = handles_of(*collider, context.system().dimensions, plane_size(context));
    std::vector<Collider> colliders = carried_colliders(context.system(), context.snapshot().state);
    Collider& mine = colliders[static_cast<std::size_t>(*context.selection.collider)];
    mine = with_handle_at(mine, handle_, context.point_in_view_plane(current_, handles[handle_]));
    if (mine == *collider) return;
    context.lab.submit(SetColliders{std::move(colliders)}, gesture_);
    is_sized_ = true;
  }

  template <class Id>
  static void select(Id id, bool add, Selection& selection) {
    if (!add) selection = {};
    selection.toggle(id);
  }

  // A selected point stays selected until it is clear that it is not being dragged.
  void press_point(PointId point, bool add, ToolContext& context) {
    point_ = point;
    if (add || !context.selection.contains(point)) select(point, add, context.selection);
    if (!add) interaction_ = Interaction::Waiting;
  }

  void press_velocity(ToolContext& context) {
    const auto point = context.point_at(pressed_at_);
    if (!point || context.system().points()[context.system().index_of(*point)].nailed) {
      context.notice = point ? "A nailed point has no velocity: release it first" : alt_drags;
      return;
    }
    point_ = *point;
    if (!context.selection.contains(point_)) context.selection = {{point_}, {}};
    arrow_seconds_ = velocity_arrow_seconds(context.view_height());
    interaction_ = Interaction::Velocity;
  }

  // The arrow from the point to the cursor.
  Vec3 velocity(const ToolContext& context) const {
    if (context.system().index_of(point_) == no_index) return Vec3(0.0);
    const Vec3 from = context.snapshot().position(point_);
    return (context.point_in_view_plane(current_, from) - from) / arrow_seconds_;
  }

  // Of all selected points.
  void set_velocity(ToolContext& context) const {
    SetVelocity set;
    if (!context.is_drag(pressed_at_, current_)) {
      context.notice = alt_drags;
      return;
    }
    for (const PointId id : context.selection.points) set.values.emplace_back(id, velocity(context));
    context.lab.submit(std::move(set));
  }

  void begin_move(ToolContext& context) {
    if (context.system().index_of(point_) == no_index) return;
    interaction_ = Interaction::Moving;
    gesture_ = context.begin_gesture();
    anchor_ = context.snapshot().position(point_);
    from_ = context.point_in_view_plane(pressed_at_, anchor_);
    for (const PointId id : context.selection.points)
      if (context.system().index_of(id) != no_index) start_.emplace_back(id, context.snapshot().position(id));
  }

  // In a running scene a moved point is at rest while it is held; in a paused one it keeps its velocity.
  void move(ToolContext& context) {
    const Vec3 displacement = context.point_in_view_plane(current_, anchor_) - from_;
    if (displacement == displacement_ && !context.status->run.running) return;
    displacement_ = displacement;
    Move move;
    for (const auto& [id, start] : start_) {
      const Index i = context.system().index_of(id);
      if (i != no_index)
        move.items.push_back({id, start + displacement, context.status->run.running ? Vec3(0.0) : context.snapshot().state.velocity[i]});
    }
    context.lab.submit(move, gesture_);
  }

  // Of the box or the lasso.
  std::vector<glm::dvec2> outline() const {
    if (!lasso_.empty()) return lasso_;
    return {pressed_at_, {current_.x, pressed_at_.y}, current_, {pressed_at_.x, current_.y}};
  }

  void select_box(const Pointer& pointer, ToolContext& context) const {
    Selection found;
    // a click on a plane, which a drag does not move
    if (!context.is_drag(pressed_at_, pointer.at) && !pointer.modifiers.shift)
      if (const auto hit = context.collider_at(pointer.at)) found.collider = hit->collider;
    if (context.is_drag(pressed_at_, pointer.at))
      found = select_with_springs_between(context.system(), points_within(context.snapshot(), context.view_transform(), outline()));
    // a click into empty space is how fields are left and selections are dropped: it needs no message
    if (found.empty() && context.is_drag(pressed_at_, pointer.at)) context.notice = "There is no point in this area: drag around a point";
    if (pointer.modifiers.shift)
      context.selection.add(found);
    else
      context.selection = found;
  }

  Interaction interaction_ = Interaction::Nothing;
  glm::dvec2 pressed_at_{0.0}, current_{0.0};
  PointId point_{};
  ColliderDrag collider_;
  TransformHandles transform_;
  std::vector<glm::dvec2> lasso_;  // [px], since the press; empty: a box
  bool collider_moves_ = false, is_sized_ = false;
  std::size_t handle_ = 0;  // of the selected collider
  Gesture gesture_ = 0;
  double arrow_seconds_ = 1.0;  // of the arrow of a velocity
  Vec3 anchor_{0.0}, from_{0.0}, displacement_{0.0};
  std::vector<std::pair<PointId, Vec3>> start_;
};

}  // namespace

std::unique_ptr<Tool> make_select_tool() { return std::make_unique<SelectTool>(); }

}  // namespace hooke
