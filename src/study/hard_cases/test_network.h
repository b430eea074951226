// Builds a scene in code, point by point.
#pragma once

#include <cstdint>

#include "scene/scene.h"

namespace hooke {

struct TestNetwork {
  System system;
  State state;

  PointId add(const Vec3& position, double mass = 1.0, const Vec3& velocity = Vec3(0.0));
  PointId nail(const Vec3& position);
  SpringId join(PointId first, PointId second, double stiffness, double rest_length, double damping = 0.0);
  // With its current length as rest length.
  SpringId join(PointId first, PointId second, double stiffness);

  Index index(PointId id) const { return system.index_of(id); }
};

// rows x columns points with springs right and down, and along both diagonals if diagonal_stiffness > 0, all at rest length: point (row,
// column) is at corner + column across + row down and has the index row * columns + column. `mass` [kg] of each point.
struct SheetShape {
  int rows, columns;
  Vec3 corner{0.0}, across{1.0, 0.0, 0.0}, down{0.0, -1.0, 0.0};  // across, down: spacing of the points [m]
  double mass = 1.0, stiffness = 100.0, diagonal_stiffness = 0.0;
};
TestNetwork make_sheet(const SheetShape& shape);

// Pseudo-random numbers, the same on every machine (SplitMix64: Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next_bits();
  double uniform(double min, double max);
  // Uniform in the cube of half the width `size`.
  Vec3 vector(double size);

 private:
  std::uint64_t state_;
};

}  // namespace hooke
