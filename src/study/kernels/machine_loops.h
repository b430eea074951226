// Loops that do nothing but what limits a machine, for each vector unit.
#pragma once

#include <cstddef>

namespace hooke {

// Values of type T in a vector, of double or float, as in the other loops.
template <class T>
std::size_t vector_lanes();
template <>
std::size_t vector_lanes<double>();
template <>
std::size_t vector_lanes<float>();
// `rounds` times `fma_chains` independent fused multiply-adds of vectors; returns a value so that they are not left out.
inline constexpr int fma_chains = 12;
template <class T>
T run_fma(std::size_t rounds);
template <>
double run_fma<double>(std::size_t rounds);
template <>
float run_fma<float>(std::size_t rounds);
// The number of values must be a multiple of the lanes; arrays do not overlap.
void run_sqrt(const double* x, double* y, std::size_t count);
void run_sqrt(const float* x, float* y, std::size_t count);
void run_division(const double* x, double* y, std::size_t count);
void run_division(const float* x, float* y, std::size_t count);
void run_triad(double* a, const double* b, const double* c, std::size_t count);

}  // namespace hooke
