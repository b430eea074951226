// Cut: springs that the cursor is dragged across go, and the faces along them, at once and whether the scene runs or not. A
// drag is one step of undo.
#include "app/tools/tools.h"
#include "edit/tears.h"

namespace hooke {
namespace {

class CutTool : public Tool {
 public:
  void press(const Pointer& pointer, ToolContext& context) override {
    gesture_ = context.begin_gesture();
    displacement_ = {pointer.at};
  }

  void follow(const Pointer& pointer, ToolContext& context) override {
    if (displacement_.empty() || pointer.at == displacement_.back()) return;
    const auto crossed = springs_across(context.snapshot(), context.view_transform(), displacement_.back(), pointer.at);
    displacement_.push_back(pointer.at);
    if (!crossed.empty()) context.lab.submit(removal_of_broken(context.system(), crossed), gesture_);
  }

  void release(const Pointer& pointer, ToolContext& context) override {
    follow(pointer, context);
    displacement_.clear();
  }

  bool cancel(ToolContext&) override { return !std::exchange(displacement_, {}).empty(); }

  std::string next_step(const ToolContext&) const override {
    return displacement_.empty() ? "drag across springs or the cloth" : "let go; Ctrl+Z mends it";
  }

  std::vector<glm::dvec2> stroke() const override { return displacement_; }

 private:
  std::vector<glm::dvec2> displacement_;  // [px], since the press
  Gesture gesture_ = 0;
};

}  // namespace

std::unique_ptr<Tool> make_cut_tool() { return std::make_unique<CutTool>(); }

}  // namespace hooke
