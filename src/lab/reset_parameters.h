// The parameters as they were when the document was opened.
#pragma once

#include <vector>

#include "edit/command.h"

namespace hooke {

// The commands that give `now` the parameters, the method and the forces of `opened`. Points and springs that were added since then keep
// theirs; positions, nails and structure are not parameters.
std::vector<Command> commands_to_reset_parameters(const Scene& now, const Scene& opened);

}  // namespace hooke
