#include "lab/history.h"

#include <algorithm>
#include <iterator>

namespace hooke {
namespace {

template <class Item>
bool same_ids(const std::vector<std::pair<Item, double>>& a, const std::vector<std::pair<Item, double>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return x.first == y.first; });
}

// Whether taking back `earlier` also takes back `later`: both set the same things.
struct Supersedes {
  bool operator()(const RestoreParameter& earlier, const RestoreParameter& later) const { return earlier.parameter == later.parameter; }
  bool operator()(const SetIntegrator&, const SetIntegrator&) const { return true; }
  bool operator()(const SetGravity&, const SetGravity&) const { return true; }
  bool operator()(const SetColliders&, const SetColliders&) const { return true; }
  bool operator()(const SetForces&, const SetForces&) const { return true; }
  bool operator()(const SetSpringProperty& earlier, const SetSpringProperty& later) const {
    return earlier.property == later.property && same_ids(earlier.values, later.values);
  }
  bool operator()(const SetPointProperty& earlier, const SetPointProperty& later) const {
    return earlier.property == later.property && same_ids(earlier.values, later.values);
  }
  bool operator()(const Move& earlier, const Move& later) const {
    return std::equal(earlier.items.begin(), earlier.items.end(), later.items.begin(), later.items.end(),
                      [](const auto& x, const auto& y) { return x.point == y.point; });
  }
  template <class A, class B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

bool supersedes(const std::vector<Command>& earlier, const std::vector<Command>& later) {
  return earlier.size() == 1 && later.size() == 1 && std::visit(Supersedes{}, earlier.front(), later.front());
}

}  // namespace

void History::note(const std::string& name, std::vector<Command> inverse, Gesture gesture) {
  undone_.clear();
  if (inverse.empty()) return;

  // a gesture's later parts are taken back before its earlier ones
  if (gesture != 0 && !done_.empty() && done_.back().gesture == gesture) {
    auto& commands = done_.back().commands;
    if (supersedes(commands, inverse)) return;
    commands.insert(commands.begin(), std::make_move_iterator(inverse.begin()), std::make_move_iterator(inverse.end()));
    return;
  }
  done_.push_back({name, std::move(inverse), gesture});
  if (done_.size() > most_steps) done_.erase(done_.begin());
}

// Taking a step back yields the commands that do it again, in the opposite order.
Effect History::move_step(std::vector<Step>& from, std::vector<Step>& to, Scene& scene) {
  Effect effect;
  if (from.empty()) return effect;
  Step step = std::move(from.back());
  from.pop_back();

  std::vector<Command> again;
  for (const Command& command : step.commands) {
    std::vector<Command> inverse = apply(scene, command, effect);
    again.insert(again.begin(), std::make_move_iterator(inverse.begin()), std::make_move_iterator(inverse.end()));
  }
  to.push_back({step.name, std::move(again), 0});
  return effect;
}

Effect History::undo(Scene& scene) { return move_step(done_, undone_, scene); }
Effect History::redo(Scene& scene) { return move_step(undone_, done_, scene); }

void History::clear() {
  done_.clear();
  undone_.clear();
}

}  // namespace hooke
