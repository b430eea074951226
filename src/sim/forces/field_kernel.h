// Loops over whole fields for the widest vector unit of the machine at hand; the same bits on every machine.
#pragma once

#include <cstddef>
#include <span>

namespace hooke {

// y[i] += s x[i]
void add_scaled(double* y, double s, const double* x, std::size_t size);

// y[i] = r y[i] + s x[i]
void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size);

// y[i] *= x[i]
void multiply_each(double* y, const double* x, std::size_t size);

// y[i] = s x[i]
void set_scaled(double* y, double s, const double* x, std::size_t size);

// y = start + sum of scale x over the terms, added in their order, and then to `start`, so that small terms are rounded as such. Zero
// instead of `start` if it is null.
struct ScaledField {
  double scale = 0.0;
  const double* x = nullptr;
};
void set_sum(double* y, const double* start, std::span<const ScaledField> terms, std::size_t size);

// Adds the squares of the elements of such a sum to eight partial sums in turn, the first element to the first one.
inline constexpr std::size_t partial_sums = 8;
void add_squares_of_sum(std::span<double, partial_sums> squares, std::span<const ScaledField> terms, std::size_t size);

}  // namespace hooke
