#include "lab/divergence_message.h"

#include <algorithm>
#include <cmath>

#include "base/formatted.h"
#include "base/number_text.h"
#include "sim/methods/implicit/supernodal_factor.h"

namespace hooke {
namespace {

std::string describe_spring(const System& system, SpringId id) {
  const Spring& spring = system.springs()[system.index_of(id)];
  return "spring " + std::to_string(system.index_of(id)) + " (points " + std::to_string(system.index_of(spring.first)) + " and " +
         std::to_string(system.index_of(spring.second)) + ")";
}

std::string describe_location(const Divergence& divergence, const System& system) {
  std::string location;
  if (divergence.point && system.index_of(*divergence.point) != no_index)
    location = "point " + std::to_string(system.index_of(*divergence.point));
  if (divergence.spring && system.index_of(*divergence.spring) != no_index)
    location += (location.empty() ? "" : " on ") + describe_spring(system, *divergence.spring);
  return location.empty() ? "the scene" : location;
}

// "600,000-fold" to two digits, a power of ten for more than a billion.
std::string describe_growth(double factor) {
  if (!std::isfinite(factor)) return "without limit";
  if (factor >= 1e9) return number_text(std::pow(10.0, std::floor(std::log10(factor))), 1) + "-fold";
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(factor)) - 1.0));
  return number_text(unit * std::round(factor / unit)) + "-fold";
}

}  // namespace

std::string describe(const Divergence& divergence, const System& system) {
  const std::string location = describe_location(divergence, system), when = " at t = " + number_text(divergence.time) + " s";
  const std::string blew_up = "The simulation blew up" + when + ": ";
  switch (divergence.kind) {
    case Divergence::Kind::NotFinite:
      return blew_up + location + " became infinite or NaN.";
    case Divergence::Kind::EnergyGain:
      return blew_up + "energy grew " + describe_growth(divergence.energy / divergence.scale) + ", first at " + location + ".";
    case Divergence::Kind::Implausible:
      return blew_up + location + " is " +
             (divergence.distance < 1e4 ? formatted("%.0f m", divergence.distance) : quantity_text(divergence.distance, "m", 2)) +
             " away, farther than any motion can have taken it.";
    case Divergence::Kind::StepTooShort:
      return "The method finds no step short enough" + when + ", first at " + location + ".";
    case Divergence::Kind::TooManySteps:
      return "The method needs more than " + std::to_string(max_adaptive_evaluations / 1'000'000) + " million force evaluations, or " +
             std::to_string(max_adaptive_surface_steps) + " steps with contact of faces or springs, in the frame" + when + "; fastest is " +
             location + ".";
    case Divergence::Kind::TooManyPairs:
      return "More than " + number_text(static_cast<double>(PairSolver::max_pairs)) +
             " pairs of points come within reach of each other in one substep" + when +
             ", or contact takes too much work in a frame; fastest is " + location + ".";
    case Divergence::Kind::MatrixTooLarge:
      return "The network is too large for an implicit method: it would need more than " + std::to_string(max_factor_entries / 1'000'000) +
             " million entries in the factor of its matrix.";
  }
  return location + when + ".";
}

}  // namespace hooke
