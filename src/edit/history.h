// Undo and redo: a list of named steps, each with the commands that undo it. Used only by Lab.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "edit/command.h"
#include "edit/history_list.h"

namespace hooke {

// Edits with the same gesture (a drag of a slider, a drag of a point) are one step. 0: a separate step.
using Gesture = std::uint64_t;

class History {
 public:
  // Whether a step changes what a file contains, or only the run: a drag in a running scene is undone like an edit, but not saved.
  enum class Of { Document, Run };

  // Records an edit that was just applied, by its inverse. Discards the steps that were undone.
  void record(const std::string& name, std::vector<Command> inverse, Gesture gesture, Of of = Of::Document);

  // Undoes or redoes steps until `steps` of them are in effect, or none are left.
  Effect go_to(std::size_t steps, Scene& scene);

  void clear();
  // The document is saved as it is now.
  void mark_saved();
  bool has_unsaved_changes() const;
  // A change of the document that is no step of the history.
  void record_unsaved_change(const std::string& name);
  // The name of the step that undo or redo would apply to, or an empty string.
  std::string undo_name() const { return done_.empty() ? std::string() : done_.back().name; }
  std::string redo_name() const { return undone_.empty() ? std::string() : undone_.back().name; }
  std::size_t done() const { return done_.size(); }
  std::size_t undone() const { return undone_.size(); }
  std::size_t bytes() const { return bytes_; }
  // The names of all steps; the same object until they change.
  std::shared_ptr<const HistoryList> list() const;

  // Beyond this many steps or bytes the oldest steps are discarded, but never the newest.
  static constexpr std::size_t max_steps = 10000, max_bytes = std::size_t{256} << 20;

 private:
  struct Step {
    std::string name;
    std::vector<Command> commands;  // applied in order
    Gesture gesture;
    Of of = Of::Document;
    std::size_t bytes = 0;
  };
  using Steps = std::deque<Step>;
  void move_step(Steps& from, Steps& to, Scene& scene, Effect& effect);
  void update_bytes(Step& step);
  void drop(Steps& steps);
  void drop_oldest();
  std::vector<std::string> unsaved_changes() const;

  Steps done_, undone_;
  std::size_t bytes_ = 0;
  std::size_t saved_ = 0;          // number of steps in effect when the document was saved
  std::vector<std::string> lost_;  // changes since then that are no steps, or whose steps are gone
  long recorded_ = 0;
  mutable std::shared_ptr<const HistoryList> list_;  // null: stale
};

}  // namespace hooke
