// What one core of this machine can do at most, measured: the limits to which kernels are compared.
#pragma once

#include <string>
#include <vector>

namespace hooke {

// a[i] = b[i] + s c[i] over arrays that fit into one level of memory.
struct TriadLimit {
  std::string level;                           // "L2"
  double bytes = 0.0;                          // of the three arrays together
  double one_thread = 0.0, two_threads = 0.0;  // [bytes/s], three accesses per element
};

struct MachineLimits {
  int lanes = 1;           // doubles in a vector
  double fma_rate = 0.0;   // [1/s], of fused multiply-adds of one double
  double sqrt_time = 0.0;  // [s], of one double among many in vectors
  double division_time = 0.0;
  std::vector<TriadLimit> triads;  // from the smallest to the largest
};

// Takes some seconds, a quick one less. Each figure is the best of several, since other programs can only make it worse.
MachineLimits measure_machine_limits(bool quick);

// The shortest time [s] of a step for each spring of a scene, the longest of: 22 additions and multiplications, each in the time of a fused
// multiply-add; one square root and one division, which another unit computes at the same time; reading and writing positions and
// velocities and reading masses once, at the bandwidth of the level of memory into which they fit.
double shortest_time_per_spring(const MachineLimits& limits, double points, double springs);

}  // namespace hooke
