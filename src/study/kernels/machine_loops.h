// Loops that do nothing but what limits a machine, for each vector unit.
#pragma once

#include <cstddef>

namespace hooke {

// Doubles in a vector.
std::size_t vector_lanes();
// `rounds` times `fma_chains` independent fused multiply-adds of vectors; returns a value so that they are not left out.
inline constexpr int fma_chains = 12;
double run_fma(std::size_t rounds);
// The number of values must be a multiple of the lanes; arrays do not overlap.
void run_sqrt(const double* x, double* y, std::size_t count);
void run_division(const double* x, double* y, std::size_t count);
void run_triad(double* a, const double* b, const double* c, std::size_t count);

}  // namespace hooke
