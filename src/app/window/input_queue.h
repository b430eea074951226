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
    std::vector<int> pressed, released;
    bool edited = false;
    const auto contains = [](const std::vector<int>& keys, int key) { return std::ranges::find(keys, key) != keys.end(); };
    while (!waiting_.empty()) {
      const QueuedInput& next = waiting_.front();
      const bool is_edit = next.kind == QueuedInput::Kind::Edit, is_release = next.kind == QueuedInput::Kind::Release;
      if ((is_edit && contains(released, next.key)) || (is_release && contains(pressed, next.key))) return;
      // a text field handles characters first, and then a single editing key
      if (edited && (is_edit || next.kind == QueuedInput::Kind::Text)) return;
      if (is_edit) pressed.push_back(next.key);
      if (is_release) released.push_back(next.key);
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
