// Edits of the selection as a whole: copy, cut, paste, duplicate, delete. Parts of a scene are copied as text, so that they can be pasted
// into another Hooke window.
#pragma once

#include <optional>

#include "app/edit/clipboard.h"
#include "app/tools/tool_context.h"
#include "app/work/file_task.h"
#include "edit/arrange.h"

namespace hooke {

class SelectionEditor {
 public:
  SelectionEditor(ToolContext& context, Panels& panels, FileTask& task, Clipboard& clipboard)
      : context_(context), panels_(panels), task_(task), clipboard_(clipboard) {}

  void copy() { copy(AfterCopy::Keep); }
  void cut() { copy(AfterCopy::Delete); }
  // At `place` [px] in the view of the scene, by default at its center.
  void paste(const std::optional<glm::dvec2>& place);
  void duplicate();
  void delete_selection();
  void weld();
  void split();

 private:
  enum class AfterCopy { Keep, Delete };
  void copy(AfterCopy after_copy);
  void paste(const Scene& part, const glm::dvec2& place);
  Scene selected_part() const;
  void insert(const Scene& part, const Vec3& displacement);

  ToolContext& context_;
  Panels& panels_;
  FileTask& task_;
  Clipboard& clipboard_;
};

}  // namespace hooke
