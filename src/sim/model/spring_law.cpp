#include "sim/model/spring_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/model/constants.h"
#include "sim/model/portable_math.h"

namespace hooke {

SpringResponse response_of(const SpringLaw& law, double k, double e) {
  const bool is_off = (law.force == SpringForce::Cable && !(e > 0.0)) || (law.force == SpringForce::Strut && !(e < 0.0));
  if (is_off || k == 0.0) return {};
  if (law.force != SpringForce::Cubic) return {k * e, k, 0.5 * k * e * e, true};
  // softening: the derivative k + 3 k3 e^2 is zero at e = p
  const double p = law.k3 < 0.0 ? std::sqrt(k / (-3.0 * law.k3)) : std::numeric_limits<double>::infinity();
  const double c = std::clamp(e, -p, p), square = c * c, tension = (k + law.k3 * square) * c;
  return {tension, c == e ? k + 3.0 * law.k3 * square : 0.0, (0.5 * k + 0.25 * law.k3 * square) * square + tension * (e - c), true};
}

double SpringLaw::resolving_step(double speed) const {
  if (amplitude == 0.0 || frequency * speed == 0.0) return std::numeric_limits<double>::infinity();
  return 1.0 / (steps_per_period * frequency * speed);
}

double max_stiffness(const SpringLaw& law, double k, double rest_length) {
  return law.force == SpringForce::Cubic && k > 0.0 ? k + 3.0 * std::max(0.0, law.k3) * rest_length * rest_length : k;
}

MovingLength rest_length_at(const SpringLaw& law, double rest_length, double time) {
  const double wound = rest_length + law.rate * time;
  const bool winds = wound >= law.min_rest_length && wound <= law.max_rest_length;
  MovingLength rest{law.rate == 0.0 ? rest_length : std::clamp(wound, law.min_rest_length, law.max_rest_length), winds ? law.rate : 0.0};
  if (law.amplitude == 0.0) return rest;
  const double omega = 2.0 * std::numbers::pi * law.frequency, angle = omega * time + law.phase;
  const double factor = 1.0 + law.amplitude * portable::sin(angle);
  rest.rate = rest.rate * factor + rest.length * law.amplitude * omega * portable::cos(angle);
  rest.length *= factor;
  return rest;
}

}  // namespace hooke
