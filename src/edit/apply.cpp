#include "edit/apply.h"

#include "edit/edits/edits.h"

namespace hooke {

std::vector<Command> apply(Scene& scene, const Command& command, Effect& effect) {
  const std::uint64_t revision = scene.revision;
  std::vector<Command> inverse = std::visit(Apply{scene, effect}, command);
  const bool is_state_only = std::holds_alternative<Move>(command) || std::holds_alternative<MoveHand>(command);
  scene.revision = is_state_only ? revision : revision + 1;
  return inverse;
}

}  // namespace hooke
