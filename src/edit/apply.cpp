#include "edit/apply.h"

#include "sim/control/automatic.h"

namespace hooke {

Inverse apply(Scene& scene, const Command& command, Effect& effect) {
  const std::uint64_t revision = scene.revision;
  Effect own;
  Inverse inverse = std::visit([&](const auto& each) { return each.apply(scene, own); }, command);
  if (own.invalidates_frame()) compare_after_edit(scene.state.memory);
  effect.structure = effect.structure || own.structure;
  effect.values = effect.values || own.values;
  effect.motion = effect.motion || own.motion;
  const bool is_state_only = std::holds_alternative<Move>(command) || std::holds_alternative<MoveHand>(command);
  scene.revision = is_state_only ? revision : revision + 1;
  return inverse;
}

}  // namespace hooke
