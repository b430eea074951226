// The building tools: add a point, attach two points, nail a point, delete.
#include <glm/geometric.hpp>
#include <string_view>

#include "app/tools/tools.h"
#include "scene/new_point.h"
#include "scene/spring_laws.h"

namespace hooke {
namespace {

PlacedPoint placed(const NewPoint& point, const Vec3& place, ToolContext& context) {
  return {.point = {.id = context.lab.new_point_id(), .mass = point.mass, .radius = point.radius}, .position = place};
}

// Its rest length is the current distance.
PlacedSpring new_spring(PointId first, const Vec3& from, PointId second, const Vec3& to, ToolContext& context) {
  const Defaults& defaults = context.status->document->defaults;
  const double length = glm::distance(from, to);
  return {.spring = {.id = context.lab.new_spring_id(),
                     .first = first,
                     .second = second,
                     .stiffness = defaults.stiffness,
                     .damping = defaults.damping,
                     .rest_length = length,
                     .law = new_spring_law(defaults.law, defaults.stiffness, length)}};
}

// Attaches a point to the one under the cursor, or to a new one there. One step of the history. Returns the other end; nothing if it is the
// same point, or if the first one no longer exists.
std::optional<PointId> attach(PointId first, const Pointer& pointer, ToolContext& context) {
  const Index neighbor = context.system().index_of(first);
  if (neighbor == no_index) return std::nullopt;
  const Vec3 from = context.snapshot().position(first);
  if (const auto second = context.point_at(pointer.at)) {
    if (*second == first) {
      context.notice = "A spring needs two points: drag to another one, or to where to add one";
      return std::nullopt;
    }
    context.lab.submit(Insert{.springs = {new_spring(first, from, *second, context.snapshot().position(*second), context)}});
    return second;
  }
  const Vec3 place = context.place_beside(pointer, from);
  const NewPoint like = new_point_like(context.status->document->defaults, context.system().points()[neighbor]);
  const PlacedPoint added = placed(like, place, context);
  context.lab.submit(Insert{.points = {added}, .springs = {new_spring(first, from, added.point.id, place, context)}});
  context.settle();
  return added.point.id;
}

// What attaching would make: a spring, and a point if there is none under the cursor.
void mark_attachment(PointId first, const Pointer& pointer, const ToolContext& context, Marks& marks) {
  if (context.system().index_of(first) == no_index) return;
  marks.hovered_point = context.point_at(pointer.at);
  const Vec3 from = context.snapshot().position(first);
  const Vec3 to = marks.hovered_point ? context.snapshot().position(*marks.hovered_point) : context.place_beside(pointer, from);
  marks.ghost_spring = std::pair{from, to};
  if (!marks.hovered_point) marks.ghost_point = to;
}

// What new points are like. Computed when the scene or its defaults have changed: a large scene has many points.
class NewPoints {
 public:
  const NewPoint& like(const ToolContext& context) const {
    const Defaults& defaults = context.status->document->defaults;
    if (system_ != context.snapshot().system || defaults_ != defaults) {
      system_ = context.snapshot().system;
      defaults_ = defaults;
      point_ = new_point_like(defaults, *system_);
    }
    return point_;
  }
  Vec3 place(const Pointer& pointer, const ToolContext& context) const { return context.place_for_point(pointer, like(context).radius); }
  PointId add(const Pointer& pointer, ToolContext& context) const {
    const PlacedPoint added = placed(like(context), place(pointer, context), context);
    context.lab.submit(Insert{.points = {added}});
    return added.point.id;
  }

 private:
  mutable std::shared_ptr<const System> system_;  // that point_ was chosen for; null: none
  mutable Defaults defaults_;
  mutable NewPoint point_;
};

constexpr std::string_view snapping = "; Ctrl snaps to the grid";

// A click adds a point. A drag from a point adds the next one and attaches it.
class AddTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    pressed_at_ = pointer.at;
    first_ = context.point_at(pointer.at);
    if (!first_) new_points_.add(pointer, context);
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    const auto first = std::exchange(first_, std::nullopt);
    if (first && context.is_drag(pressed_at_, pointer.at))
      attach(*first, pointer, context);
    else if (first)
      context.notice = "There is a point here already: drag from it to attach the next one";
  }

