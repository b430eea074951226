// Loops over whole fields for the widest vector unit of the machine at hand; the same bits on every machine.
#pragma once

#include <cstddef>

namespace hooke {

// y[i] += s x[i]
void add_scaled(double* y, double s, const double* x, std::size_t size);

// y[i] = r y[i] + s x[i]
void scale_and_add_scaled(double* y, double r, double s, const double* x, std::size_t size);

// y[i] *= x[i]
void multiply_each(double* y, const double* x, std::size_t size);

// y[i] = s x[i]
void set_scaled(double* y, double s, const double* x, std::size_t size);

}  // namespace hooke
