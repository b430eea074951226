// Select and move: a click selects, a drag of a point moves what is selected, a drag from empty space selects a box.
#include <algorithm>

#include "app/collider_drag.h"
#include "app/tools.h"

namespace hooke {
namespace {

class SelectTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    *this = {};
    pressed_at_ = current_ = pointer.at;
    const bool add = pointer.modifiers.shift;
    if (pointer.twice && !bench.selection.empty() && (bench.point_at(pointer.at) || bench.spring_at(pointer.at))) {
      bench.selection = connected(bench.system(), bench.selection);
      return;
    }
    if (const auto point = bench.point_at(pointer.at))
      press_point(*point, add, bench);
    else if (const auto spring = bench.spring_at(pointer.at))
      select(*spring, add, bench.selection);
    else if (collider_.begin(pointer.at, Takes::Bounded, bench))
      doing_ = Doing::Collider;
    else
      doing_ = Doing::Box;
  }

  void follow(const Pointer& pointer, Workbench& bench) override {
    current_ = pointer.at;
    if (doing_ == Doing::Waiting && bench.is_drag(pressed_at_, pointer.at)) begin_move(bench);
    if (doing_ == Doing::Moving) move(bench);
    if (doing_ == Doing::Collider && (collider_moves_ || bench.is_drag(pressed_at_, pointer.at))) {
      collider_moves_ = true;
      collider_.follow(pointer.at, bench);
    }
  }

  void release(const Pointer& pointer, Workbench& bench) override {
    follow(pointer, bench);
    if (doing_ == Doing::Box) select_box(pointer, bench);
    if (doing_ == Doing::Collider && !collider_moves_ && !pointer.modifiers.shift) bench.selection = {};
    collider_.end(bench);
    if (doing_ == Doing::Waiting) bench.selection = {{point_}, {}};
    *this = {};
  }

  bool cancel(Workbench& bench) override {
    const bool busy = doing_ != Doing::Nothing;
    if (doing_ == Doing::Moving) bench.lab.submit(Undo{});
    collider_.take_back(bench);
    *this = {};
    return busy;
  }

  std::string next_step(const Workbench& bench) const override {
    if (doing_ == Doing::Moving) return "let go to place it, Esc takes it back";
    if (doing_ == Doing::Collider) return "move it, and let go; Esc takes it back";
    if (doing_ == Doing::Box) return "drag over what is to be selected";
    if (!bench.selection.empty()) return "drag a selected point to move all, Shift+click adds, double click takes all connected";
    return "click a point or a spring, or drag a box from empty space";
  }

  void mark(const Pointer& pointer, const Workbench& bench, Marks& marks) const override {
    marks.hovered_collider = collider_.collider();
    if (doing_ != Doing::Nothing) return;
    marks.hovered_point = bench.point_at(pointer.at);
    if (!marks.hovered_point) marks.hovered_spring = bench.spring_at(pointer.at);
    if (marks.hovered_point || marks.hovered_spring) return;
    if (const auto hit = collider_to_drag(bench, pointer.at, Takes::Bounded)) marks.hovered_collider = hit->collider;
  }

  std::optional<std::pair<glm::dvec2, glm::dvec2>> rubber_band() const override {
    if (doing_ != Doing::Box) return std::nullopt;
    return std::pair{pressed_at_, current_};
  }

 private:
  enum class Doing { Nothing, Waiting, Moving, Box, Collider };

  template <class Id>
  static void select(Id id, bool add, Selection& selection) {
    if (!add) selection = {};
    selection.toggle(id);
  }

  // A selected point stays so until it is clear that it is not dragged.
  void press_point(PointId point, bool add, Workbench& bench) {
    point_ = point;
    if (add || !bench.selection.contains(point)) select(point, add, bench.selection);
    if (!add) doing_ = Doing::Waiting;
  }

  void begin_move(Workbench& bench) {
    if (bench.system().index_of(point_) == no_index) return;
    doing_ = Doing::Moving;
    gesture_ = bench.begin_gesture();
    anchor_ = bench.snapshot().position(point_);
    from_ = bench.place_beside(pressed_at_, anchor_);
    for (const PointId id : bench.selection.points)
      if (bench.system().index_of(id) != no_index) start_.emplace_back(id, bench.snapshot().position(id));
  }

  // While it runs, a moved point is at rest under the hand; in a pause it keeps its velocity.
  void move(Workbench& bench) {
    const Vec3 way = bench.place_beside(current_, anchor_) - from_;
    if (way == way_ && !bench.status->running) return;
    way_ = way;
    Move move;
    for (const auto& [id, start] : start_) {
      const Index i = bench.system().index_of(id);
      if (i != no_index) move.items.push_back({id, start + way, bench.status->running ? Vec3(0.0) : bench.snapshot().state.velocity[i]});
    }
    bench.lab.submit(move, gesture_);
  }

  void select_box(const Pointer& pointer, Workbench& bench) const {
    Selection found;
    if (bench.is_drag(pressed_at_, pointer.at))
      found = with_springs_between(bench.system(), points_in_box(bench.snapshot(), bench.lens(), pressed_at_, pointer.at));
    if (pointer.modifiers.shift)
      bench.selection.add(found);
    else
      bench.selection = found;
  }

  Doing doing_ = Doing::Nothing;
  glm::dvec2 pressed_at_{0.0}, current_{0.0};
  PointId point_{};
  ColliderDrag collider_;
  bool collider_moves_ = false;
  Gesture gesture_ = 0;
  Vec3 anchor_{0.0}, from_{0.0}, way_{0.0};
  std::vector<std::pair<PointId, Vec3>> start_;
};

}  // namespace

std::unique_ptr<Tool> make_select_tool() { return std::make_unique<SelectTool>(); }

}  // namespace hooke
