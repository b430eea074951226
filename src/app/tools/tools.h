// The tools of the left mouse button: each is a small state machine that turns mouse events into commands.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/tools/tool_context.h"
#include "draw/marks.h"
#include "ui/panels.h"

namespace hooke {

class Tool {
 public:
  virtual ~Tool() = default;
  virtual void press(const Pointer&, ToolContext&) {}
  // Once per frame while the button is down, wherever the cursor is.
  virtual void follow(const Pointer&, ToolContext&) {}
  virtual void release(const Pointer&, ToolContext&) {}
  // Abandons an unfinished interaction. Returns false if there was none.
  virtual bool cancel(ToolContext&) { return false; }

  // For the status bar: "click the second point, Esc cancels".
  virtual std::string next_step(const ToolContext&) const = 0;
  // Highlights what is under the cursor, and previews what a press would do.
  virtual void mark(const Pointer&, const ToolContext&, Marks&) const {}
  // Opposite corners of a box selection in progress [px].
  virtual std::optional<std::pair<glm::dvec2, glm::dvec2>> rubber_band() const { return std::nullopt; }
  // The path of a cut in progress [px].
  virtual std::vector<glm::dvec2> stroke() const { return {}; }
};

struct ToolRow {
  Action action;
  std::unique_ptr<Tool> (*make)();
};

// The tools of ui/actions.inc, in the same order. To add one: a file with its class and its make function, and a row there.
std::span<const ToolRow> tools();

#define TOOL(id, keys, icon, name, text, make) std::unique_ptr<Tool> make();
#define ACTION(...)
#include "ui/actions.inc"

}  // namespace hooke
