#include "scene/spring_laws.h"

#include <cmath>

#include "base/bounds.h"

namespace hooke {

std::optional<SpringLaw> new_spring_law(int choice, double stiffness, double rest_length) {
  SpringLaw law;
  if (choice < static_cast<int>(spring_forces.size())) law.force = static_cast<SpringForce>(choice);
  if (law.force == SpringForce::Cubic && rest_length > 0.0) law.k3 = stiffness / (rest_length * rest_length);
  if (new_springs[choice].id == "muscle") law.amplitude = 0.2;
  if (new_springs[choice].id == "winch") law.rate = -0.1 * rest_length, law.min_rest_length = 0.2 * rest_length;
  return law == SpringLaw{} ? std::nullopt : std::optional(law);
}

LawError error_of(const Spring& spring) {
  if (!spring.law) return {};
  const SpringLaw& law = *spring.law;
  for (const double each : {law.k3, law.amplitude, law.frequency, law.phase, law.rate, law.min_rest_length})
    if (!std::isfinite(each)) return {"law", "must have finite numbers"};
  if (static_cast<std::size_t>(law.force) >= spring_forces.size()) return {"law", "must be a law"};
  if (law.k3 != 0.0 && law.force != SpringForce::Cubic) return {"k3", "must be 0 unless the law is \"cubic\""};
  if (law.k3 > 0.0 && spring.rest_length == 0.0) return {"k3", "must be at most 0 where the rest length is 0"};
  if (!(std::abs(law.amplitude) <= 1.0)) return {"muscle.amplitude", "must be from -1 to 1"};
  if (!not_negative.contains(law.frequency)) return {"muscle.frequency", not_negative.text()};
  if (!(law.min_rest_length >= 0.0 && law.max_rest_length >= law.min_rest_length))
    return {"rest_length_limits", "must be [minimum, maximum], from 0"};
  const bool is_within = spring.rest_length >= law.min_rest_length && spring.rest_length <= law.max_rest_length;
  if (law.rate != 0.0 && !is_within) return {"rest_length_limits", "must contain the rest length " + format_exact(spring.rest_length)};
  return {};
}

}  // namespace hooke
