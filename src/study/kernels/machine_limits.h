// What this machine can do at most, measured: the limits to which kernels are compared.
#pragma once

#include <string>
#include <vector>

namespace hooke {

// a[i] = b[i] + s c[i] over arrays that fit into one level of memory.
struct TriadLimit {
  std::string level;                           // "L2"
  double bytes = 0.0;                          // of the three arrays together
  double one_thread = 0.0, two_threads = 0.0;  // [bytes/s], three accesses per element
  bool is_of_each_core = false;                // not shared by the two threads
};

// Of one core, in numbers of one size.
struct ArithmeticLimits {
  int lanes = 1;           // values in a vector
  double fma_rate = 0.0;   // [1/s], of fused multiply-adds of one value
  double sqrt_time = 0.0;  // [s], of one value among many in vectors
  double division_time = 0.0;
};

struct MachineLimits {
  ArithmeticLimits double_precision, single_precision;
  std::vector<TriadLimit> triads;  // from the smallest to the largest
};

// Takes some seconds, a quick one less. Each figure is the best of several, since other programs can only make it worse.
MachineLimits measure_machine_limits(bool quick);

// A net that is stepped, and by what.
struct StepSize {
  double points = 0.0, springs = 0.0;
  int threads = 1;
  bool is_single = false;  // in single precision
};

// The shortest time [s] of a step for each spring of a scene, the longest of: 22 additions and multiplications, each in the time of a fused
// multiply-add, divided among the threads; one square root and one division, which another unit computes at the same time, divided
// likewise; reading and writing positions and velocities and reading masses once, at the bandwidth of the level of memory into which they
// fit, with several threads that of two.
double shortest_time_per_spring(const MachineLimits& limits, const StepSize& step);

}  // namespace hooke
