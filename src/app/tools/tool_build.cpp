// The building tools: add a point, attach two points, nail a point, delete.
#include <glm/geometric.hpp>

#include "app/tools/tools.h"

namespace hooke {
namespace {

class AddTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    const Defaults& defaults = context.status->document->defaults;
    PlacedPoint placed;
    placed.point = {.id = context.lab.new_point_id(), .mass = defaults.mass, .radius = defaults.radius};
    placed.position = context.place_for_point(pointer.at, defaults.radius);
    context.lab.submit(Insert{.points = {placed}});
  }

  std::string next_step(const ToolContext& context) const override {
    return context.system().dimensions == 2 ? "click to add a point"
                                            : "click to add a point, in the view plane or on the body under the cursor";
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.ghost_point = context.place_for_point(pointer.at, context.status->document->defaults.radius);
  }
};

// Two clicks, or a drag from one point to the other. With Shift the second point is the first one of the next spring.
class AttachTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    const auto point = context.point_at(pointer.at);
    pressed_at_ = pointer.at;
    may_be_drag_ = false;
    if (!first_) {
      first_ = point;
      may_be_drag_ = point.has_value();
    } else if (point) {
      finish(*point, pointer, context);
    }
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    if (!first_ || !may_be_drag_ || !context.is_drag(pressed_at_, pointer.at)) return;
    may_be_drag_ = false;
    const auto point = context.point_at(pointer.at);
    if (point)
      finish(*point, pointer, context);
    else
      first_.reset();
  }

  bool cancel(ToolContext&) override { return std::exchange(first_, std::nullopt).has_value(); }

  std::string next_step(const ToolContext&) const override {
    return first_ ? "click the second point; Shift+click continues from it, Esc cancels"
                  : "click the first point, or drag from point to point";
  }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.hovered_point = context.point_at(pointer.at);
    if (!first_ || context.system().index_of(*first_) == no_index) return;
    const Vec3 from = context.snapshot().position(*first_);
    const Vec3 to = marks.hovered_point ? context.snapshot().position(*marks.hovered_point) : context.point_in_view_plane(pointer.at, from);
    marks.ghost_spring = std::pair{from, to};
  }

 private:
  // The rest length is the current distance. Does nothing for the same point, or if the first point no longer exists.
  void finish(PointId second, const Pointer& pointer, ToolContext& context) {
    const PointId first = *first_;
    first_ = pointer.modifiers.shift ? std::optional(second) : std::nullopt;
    if (first == second || context.system().index_of(first) == no_index) return;
    const Defaults& defaults = context.status->document->defaults;
    const double length = glm::distance(context.snapshot().position(first), context.snapshot().position(second));
    const Spring spring{.id = context.lab.new_spring_id(),
                        .first = first,
                        .second = second,
                        .stiffness = defaults.stiffness,
                        .damping = defaults.damping,
                        .rest_length = length};
    context.lab.submit(Insert{.springs = {{.spring = spring}}});
  }

  std::optional<PointId> first_;
  glm::dvec2 pressed_at_{0.0};
  bool may_be_drag_ = false;
};

class NailTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    const auto point = context.point_at(pointer.at);
    if (!point) return;
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
  }

  std::string next_step(const ToolContext&) const override { return "click a point or a spring; Del deletes the selection"; }

  void mark(const Pointer& pointer, const ToolContext& context, Marks& marks) const override {
    marks.hovered_point = context.point_at(pointer.at);
    if (!marks.hovered_point) marks.hovered_spring = context.spring_at(pointer.at);
  }
};

}  // namespace

std::unique_ptr<Tool> make_add_tool() { return std::make_unique<AddTool>(); }
std::unique_ptr<Tool> make_attach_tool() { return std::make_unique<AttachTool>(); }
std::unique_ptr<Tool> make_nail_tool() { return std::make_unique<NailTool>(); }
std::unique_ptr<Tool> make_delete_tool() { return std::make_unique<DeleteTool>(); }

}  // namespace hooke
