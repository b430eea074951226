#include "edit/history.h"

#include <algorithm>
#include <iterator>

namespace hooke {
namespace {

// Compared one by one: radii and the masses that follow them are two commands.
bool supersedes(const std::vector<Command>& earlier, const std::vector<Command>& later) {
  return std::ranges::equal(earlier, later, [](const Command& a, const Command& b) { return is_undone_with(b, a); });
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
    bytes_ -= done_.front().bytes;
    done_.pop_front();
  }
}

void History::record(const std::string& name, std::vector<Command> inverse, Gesture gesture) {
  if (!undone_.empty()) list_.reset();
  drop(undone_);
  if (inverse.empty()) return;

  // the later parts of a gesture are undone first
  if (gesture != 0 && !done_.empty() && done_.back().gesture == gesture) {
    auto& commands = done_.back().commands;
    if (supersedes(commands, inverse)) return;
    commands.insert(commands.begin(), std::make_move_iterator(inverse.begin()), std::make_move_iterator(inverse.end()));
  } else {
    done_.push_back({name, std::move(inverse), gesture});
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
  to.push_back({step.name, std::move(again), 0, step.bytes});
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
  list_.reset();
}

std::shared_ptr<const HistoryList> History::list() const {
  if (list_) return list_;
  auto list = std::make_shared<HistoryList>();
  list->done = done_.size();
  list->names.reserve(done_.size() + undone_.size());
  for (const Step& step : done_) list->names.push_back(step.name);
  for (auto step = undone_.rbegin(); step != undone_.rend(); ++step) list->names.push_back(step->name);
  return list_ = list;
}

}  // namespace hooke
