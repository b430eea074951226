// Gas in closed surfaces (enclosures.h). With r = V / V0, V the volume and V0 the full one, and the excess pressure P = p0 e^(-leak t),
//   p = (P + a) r^-n - a,   f = p dV/dx,   potential U = -(P + a) V0 g(r) + a V0 (r - 1),   g = integral from 1 to r of s^-n ds.
// a is the ambient pressure, and n the polytropic exponent: 0 for a constant pressure, 1 for an isothermal gas, 1.4 for adiabatic air. A
// leak lets out gas until the surface is full at the ambient pressure. Below r = min_volume_ratio, the pressure does not increase further,
// so that a surface of no volume feels a finite force. V is the magnitude of the volume: a surface that has been turned inside out is
// filled likewise, and the orientation of the faces in the file does not matter.
//
// As the gradient of a function of the shape alone, the forces have no sum and no torque. Their derivative is
//   df/dx = p d2V/dx2 + p' dV/dx dV/dx^T:
// the first part couples the points of each edge, is not definite, and is taken by implicit methods where their matrix stays positive
// definite; the second one is definite, of rank 1, and always taken.
#include <cmath>

#include "sim/forces/constants.h"
#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/rows.h"
#include "sim/model/portable_math.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"pressure", "Pressure", "Pa", 0.0, 1e5, 1000.0},     {"exponent", "Exponent of p V^n", "", 0.0, 2.0, 1.0},
    {"ambient", "Ambient pressure", "Pa", 0.0, 2e5, 0.0}, {"leak", "Leak rate", "1/s", 0.0, 10.0, 0.0},
    {"leak_start", "Leaks from", "s", 0.0, 1000.0, 0.0},
};

// The gas of all enclosures at a time.
struct Gas {
  double amount;  // [Pa], P + a: of the gas at the full volume
  double ambient, exponent;

  Gas(const ForceValues& values, double time) : amount(values[2]), ambient(values[2]), exponent(values[1]) {
    const double leaked = values[3] * std::max(0.0, time - values[4]);
    amount += leaked > 0.0 ? values[0] * portable::exp(-leaked) : values[0];
  }
  // [Pa], above the ambient pressure
  double pressure(double ratio) const { return amount * power(std::max(ratio, min_volume_ratio)) - ambient; }
  // -dp/dr [Pa]
  double stiffness(double ratio) const { return ratio > min_volume_ratio ? exponent * amount * power(ratio) / ratio : 0.0; }
  // U / V0 [Pa]
  double potential(double ratio) const {
    const double base = std::max(ratio, min_volume_ratio);
    return -amount * (integral(base) + std::min(0.0, ratio - min_volume_ratio) * power(base)) + ambient * (ratio - 1.0);
  }

 private:
  double power(double ratio) const { return exponent == 1.0 ? 1.0 / ratio : portable::exp(-exponent * portable::log(ratio)); }
  // g
  double integral(double ratio) const {
    const double logarithm = portable::log(ratio), rest = 1.0 - exponent;
    return rest == 0.0 ? logarithm : portable::expm1(rest * logarithm) / rest;
  }
};

// The volume relative to the full one, and the factor of its derivative for that of the signed volume.
struct Filling {
  double ratio, sign;
  Filling(const Plan& plan, const Enclosure& enclosure, const double* x) {
    const double volume = signed_volume(plan, enclosure, x);
    ratio = std::abs(volume) / enclosure.full_volume;
    sign = volume < 0.0 ? -1.0 : 1.0;
  }
};

void add(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, double* f) {
  const Gas gas(values, time);
  for (const Enclosure& enclosure : plan.force_data.enclosures.enclosures) {
    const Filling filling(plan, enclosure, x);
    add_volume_gradient(plan, enclosure, filling.sign * gas.pressure(filling.ratio), x, f);
  }
}

double potential(const Plan& plan, const ForceValues& values, double time, const double* x) {
  const Gas gas(values, time);
  double sum = 0.0;
  for (const Enclosure& enclosure : plan.force_data.enclosures.enclosures)
    sum += enclosure.full_volume * gas.potential(Filling(plan, enclosure, x).ratio);
  return sum;
}

void add_tangent(const Plan& plan, const ForceValues& values, double time, const double* x, const double*, ForceTangent& tangent) {
  const Gas gas(values, time);
  for (std::size_t e = 0; e < plan.force_data.enclosures.enclosures.size(); ++e) {
    const Enclosure& enclosure = plan.force_data.enclosures.enclosures[e];
    const Filling filling(plan, enclosure, x);
    const double pressure = filling.sign * gas.pressure(filling.ratio);
    tangent.add_volume(plan, e, gas.stiffness(filling.ratio) / enclosure.full_volume, x);
    tangent.add_volume_curvature(plan, enclosure, pressure, x);
  }
}

