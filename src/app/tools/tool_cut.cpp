// Cut: removes springs that the cursor is dragged across, and the faces along them, immediately, whether or not the scene runs. A drag is
// one undo step.
#include "app/tools/tools.h"
#include "edit/tears.h"

namespace hooke {
namespace {

class CutTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    gesture_ = context.begin_gesture();
    path_ = {pointer.at};
    has_cut_ = false;
  }

  void follow(const Pointer& pointer, ToolContext& context) override {
    if (path_.empty() || pointer.at == path_.back()) return;
    const auto crossed = springs_across(context.snapshot(), context.view_transform(), path_.back(), pointer.at);
    path_.push_back(pointer.at);
    has_cut_ = has_cut_ || !crossed.empty();
    if (!crossed.empty()) context.lab.submit(removal_of_broken(context.system(), crossed), gesture_);
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    follow(pointer, context);
    if (!has_cut_ && !path_.empty()) context.notice = "No spring was crossed: drag across springs or the cloth";
    path_.clear();
  }

  bool cancel(ToolContext&) override { return !std::exchange(path_, {}).empty(); }

  std::string next_step(const ToolContext&) const override {
    return path_.empty() ? "drag across springs or the cloth" : "release to finish; Ctrl+Z undoes the cut";
  }

  std::vector<glm::dvec2> stroke() const override { return path_; }

 private:
  std::vector<glm::dvec2> path_;  // [px], since the press
  Gesture gesture_ = 0;
  bool has_cut_ = false;
};

}  // namespace

std::unique_ptr<Tool> make_cut_tool() { return std::make_unique<CutTool>(); }

}  // namespace hooke
