// What the benchmark measures methods on: a scene, a duration, and what counts as its error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

enum class Measure {
  Trajectory,   // where every point is
  Observables,  // centre of mass, largest strain, energy balance: the trajectory is not predictable
};

struct Problem {
  std::string id;     // on the command line and in the files
  std::string title;  // what it is, in a line
  System system;
  State start;
  double seconds = 1.0;
  double size = 1.0;  // [m], what errors are relative to
  Measure measure = Measure::Trajectory;
};

// The built-in set, in the order of the report. Some are shipped scenes: `make` throws what load_scene throws.
struct BuiltInProblem {
  std::string_view id;
  bool quick;  // has its reference within a second
  Problem (*make)();
};
std::span<const BuiltInProblem> built_in_problems();

// The row with this id, or null.
const BuiltInProblem* find_problem(std::string_view id);

// One second of a scene, relative to its largest extent at the start.
Problem make_problem(const std::string& id, const Scene& scene);

// A hash of all that decides the motion, to tell whether earlier results still hold.
std::uint64_t fingerprint(const Problem& problem);

}  // namespace hooke
