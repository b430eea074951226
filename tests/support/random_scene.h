// Random networks for tests of identities that hold in any scene; the same numbers on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>

#include "support/test_sim.h"

namespace hooke {

// SplitMix64 (Steele, Lea, Flood 2014): uniform random numbers that do not depend on the standard library.
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
  // An element of a non-empty list.
  template <class List>
  decltype(auto) one_of(const List& list) {
    return std::begin(list)[static_cast<std::ptrdiff_t>(next_bits() % std::size(list))];
  }

 private:
  std::uint64_t state_;
};

// Points in a cube of 2 m, a quarter of them nailed on average, and springs between arbitrary points (some twice), some without rest
// length, stretched and compressed.
inline TestSim random_sim(std::uint64_t seed, Index points, Index springs, int dimensions = 3, double max_damping = 0.0) {
  Random random(seed);
  TestSim sim;
  sim.system.dimensions = dimensions;
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, dimensions == 3 ? z : 0.0);
  };
  for (Index i = 0; i < points; ++i) {
    const Vec3 position = vector(1.0), velocity = vector(2.0);
    const double mass = random.uniform(0.1, 2.0);
    if (random.one_in(4))
      sim.nail(position);
    else
      sim.add(position, mass, velocity);
  }
  for (Index s = 0; s < springs; ++s) {
    const Index first = random.below(points), other = random.below(points - 1);
    const Index second = other < first ? other : other + 1;
    const double stiffness = random.uniform(1.0, 200.0), rest_length = random.one_in(8) ? 0.0 : random.uniform(0.1, 2.0);
    sim.join(sim.system.points()[first].id, sim.system.points()[second].id, stiffness, rest_length, random.uniform(0.0, max_damping));
  }
  return sim;
}

// A connected net of 3 to 22 points of 0.1 to 10 kg with springs of 100 to 1e5 N/m, stretched or compressed by up to 30 %, rotating at up
// to 5 rad/s about each axis; an eighth of the points nailed on average.
inline TestSim rotating_net(std::uint64_t seed) {
  Random random(seed * 7919 + 3);
  TestSim sim;
  const Index points = 3 + random.below(20);
  const bool is_flat = random.one_in(4);
  sim.system.dimensions = is_flat ? 2 : 3;
  if (random.one_in(2)) sim.system.gravity = Vec3(0.0);
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, z);
  };
  Vec3 spin = vector(5.0);
  if (is_flat) spin.x = spin.y = 0.0;
  for (Index i = 0; i < points; ++i) {
    Vec3 x = vector(1.0);
    if (is_flat) x.z = 0.0;
    const Vec3 v(spin.y * x.z - spin.z * x.y, spin.z * x.x - spin.x * x.z, spin.x * x.y - spin.y * x.x);
    sim.add(x, std::pow(10.0, random.uniform(-1.0, 1.0)), v);
    sim.system.point(i).nailed = random.one_in(8);
  }
  const auto join = [&](Index i, Index j) {
    const Vec3 d = sim.state.position[i] - sim.state.position[j];
    const double length = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), stiffness = std::pow(10.0, random.uniform(2.0, 5.0));
    sim.join(sim.system.points()[i].id, sim.system.points()[j].id, stiffness, length * random.uniform(0.7, 1.3));
  };
  for (Index i = 1; i < points; ++i) join(i, random.below(i));
  for (Index s = 0; s < 2 * points; ++s) {
    const Index i = random.below(points), j = random.below(points);
    if (i != j) join(i, j);
  }
  return sim;
}

// 3 to 8 points of 0.1 to 10 kg in a cube of 2 m, at up to 3 m/s along each axis, and springs of about equal stiffness with rest lengths
// that have nothing to do with their lengths: most nets compress some to zero length.
inline TestSim collapsing_net(std::uint64_t seed) {
  Random random(seed * 7919 + 17);
  TestSim sim;
  sim.system.gravity = Vec3(0.0);
  constexpr Index sizes[] = {3, 4, 5, 6, 8};
  const Index points = sizes[random.below(5)];
  const double stiffness = std::pow(10.0, random.uniform(2.0, 5.0));
  const auto vector = [&](double size) {
    const double x = random.uniform(-size, size), y = random.uniform(-size, size), z = random.uniform(-size, size);
    return Vec3(x, y, z);
  };
  for (Index i = 0; i < points; ++i) {
    const Vec3 position = vector(1.0), velocity = vector(3.0);
    sim.add(position, std::pow(10.0, random.uniform(-1.0, 1.0)), velocity);
  }
  for (Index i = 0; i < points; ++i)
    for (Index j = 0; j < i; ++j) {
      const bool is_joined = j == i - 1 || random.uniform(0.0, 1.0) < 0.6;
      const double k = stiffness * random.uniform(0.3, 3.0), rest_length = random.uniform(0.3, 1.5);
      if (is_joined) sim.join(sim.system.points()[j].id, sim.system.points()[i].id, k, rest_length);
    }
  return sim;
}

}  // namespace hooke
