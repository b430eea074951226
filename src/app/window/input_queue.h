// The input of the window in order, divided into frames. ImGui reads the keyboard once per frame and would miss parts of a key press and
// release, or of two editing keys, within one frame. Input that does not fit into a frame waits for the next one.
#pragma once

#include <algorithm>
#include <deque>
#include <functional>
#include <vector>

namespace hooke {

struct QueuedInput {
  enum class Kind {
    Other,    // does not depend on the keyboard
    Edit,     // press of a key that a text field handles itself: Backspace, an arrow, Enter, Ctrl+A
    Press,    // press of another key
    Release,  // of any key
    Text,     // a typed character
  };
  Kind kind = Kind::Other;
  int key = 0;  // for the kinds that refer to a key
  std::function<void()> apply;
};

class InputQueue {
 public:
  void add(QueuedInput input) { waiting_.push_back(std::move(input)); }

  // Applies the input of one frame, oldest first.
  void apply_frame() {
    // of the editing keys; other keys act through the characters that they type
    std::vector<int> released;
    bool edited = false;
    while (!waiting_.empty()) {
      const QueuedInput& next = waiting_.front();
      const bool is_edit = next.kind == QueuedInput::Kind::Edit;
      // a text field handles characters first, and then a single editing key, with the modifiers of the end of the frame
      if (edited && next.kind != QueuedInput::Kind::Other) return;
      if (is_edit && std::ranges::find(released, next.key) != released.end()) return;
      if (next.kind == QueuedInput::Kind::Release) released.push_back(next.key);
      edited = edited || is_edit;
      const std::function<void()> apply = next.apply;
      waiting_.pop_front();
      apply();
    }
  }

 private:
  std::deque<QueuedInput> waiting_;
};

}  // namespace hooke
