// What accompanies the run: the companions, the changes that a failure may be due to, and the states before drags.
#include <algorithm>

#include "lab/lab.h"

namespace hooke {

// Computes the companions of the last frame; false if `should_continue` ended it.
bool Lab::compute_companions(const std::function<bool()>& should_continue) {
  while (companions_.has_work()) {
    companions_.substep(scene_.system);
    if (!should_continue()) return false;
  }
  return true;
}

// `before`: the value that the command sets, before it was applied. The commands of one drag are one change.
void Lab::record_change(const Command& command, const std::string& before, const std::vector<Command>& inverse, Gesture gesture) {
  constexpr std::size_t max_changes = 100;
  constexpr double margin = 1.0;  // [s]
  std::erase_if(changes_, [&](const RecordedChange& each) { return each.time < explained_until_ - margin; });
  if (changes_.size() >= max_changes) changes_.erase(changes_.begin());
  if (gesture != 0 && !changes_.empty() && changes_.back().gesture == gesture &&
      std::ranges::equal(changes_.back().change.restore, inverse,
                         [](const Command& first, const Command& later) { return is_undone_with(later, first); })) {
    changes_.back().change.text = change_text(command, changes_.back().before, scene_);
    changes_.back().time = scene_.state.time;
    return;
  }
  changes_.push_back(
      {.change = {change_text(command, before, scene_), inverse}, .before = before, .gesture = gesture, .time = scene_.state.time});
}

// A drag in a run moves what the point touches and is attached to as well, and the run goes on: a point that is put back alone may be
// on the other side of a sheet. Undo returns to the state before the drag. Null: the command is no such drag.
std::shared_ptr<const State> Lab::state_before_drag(const Command& command, Gesture gesture, History::Of of) {
  if (of != History::Of::Run || !(is_grab(command) || std::holds_alternative<Move>(command))) return nullptr;
  if (gesture == 0 || gesture != drag_gesture_) before_drag_ = std::make_shared<const State>(scene_.state);
  drag_gesture_ = gesture;
  return before_drag_;
}

void Lab::return_to_state(const std::shared_ptr<const State>& state, std::vector<Command>& inverse) {
  if (inverse.empty()) return;
  std::erase_if(inverse, [](const Command& command) { return std::holds_alternative<Move>(command); });
  inverse.push_back(GoToState{state});
}

}  // namespace hooke
