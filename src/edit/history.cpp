#include "edit/history.h"

#include <algorithm>
#include <iterator>

namespace hooke {
namespace {

// Compared one by one: radii and the masses that follow them are two commands. What the first part of the gesture set is undone last,
// whatever happened after it, such as tears.
bool supersedes(const std::vector<Command>& earlier, const std::vector<Command>& later) {
  if (earlier.size() < later.size()) return false;
  return std::equal(later.begin(), later.end(), earlier.end() - static_cast<std::ptrdiff_t>(later.size()),
                    [](const Command& b, const Command& a) { return is_undone_with(b, a); });
}

}  // namespace

// Updates the memory use of the step and of the whole history.
void History::update_bytes(Step& step) {
  bytes_ -= step.bytes;
  step.bytes = sizeof(Step) + step.name.size();
  for (const Command& command : step.commands) step.bytes += bytes_of(command);
  bytes_ += step.bytes;
}

void History::drop(Steps& steps) {
  for (const Step& step : steps) bytes_ -= step.bytes;
  steps.clear();
}

void History::drop_oldest() {
  while (done_.size() > 1 && (done_.size() > max_steps || bytes_ > max_bytes)) {
    if (saved_ == 0 && done_.front().of == Of::Document) lost_.push_back(done_.front().name);
    saved_ -= std::min<std::size_t>(saved_, 1);
    bytes_ -= done_.front().bytes;
    done_.pop_front();
  }
}

void History::record(const std::string& name, std::vector<Command> inverse, Gesture gesture, Of of) {
  if (!undone_.empty()) list_.reset();
  // what was saved cannot be reached by redoing any more
  for (; saved_ > done_.size(); --saved_)
    if (const Step& undone = undone_[undone_.size() - (saved_ - done_.size())]; undone.of == Of::Document)
      lost_.push_back("undo " + undone.name);
  drop(undone_);
  if (inverse.empty()) return;
  ++recorded_;

  // the later parts of a gesture are undone first
  if (gesture != 0 && !done_.empty() && done_.back().gesture == gesture) {
    Step& step = done_.back();
    if (step.of != of) step.of = Of::Document, list_.reset();
    if (supersedes(step.commands, inverse)) {
      // the same values again: the step is named after the newest ones
      if (step.name != name) step.name = name, list_.reset();
      return;
    }
    step.commands.insert(step.commands.begin(), std::make_move_iterator(inverse.begin()), std::make_move_iterator(inverse.end()));
  } else {
    done_.push_back({name, std::move(inverse), gesture, of});
    list_.reset();
  }
  update_bytes(done_.back());
  drop_oldest();
}

// Undoing a step yields the commands that redo it, in reverse order.
void History::move_step(Steps& from, Steps& to, Scene& scene, Effect& effect) {
  Step step = std::move(from.back());
  from.pop_back();

  std::vector<Command> again;
  for (const Command& command : step.commands) {
    std::vector<Command> inverse = apply(scene, command, effect);
    again.insert(again.begin(), std::make_move_iterator(inverse.begin()), std::make_move_iterator(inverse.end()));
  }
  to.push_back({step.name, std::move(again), 0, step.of, step.bytes});
  update_bytes(to.back());
}

Effect History::go_to(std::size_t steps, Scene& scene) {
  list_.reset();
  Effect effect;
  while (done_.size() > steps) move_step(done_, undone_, scene, effect);
  while (done_.size() < steps && !undone_.empty()) move_step(undone_, done_, scene, effect);
  return effect;
}

void History::clear() {
  drop(done_);
  drop(undone_);
  mark_saved();
}

void History::mark_saved() {
  saved_ = done_.size();
  lost_.clear();
  list_.reset();
  // an edit in progress, such as the drag of a slider, is another step from here on
  if (!done_.empty()) done_.back().gesture = 0;
}

void History::record_unsaved_change(const std::string& name) {
  lost_.push_back(name);
  list_.reset();
}

bool History::has_unsaved_changes() const { return !list()->unsaved.empty(); }

std::vector<std::string> History::unsaved_changes() const {
  std::vector<std::string> changes = lost_;
  for (std::size_t step = saved_; step < done_.size(); ++step)
    if (done_[step].of == Of::Document) changes.push_back(done_[step].name);
  for (std::size_t step = saved_; step > done_.size(); --step)
    if (const Step& undone = undone_[undone_.size() - (step - done_.size())]; undone.of == Of::Document)
      changes.push_back("undo " + undone.name);
  return changes;
}

std::shared_ptr<const HistoryList> History::list() const {
  if (list_) return list_;
  auto list = std::make_shared<HistoryList>();
  list->done = done_.size();
  list->recorded = recorded_;
  list->unsaved = unsaved_changes();
  list->names.reserve(done_.size() + undone_.size());
  for (const Step& step : done_) list->names.push_back(step.name);
  for (auto step = undone_.rbegin(); step != undone_.rend(); ++step) list->names.push_back(step->name);
  return list_ = list;
}

}  // namespace hooke
