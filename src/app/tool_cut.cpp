// Cut: springs that the cursor is dragged across go, and the faces along them, at once and whether the scene runs or not. A
// drag is one step of undo.
#include "app/tools.h"
#include "lab/tears.h"

namespace hooke {
namespace {

class CutTool : public Tool {
 public:
  void press(const Pointer& pointer, Workbench& bench) override {
    gesture_ = bench.begin_gesture();
    way_ = {pointer.at};
  }

  void follow(const Pointer& pointer, Workbench& bench) override {
    if (way_.empty() || pointer.at == way_.back()) return;
    const auto crossed = springs_across(bench.snapshot(), bench.lens(), way_.back(), pointer.at);
    way_.push_back(pointer.at);
    if (!crossed.empty()) bench.lab.submit(torn_by(bench.system(), crossed), gesture_);
  }

  void release(const Pointer& pointer, Workbench& bench) override {
    follow(pointer, bench);
    way_.clear();
  }

  bool cancel(Workbench&) override { return !std::exchange(way_, {}).empty(); }

  std::string next_step(const Workbench&) const override {
    return way_.empty() ? "drag across springs or the cloth" : "let go; Ctrl+Z mends it";
  }

  std::vector<glm::dvec2> stroke() const override { return way_; }

 private:
  std::vector<glm::dvec2> way_;  // [px], since the press
  Gesture gesture_ = 0;
};

}  // namespace

std::unique_ptr<Tool> make_cut_tool() { return std::make_unique<CutTool>(); }

}  // namespace hooke