  bool cancel(ToolContext&) override { return std::exchange(first_, std::nullopt).has_value(); }

  std::string next_step(const ToolContext& context) const override {
    if (first_) return std::string("release to add a point and attach it").append(snapping);
    const std::string where = context.system().dimensions == 2 ? "" : ", in the view plane or on the body under the cursor";
    return "click to add a point" + where + "; drag from a point to attach the next one" + std::string(snapping);
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    if (first_ && context.is_drag(pressed_at_, pointer.at)) return mark_attachment(*first_, pointer, context, marks);
    marks.hovered_point = context.point_at(pointer.at);
    if (!marks.hovered_point) marks.ghost_point = new_points_.place(pointer, context);
  }

 private:
  std::optional<PointId> first_;  // that a drag began at
  glm::dvec2 pressed_at_{0.0};
  NewPoints new_points_;
};

// Clicks attach point after point until Esc; a drag attaches two. Where there is no point, one is added.
class AttachTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    pressed_at_ = pointer.at;
    auto point = context.point_at(pointer.at);
    if (!first_ && !point) {
      point = new_points_.add(pointer, context);
      context.settle();
    }
    ends_ = first_ && point == first_;
    if (!first_ || ends_)
      first_ = point;
    else if (const auto second = attach(*first_, pointer, context))
      first_ = second;
    else
      first_.reset();
    may_be_drag_ = first_.has_value();
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    const bool is_drag = first_ && may_be_drag_ && context.is_drag(pressed_at_, pointer.at);
    may_be_drag_ = false;
    if (is_drag) attach(*first_, pointer, context);
    // a drag adds a single spring; a click on the last point ends the chain
    if (is_drag || ends_) first_.reset();
  }

  bool cancel(ToolContext&) override {
    may_be_drag_ = false;
    return std::exchange(first_, std::nullopt).has_value();
  }

  std::string next_step(const ToolContext&) const override {
    return first_ ? std::string("click the next point, or where to add one; the same point or Esc ends").append(snapping)
                  : std::string("click the first point, or where to add one; or drag to the next").append(snapping);
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    if (first_) return mark_attachment(*first_, pointer, context, marks);
    marks.hovered_point = context.point_at(pointer.at);
    if (!marks.hovered_point) marks.ghost_point = new_points_.place(pointer, context);
  }

 private:
  NewPoints new_points_;
  std::optional<PointId> first_;
  glm::dvec2 pressed_at_{0.0};
  bool may_be_drag_ = false, ends_ = false;
};

class NailTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    const auto point = context.point_at(pointer.at);
    if (!point) {
      context.notice = "There is no point here to nail or release";
      return;
    }
    const bool nailed = context.system().points()[context.system().index_of(*point)].nailed;
    context.lab.submit(SetNailed{{{*point, !nailed}}});
  }

  std::string next_step(const ToolContext&) const override { return "click a point to nail or release it; R releases all"; }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.hovered_point = context.point_at(pointer.at);
  }
};

class DeleteTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    if (const auto point = context.point_at(pointer.at))
      context.lab.submit(Remove{.points = {*point}});
    else if (const auto spring = context.spring_at(pointer.at))
      context.lab.submit(Remove{.springs = {*spring}});
    else if (const auto hit = context.collider_at(pointer.at))
      context.lab.submit(removal_of_collider(hit->collider, context));
    else
      context.notice = "There is nothing here to delete";
  }

  std::string next_step(const ToolContext&) const override { return "click a point, a spring or a body; Del deletes the selection"; }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.hovered_point = context.point_at(pointer.at);
    if (!marks.hovered_point) marks.hovered_spring = context.spring_at(pointer.at);
    if (marks.hovered_point || marks.hovered_spring) return;
    if (const auto hit = context.collider_at(pointer.at)) marks.hovered_collider = hit->collider;
  }
};

}  // namespace

std::unique_ptr<Tool> make_add_tool() { return std::make_unique<AddTool>(); }
std::unique_ptr<Tool> make_attach_tool() { return std::make_unique<AttachTool>(); }
std::unique_ptr<Tool> make_nail_tool() { return std::make_unique<NailTool>(); }
std::unique_ptr<Tool> make_delete_tool() { return std::make_unique<DeleteTool>(); }

}  // namespace hooke
