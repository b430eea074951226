// A benchmark problem: a scene, a duration, and the measure of error.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

enum class Measure {
  Trajectory,   // positions of all points
  Observables,  // center of mass, largest strain, energy: for trajectories that are not reproducible
};

struct Problem {
  std::string id;     // on the command line and in the files
  std::string title;  // one line
  System system;
  State start;
  double seconds = 1.0;
  double size = 1.0;  // [m], to which errors are relative
  Measure measure = Measure::Trajectory;
  double frame_rate = 0.0;  // [1/s], of the frames in which a window shows it; 0: none but the snapshots of a benchmark
};

// The built-in problems, in the order of the report. Some are shipped scenes: `make` throws what load_scene throws.
struct BuiltInProblem {
  std::string_view id;
  bool quick;  // its reference takes at most a second
  Problem (*make)();
};
std::span<const BuiltInProblem> built_in_problems();

// The row with this id, or null.
const BuiltInProblem* find_problem(std::string_view id);

// One second of a scene, relative to its largest extent at the start.
Problem make_problem(const std::string& id, const Scene& scene);

// A hash of everything that determines the motion, to tell whether earlier results are still valid.
std::uint64_t fingerprint(const Problem& problem);

}  // namespace hooke
