// Forces, kick and drift of the points of a grid in single precision, in one pass over its rows, for the widest vector unit of the machine;
// the same bits on every machine.
#pragma once

#include "sim/forces/grid_rows.h"

namespace hooke {

// v' = decay v + weight (acceleration + f / m),  x' = x + drift v',  as GridPass.
struct SinglePass {
  int dimensions = 3;
  float decay = 1.0f, weight = 0.0f, drift = 0.0f;  // [1], [s], [s]
  float acceleration[3] = {};                       // [m/s^2]
  const float* inverse_mass = nullptr;              // [1/kg], per point; 0 if it is fixed
};

// Advances the points of the band in place.
void advance_band(const GridView<float>& grid, const GridBand<float>& band, const SinglePass& pass, float* x, float* v);

}  // namespace hooke
