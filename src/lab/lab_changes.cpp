// What accompanies the run: the companions, and the changes that a failure may be due to.
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

}  // namespace hooke