// For M^-1/2 (df/dx) M^-1/2 over the free points. Of p d2V/dx2 by Gershgorin's theorem: the block of an edge is the product with the vector
// between the points opposite, over 6, or 1/2 in flat scenes. Of w u u^T with u = M^-1/2 dV/dx, by w |u|^2 summed over the enclosures of a
// point. |dV/dx| of a point is at most a third of its faces, or half of its edges.
struct Rows {
  std::vector<double> curvature;  // [1/(Pa s^2)], factor of p
  std::vector<double> breathing;  // [1/(Pa s^2)], factor of -dp/dr, summed over the enclosures
};
Rows rows_at_rest(const System& system, const EnclosurePlan& plan) {
  const auto n = static_cast<std::size_t>(system.point_count());
  const bool is_flat = system.dimensions == 2;
  Rows rows{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const auto inverse_mass = [&](Index i) { return system.points()[i].nailed ? 0.0 : 1.0 / system.points()[i].mass; };
  const auto add_edge = [&](Index i, Index j, double coupling) {
    const double row = coupling * std::sqrt(inverse_mass(i) * inverse_mass(j));
    rows.curvature[i] += row;
    rows.curvature[j] += row;
  };
  std::vector<double> gradient(n, 0.0);
  for (const Enclosure& enclosure : plan.enclosures) {
    for (Index s = enclosure.begin; s < enclosure.end; ++s) {
      const EnclosureSide& side = plan.sides[s];
      if (is_flat) add_edge(side.points[0], side.points[1], 0.5);
      for (int c = 0; c < (is_flat ? 2 : 3); ++c) {
        if (!is_flat) add_edge(side.points[(c + 1) % 3], side.points[(c + 2) % 3], side.weight * side.median[c] / 6.0);
        gradient[side.points[c]] += side.weight * side.size / (is_flat ? 2.0 : 3.0);
      }
    }
    // each point once
    double square = 0.0;
    std::vector<Index> points;
    for (Index s = enclosure.begin; s < enclosure.end; ++s)
      for (int c = 0; c < (is_flat ? 2 : 3); ++c) points.push_back(plan.sides[s].points[c]);
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const Index i : points) {
      square += gradient[i] * gradient[i] * inverse_mass(i);
      gradient[i] = 0.0;
    }
    for (const Index i : points)
      if (!system.points()[i].nailed) rows.breathing[i] += square / enclosure.full_volume;
  }
  return rows;
}

// The curvature of an area does not depend on the shape: of a flat scene with a constant pressure, there is a bound. Everything else
// depends on the volume; the estimate holds for surfaces that are not stretched and enclose at least two thirds of the full volume. The
// force increases with the size of the surface without limit.
ForceBound bound(const System& system, const Plan& prepared, const ForceValues& values, double) {
  const EnclosurePlan& plan = prepared.force_data.enclosures;
  if (plan.empty()) return {};
  const Gas gas(values, 0.0);
  const bool is_bounded = system.dimensions == 2 && gas.exponent == 0.0;
  const double pressure = gas.pressure(estimated_volume_ratio), stiffness = gas.stiffness(estimated_volume_ratio);
  const Rows rows = rows_at_rest(system, plan);
  double curvature = 0.0, total = 0.0;
  for (std::size_t i = 0; i < rows.curvature.size(); ++i) {
    curvature = std::max(curvature, pressure * rows.curvature[i]);
    total = std::max(total, pressure * rows.curvature[i] + stiffness * rows.breathing[i]);
  }
  ForceBound bound{.acceleration = ForceBound::none, .omitted_stiffness = curvature};
  (is_bounded ? bound.stiffness : bound.estimated_stiffness) = total;
  if (!is_bounded) bound.stiffness = ForceBound::none;
  return bound;
}

}  // namespace

constinit const ForceTerm pressure_force{
    .id = "pressure",
    .rank = 2,
    .label = "Pressure of gas",
    .description = "Fills closed surfaces, in flat scenes closed lines, with gas.",
    .numbers = numbers,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .depends_on_time = [](const ForceValues& values) { return values[3] > 0.0; },
    .cost = [](const Plan&, const ForceValues&) { return ForceCost{.evaluation = 5.0, .energy = 9.0, .of_faces = true}; },
    .prepare = [](const System& system, Plan& plan) { plan.force_data.enclosures = plan_enclosures(system); },
};

}  // namespace hooke
