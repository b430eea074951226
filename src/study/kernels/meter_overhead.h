// What measuring the accuracy of a run costs: `bench --overhead`.
#pragma once

#include <span>
#include <string_view>

#include "scene/scene.h"

namespace hooke {

// Shipped scenes of 2 to 1024 points, with and without contact.
std::span<const std::string_view> overhead_scenes();

struct MeterOverhead {
  int substeps = 1;            // with which it was measured; 1 for methods that choose their own steps
  double frame_seconds = 0.0;  // [s], CPU time of a frame without measuring
  double overhead = 0.0;       // [1], additional CPU time with AccuracyMode::Frame, relative to that
  bool has_diverged = false;
};

// From pairs of runs of 80 frames, the same with and without measuring: the minimum times over at least `min_rounds` pairs, and more for
// about `seconds` [s]. The method takes twice the fewest stable substeps, at least 2 if it is implicit, and otherwise at least those of the
// scene.
MeterOverhead measure_meter_overhead(Scene scene, const Integrator& method, int min_rounds, double seconds);

}  // namespace hooke
