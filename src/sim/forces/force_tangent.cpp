#include "sim/forces/force_tangent.h"

namespace hooke {

void ForceTangent::add_volume(const Plan& plan, std::size_t enclosure, double stiffness, const double* x) {
  Volume& volume = volumes_[enclosure];
  if (volume.stiffness == 0.0 && stiffness > 0.0)
    add_volume_gradient(plan, plan.force_data.enclosures.enclosures[enclosure], 1.0, x, volume.gradient.data());
  volume.stiffness += stiffness;
}

// Of the face a, b, c, df_a/dx_b r = -p/6 c x r; of the edge from a to b of a flat scene, -p/2 z x r.
void ForceTangent::add_volume_curvature(const Plan& plan, const Enclosure& enclosure, double pressure, const double* x) {
  const std::size_t n = plan.points;
  const Index origin = plan.force_data.enclosures.sides[enclosure.begin].points[0];
  for (Index s = enclosure.begin; s < enclosure.end; ++s) {
    const EnclosureSide& side = plan.force_data.enclosures.sides[s];
    if (plan.dimensions == 2) {
      volume_curvature_[side.edge[0]].z += (side.points[0] < side.points[1] ? 0.5 : -0.5) * pressure;
      continue;
    }
    for (int c = 0; c < 3; ++c) {
      const Index a = side.points[(c + 1) % 3], b = side.points[(c + 2) % 3], opposite = side.points[c];
      const double scale = (a < b ? 1.0 : -1.0) * side.weight * pressure / 6.0;
      for (int k = 0; k < 3; ++k) volume_curvature_[side.edge[c]][k] += scale * (x[k * n + opposite] - x[k * n + origin]);
    }
  }
}

}  // namespace hooke
