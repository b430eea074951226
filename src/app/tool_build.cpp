// The tools that build: add a point, attach two points, nail one, delete.
#include <glm/geometric.hpp>

#include "app/tools.h"

namespace hooke {
namespace {

class AddTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    const Defaults& defaults = bench.status->defaults;
    PlacedPoint placed;
    placed.point = {.id = bench.lab.new_point_id(), .mass = defaults.mass, .radius = defaults.radius};
    placed.position = bench.place_for_point(pointer.at, defaults.radius);
    bench.lab.submit(Insert{.points = {placed}});
  }

  std::string next_step(const Workbench& bench) const override {
    return bench.system().dimensions == 2 ? "click where the point shall be"
                                          : "click where the point shall be: facing you, or on a body under the cursor";
  }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.ghost_point = bench.place_for_point(pointer.at, bench.status->defaults.radius);
  }
};

// Two clicks, or a drag from one point to the other. With Shift the second point is the next spring's first.
class AttachTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    const auto point = bench.point_at(pointer.at);
    pressed_at_ = pointer.at;
    may_be_drag_ = false;
    if (!first_) {
      first_ = point;
      may_be_drag_ = point.has_value();
    } else if (point) {
      finish(*point, pointer, bench);
    }
  }

  void release(const Pointer& pointer, Workbench& bench) override {
    if (!first_ || !may_be_drag_ || !bench.is_drag(pressed_at_, pointer.at)) return;
    may_be_drag_ = false;
    const auto point = bench.point_at(pointer.at);
    if (point)
      finish(*point, pointer, bench);
    else
      first_.reset();
  }

  bool cancel(Workbench&) override { return std::exchange(first_, std::nullopt).has_value(); }

  std::string next_step(const Workbench&) const override {
    return first_ ? "click the second point, Shift goes on from there, Esc cancels" : "click the first point, or drag from point to point";
  }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.hovered_point = bench.point_at(pointer.at);
    if (!first_ || bench.system().index_of(*first_) == no_index) return;
    const Vec3 from = bench.snapshot().position(*first_);
    const Vec3 to = marks.hovered_point ? bench.snapshot().position(*marks.hovered_point) : bench.place_beside(pointer.at, from);
    marks.ghost_spring = std::pair{from, to};
  }

 private:
  // Rest length as drawn. The same point again, or a first point that is gone: nothing.
  void finish(PointId second, const Pointer& pointer, Workbench& bench) {
    const PointId first = *first_;
    first_ = pointer.modifiers.shift ? std::optional(second) : std::nullopt;
    if (first == second || bench.system().index_of(first) == no_index) return;
    const Defaults& defaults = bench.status->defaults;
    const double length = glm::distance(bench.snapshot().position(first), bench.snapshot().position(second));
    const Spring spring{.id = bench.lab.new_spring_id(),
                        .first = first,
                        .second = second,
                        .stiffness = defaults.stiffness,
                        .damping = defaults.damping,
                        .rest_length = length};
    bench.lab.submit(Insert{.springs = {{.spring = spring}}});
  }

  std::optional<PointId> first_;
  glm::dvec2 pressed_at_{0.0};
  bool may_be_drag_ = false;
};

class NailTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    const auto point = bench.point_at(pointer.at);
    if (!point) return;
    const bool nailed = bench.system().points()[bench.system().index_of(*point)].nailed;
    bench.lab.submit(SetNailed{{{*point, !nailed}}});
  }

  std::string next_step(const Workbench&) const override { return "click a point to nail it, a nailed one to free it; R frees all"; }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.hovered_point = bench.point_at(pointer.at);
  }
};

class DeleteTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    if (const auto point = bench.point_at(pointer.at))
      bench.lab.submit(Remove{.points = {*point}});
    else if (const auto spring = bench.spring_at(pointer.at))
      bench.lab.submit(Remove{.springs = {*spring}});
  }

  std::string next_step(const Workbench&) const override { return "click a point or a spring; Del deletes what is selected"; }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.hovered_point = bench.point_at(pointer.at);
    if (!marks.hovered_point) marks.hovered_spring = bench.spring_at(pointer.at);
  }
};

}  // namespace

std::unique_ptr<Tool> make_add_tool() { return std::make_unique<AddTool>(); }
std::unique_ptr<Tool> make_attach_tool() { return std::make_unique<AttachTool>(); }
std::unique_ptr<Tool> make_nail_tool() { return std::make_unique<NailTool>(); }
std::unique_ptr<Tool> make_delete_tool() { return std::make_unique<DeleteTool>(); }

}  // namespace hooke
