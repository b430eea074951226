#include "edit/apply.h"

namespace hooke {

Inverse apply(Scene& scene, const Command& command, Effect& effect) {
  const std::uint64_t revision = scene.revision;
  Inverse inverse = std::visit([&](const auto& each) { return each.apply(scene, effect); }, command);
  const bool is_state_only =
      std::holds_alternative<Move>(command) || std::holds_alternative<SetVelocity>(command) || std::holds_alternative<MoveHand>(command);
  scene.revision = is_state_only ? revision : revision + 1;
  return inverse;
}

}  // namespace hooke
