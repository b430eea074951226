// Undo and redo: a list of named steps, each the commands that take it back. Used by Lab alone.
#pragma once

#include <string>
#include <vector>

#include "lab/apply.h"

namespace hooke {

// Edits that carry the same gesture (a drag of a slider, a drag of a point) are one step. 0: a step of its own.
using Gesture = std::uint64_t;

class History {
 public:
  // Notes an edit that was just applied and how to take it back. Forgets what was undone.
  void note(const std::string& name, std::vector<Command> inverse, Gesture gesture);

  // Applies the last step's inverse (or the last undone step again). Nothing to do: no effect.
  Effect undo(Scene& scene);
  Effect redo(Scene& scene);

  void clear();
  // What undo and redo would take, or an empty string.
  std::string undo_name() const { return done_.empty() ? std::string() : done_.back().name; }
  std::string redo_name() const { return undone_.empty() ? std::string() : undone_.back().name; }
  std::size_t size() const { return done_.size(); }

  // More steps than this are forgotten, the oldest first.
  static constexpr std::size_t most_steps = 10000;

 private:
  struct Step {
    std::string name;
    std::vector<Command> commands;  // applied in order
    Gesture gesture;
  };
  static Effect move_step(std::vector<Step>& from, std::vector<Step>& to, Scene& scene);

  std::vector<Step> done_, undone_;
};

}  // namespace hooke
