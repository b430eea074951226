// The motion of a scene whose forces are linear, in closed form.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

//   M x'' = f - K (x - x0) - D x' - c M (x' - wind)
// with the forces f and the tangents K and D of springs, dashpots and weight at x0, and the drag c. Everything else is ignored.
class LinearMotion {
 public:
  static constexpr Index max_unknowns = 120;

  // About the positions `origin` [m], for displacements of the free points along `axes` (orthogonal unit vectors). None with more unknowns,
  // or if a spring has no length.
  static std::optional<LinearMotion> about(const System& system, const std::vector<Vec3>& origin, const std::vector<Vec3>& axes);

  // Advances the free points by `seconds`, by the exponential of the matrix: exact for any duration. It is computed again for another
  // duration.
  void advance(State& state, double seconds);
  // RMS speed [m/s] of the free points in modes without a restoring force other than a uniform translation. The motion of these, rigid
  // rotations and mechanisms, is not linear.
  double drift_speed(const State& state) const;

 private:
  struct Matrices;
  std::shared_ptr<Matrices> matrices_;
};

}  // namespace hooke
