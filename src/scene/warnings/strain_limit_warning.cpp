#include "scene/warnings/strain_limit_warning.h"

#include <glm/geometric.hpp>

#include "base/number_text.h"

namespace hooke {

std::optional<std::string> strain_limit_warning(const System& system, const State& state) {
  constexpr double min_excess = 1.01;  // of the length, from which on energy is not conserved (sim/forces/spring_limits.cpp)
  if (!(system.strain_limit > 0.0)) return std::nullopt;
  std::size_t count = 0, index = 0;
  std::string first;
  for (const Spring& spring : system.springs()) {
    const std::size_t s = index++;
    if (!system.is_on(spring) || !(spring.rest_length > 0.0)) continue;
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const double length = glm::distance(state.position[i], state.position[j]), max = spring.rest_length * (1.0 + system.strain_limit);
    if (!(length > min_excess * max) || (system.points()[i].nailed && system.points()[j].nailed) || count++ != 0) continue;
    first = "spring " + std::to_string(s) + " (points " + std::to_string(i) + " and " + std::to_string(j) + ") starts " +
            quantity_text(length, "m", 3) + " long, where the limit is " + quantity_text(max, "m", 3);
  }
  if (count == 0) return std::nullopt;
  if (count > 1) first += " (the first of " + std::to_string(count) + " such springs)";
  return "strain_limit_percent: " + quantity_text(100.0 * system.strain_limit, "%", 3) + ": " + first +
         ": the first substep shortens what is too long at once, whatever the forces are";
}

}  // namespace hooke
