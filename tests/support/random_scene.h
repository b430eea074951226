// Random networks for tests of identities that hold in any scene; the same numbers on every machine.
#pragma once

#include <cstdint>

#include "support/trial.h"

namespace hooke {

// SplitMix64 (Steele, Lea, Flood 2014): uniform numbers whose sequence the standard library does not decide.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next_bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double uniform(double min, double max) { return min + (max - min) * static_cast<double>(next_bits() >> 11) * 0x1p-53; }
  Index below(Index count) { return static_cast<Index>(next_bits() % static_cast<std::uint64_t>(count)); }
  bool one_in(Index count) { return below(count) == 0; }

 private:
  std::uint64_t state_;
};

// Points in a cube of 2 m, every fourth nailed on average, and springs between any of them (some twice), some without
// rest length, stretched and compressed.
inline Trial random_trial(std::uint64_t seed, Index points, Index springs, int dimensions = 3, double max_damping = 0.0) {
  Random random(seed);
  Trial trial;
  trial.system.dimensions = dimensions;
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, dimensions == 3 ? z : 0.0);
  };
  for (Index i = 0; i < points; ++i) {
    const Vec3 position = vector(1.0), velocity = vector(2.0);
    const double mass = random.uniform(0.1, 2.0);
    if (random.one_in(4))
      trial.nail(position);
    else
      trial.add(position, mass, velocity);
  }
  for (Index s = 0; s < springs; ++s) {
    const Index first = random.below(points), other = random.below(points - 1);
    const Index second = other < first ? other : other + 1;
    const double stiffness = random.uniform(1.0, 200.0), rest_length = random.one_in(8) ? 0.0 : random.uniform(0.1, 2.0);
    trial.join(trial.system.points()[first].id, trial.system.points()[second].id, stiffness, rest_length, random.uniform(0.0, max_damping));
  }
  return trial;
}

}  // namespace hooke
