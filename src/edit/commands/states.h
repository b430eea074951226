// Commands that go to another state of the run or to another scene.
#pragma once

#include <memory>
#include <string>

#include "edit/effect.h"

namespace hooke {

// Returns to another state of the same run: time, positions, velocities and tears.
struct GoToState {
  static constexpr std::string_view name = "go_to_state";
  static constexpr auto fields = names("state");
  std::shared_ptr<const State> state;

  std::string describe() const;
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const GoToState&) const { return true; }
};

// Sets the index of the latest tear (State::torn); 0 means intact.
struct SetTorn {
  static constexpr std::string_view name = "set_torn";
  static constexpr auto fields = names("torn");
  std::uint32_t torn;

  std::string describe() const { return torn == 0 ? "undo tears" : "tear"; }
  Inverse apply(Scene& scene, Effect& effect) const;
  bool is_undone_with(const SetTorn&) const { return true; }
};

// Sets the index of the tear after an inverse of SetTorn or GoToState has restored the springs and faces.
struct MarkTorn {
  static constexpr std::string_view name = "mark_torn";
  static constexpr auto fields = names("torn");
  std::uint32_t torn;

  std::string describe() const { return "tear"; }
  Inverse apply(Scene& scene, Effect& effect) const;
};

// Replaces the whole scene, to return to the start and to undo that.
struct Replace {
  static constexpr std::string_view name = "replace";
  static constexpr auto fields = names("scene");
  std::shared_ptr<const Scene> scene;

  std::string describe() const { return "back to start"; }
  Inverse apply(Scene& current, Effect& effect) const;
};

}  // namespace hooke
