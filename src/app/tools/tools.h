// The tools on the left button: each a small machine that turns presses and moves of the mouse into commands.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/tools/tool_context.h"
#include "draw/marks.h"
#include "ui/panels.h"

namespace hooke {

struct Pointer {
  glm::dvec2 at{0.0};  // [px], in the scene's picture
  Modifiers modifiers;
  bool twice = false;  // the second press of a double click
};

class Tool {
 public:
  virtual ~Tool() = default;
  virtual void press(const Pointer&, ToolContext&) {}
  // Once a frame while the button is down, wherever the cursor is.
  virtual void follow(const Pointer&, ToolContext&) {}
  virtual void release(const Pointer&, ToolContext&) {}
  // Drops what is half done. False: there was nothing.
  virtual bool cancel(ToolContext&) { return false; }

  // For the status bar: "click the second point, Esc cancels".
  virtual std::string next_step(const ToolContext&) const = 0;
  // What lights up under the cursor, and what is about to be.
  virtual void mark(const Pointer&, const ToolContext&, Marks&) const {}
  // Two corners of a selection in progress [px].
  virtual std::optional<std::pair<glm::dvec2, glm::dvec2>> rubber_band() const { return std::nullopt; }
  // The way of a cut in progress [px].
  virtual std::vector<glm::dvec2> stroke() const { return {}; }
};

struct ToolRow {
  Action action;
  std::unique_ptr<Tool> (*make)();
};

// What does the work of each button (ui/tool_buttons.h).
std::span<const ToolRow> tools();

std::unique_ptr<Tool> make_select_tool();
std::unique_ptr<Tool> make_add_tool();
std::unique_ptr<Tool> make_attach_tool();
std::unique_ptr<Tool> make_nail_tool();
std::unique_ptr<Tool> make_drag_tool();
std::unique_ptr<Tool> make_cut_tool();
std::unique_ptr<Tool> make_delete_tool();

}  // namespace hooke
