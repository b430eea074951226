// Steps in single precision: half the memory and twice as many numbers in a vector.
#pragma once

#include <array>
#include <vector>

#include "sim/forces/grid_rows.h"
#include "sim/forces/motion.h"

namespace hooke {

template <class T>
struct LeapfrogPass;

// Positions relative to the middle of the scene and velocities, each rounded to 24 bits: of 1 m, 6e-8 m. The state between calls has double
// precision.
class SinglePrecision {
 public:
  // `steps` passes over all points, on which nothing acts but gravity, air and springs of grids without dashpots.
  void advance(const Plan& plan, const LeapfrogPass<double>& pass, int steps, Motion& motion);

 private:
  struct Values {
    std::array<std::vector<float>, Grid::directions> number;
    GridView<float>::CellNumbersOfEach set(const std::array<Grid::Values, Grid::directions>& values, const Grid& grid, Index pitch);
  };
  struct Numbers {
    Values stiffness, rest_length;
  };

  GridView<float> view_of(const Grid& grid, Numbers& numbers) const;
  void load(const Plan& plan, const Motion& motion);
  void store(const Plan& plan, Motion& motion) const;

  Index pitch_ = 0;  // points rounded up to whole vectors: the distance of the components of a field
  Vec3 origin_{0.0};
  std::vector<float> x_, v_, inverse_mass_;
  std::vector<Numbers> numbers_;  // of each grid
  std::vector<GridView<float>> views_;
};

}  // namespace hooke
