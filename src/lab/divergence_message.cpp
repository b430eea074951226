#include "lab/divergence_message.h"

#include <cstdio>

namespace hooke {
namespace {

std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

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

}  // namespace

std::string describe(const Divergence& divergence, const System& system) {
  const std::string location = describe_location(divergence, system), when = "Stopped at t = " + format("%.4g", divergence.time) + " s: ";
  const auto rounded = [](double value) { return format(value < 1e4 ? "%.0f" : "%.2g", value); };
  switch (divergence.kind) {
    case Divergence::Kind::NotFinite:
      return when + location + " became infinite or NaN.";
    case Divergence::Kind::EnergyGain:
      return when + "the energy grew by " + rounded(divergence.energy / divergence.scale) + " times the energy supplied, first at " +
             location + ".";
    case Divergence::Kind::Implausible:
      return when + location + " is " + rounded(divergence.distance) + " m away, farther than any motion can have taken it.";
    case Divergence::Kind::StepTooShort:
      return when + "the method finds no step short enough, first at " + location + ".";
    case Divergence::Kind::TooManySteps:
      return when + "the method needs more than " + std::to_string(max_own_steps) + " steps in one substep; fastest is " + location + ".";
  }
  return when + location + ".";
}

}  // namespace hooke
