// The amplification of methods that solve a linear spring on a nail exactly, and take listed forces at the start of the step:
//   x' = x + h v',  v' = ((E - phi q) v - phi omega^2 x) / (1 + phi (h omega^2 + lambda))
#pragma once

#include "sim/forces/kick.h"
#include "sim/methods/integrator.h"

namespace hooke {

inline Amplification amplification_of_linear_spring(const Oscillator& oscillator) {
  const auto [whole_decay, phi] = kick_over(oscillator.h_drag, 1.0);
  const double decay = whole_decay - phi * oscillator.h_rate;
  const double denominator = 1.0 + phi * (oscillator.h_omega_squared + oscillator.h_lambda);
  return {.trace = 1.0 + (decay - phi * oscillator.h_omega_squared) / denominator, .determinant = decay / denominator};
}

}  // namespace hooke
