#include "sim/step/automatic/resonance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/methods/rows.h"

namespace hooke {
namespace {

// Of h omega: where the resonance begins, and where steps beyond it are used up to.
constexpr double resonance_begin = 3.163, resonance_limit = 4.97;
constexpr double max_growth_per_step = 0.0024, max_growth = 2.0;
constexpr int max_resonant_substeps = 150;
constexpr double max_relative_speed = 2e-3;

}  // namespace

bool may_step_beyond_resonance(const Plan& plan, double target, double speed) {
  const bool has_only_springs = plan.forces.empty() && !plan.hand.held && !plan.hand.pull && !plan.has_contact() &&
                                plan.spring.max_length.empty() && plan.spring.break_length.empty() && !plan.has_dashpots();
  return has_only_springs && plan.spectrum.omega * target <= max_relative_speed * speed;
}

int substeps_beyond_resonance(const Integrator& method, const Spectrum& spectrum, double frame_rate, double frequency, int stable) {
  if (&method != &blanes_moan4) return stable;
  const double substeps = std::max(1.0, std::ceil(frequency * spectrum.omega / (frame_rate * resonance_limit)));
  return substeps <= max_resonant_substeps ? std::min(stable, static_cast<int>(substeps)) : stable;
}

int max_frames_in_resonance(const Integrator& method, const Spectrum& spectrum, double frame_rate, double frequency, int substeps) {
  const double h_omega = frequency * spectrum.omega / (frame_rate * substeps);
  if (&method != &blanes_moan4 || h_omega <= resonance_begin) return std::numeric_limits<int>::max();
  return std::max(1, static_cast<int>(max_growth / (max_growth_per_step * substeps)));
}

}  // namespace hooke
