#include "edit/apply.h"

#include "edit/edits/edits.h"

namespace hooke {

std::vector<Command> apply(Scene& scene, const Command& command, Effect& effect) { return std::visit(Apply{scene, effect}, command); }

}  // namespace hooke
