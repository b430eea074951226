// The bending of sheets whose rest shape is flat, by the hinges between their faces (hinges.h). Across a hinge of angle t between two
// faces,
//   c = sum w x,   |c| = 2 l sin(t / 2),   w the cotangent weights of its four points, l its length,
// is a vector along the bisector of the normals (M. Bergou, M. Wardetzky, D. Harmon, D. Zorin, E. Grinspun, A Quadratic Bending Model for
// Inextensible Surfaces, SGP 2006). The hinges of a face, of heights h and normals n in its plane, give it the curvature (E. Grinspun,
// Y. Gingold, J. Reisman, D. Zorin, Computing Discrete Shape Operators on General Meshes, Eurographics 2006)
//   S = sum t_i / h_i n_i n_i^T,   and the energy   E = B/2 A |S|^2 = B/2 sum M_ij c_i.c_j,   M_ij = (n_i.n_j)^2 / (4 A).
// B is the moment per curvature and width of a sheet bent to a cylinder, for any size of the faces. In sheets of equal parallelograms, cut
// along parallel diagonals, it does not depend on the direction either; with hinges that were not coupled in a face it would vary by a
// factor of 4. The energy is quadratic in the positions, so that its derivatives are constant: implicit methods and the bound are exact.
//
// The dashpot acts on the rate r_i = b_i.(dc_i/dt - w x c_i) with the coefficient B T, b the bisector of the normals and w the angular
// velocity of the face. A rigid motion has no rate, and w has no effect where faces keep their shape, since c is along b. With the gradient
// of r for the forces, momentum and angular momentum are conserved.
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/rows.h"
#include "sim/plan.h"

namespace hooke {
namespace {

constexpr ForceParameter numbers[] = {
    {"stiffness", "Stiffness B", "N m", 1e-8, 10.0, 1e-4},
    {"damping_time", "Damping time", "s", 0.0, 0.1, 0.0},
};

double stiffness_of(const ForceValues& values) { return values[0]; }
double damping_of(const ForceValues& values) { return values[0] * values[1]; }  // [N m s]

Vec3 at(const Plan& plan, const double* field, Index i) {
  const std::size_t n = plan.points, k = i;
  return {field[k], field[n + k], field[2 * n + k]};
}

// f_i = -B sum K_ij (x_j - x_i), as the rows of K have the sum 0.
void add_elastic(const Plan& plan, double stiffness, const double* x, double* f) {
  const HingePlan& hinges = plan.hinges;
  for (int c = 0; c < 3; ++c) {
    const double* component = x + static_cast<std::size_t>(c) * plan.points;
    double* force = f + static_cast<std::size_t>(c) * plan.points;
    for (Index i = 0; i < plan.points; ++i) {
      double sum = 0.0;
      for (Index k = hinges.begin[i]; k < hinges.begin[i + 1]; ++k) sum += hinges.value[k] * (component[hinges.column[k]] - component[i]);
      force[i] -= stiffness * sum;
    }
  }
}

using HingeVectors = std::array<Vec3, 3>;

// c_i, or its rate from velocities.
HingeVectors hinge_vectors(const Plan& plan, const HingedFace& face, const double* field) {
  HingeVectors c{};
  std::array<Vec3, 3> corner;
  for (int a = 0; a < 3; ++a) corner[a] = at(plan, field, face.points[a]);
  for (int i = 0; i < 3; ++i)
    c[i] = face.weights[i][0] * corner[0] + face.weights[i][1] * corner[1] + face.weights[i][2] * corner[2] +
           face.weights[i][3] * at(plan, field, face.points[3 + i]);
  return c;
}

// dr_i / dv of the points of a face, for the present positions.
class HingeRates {
 public:
  HingeRates(const Plan& plan, const HingedFace& face, const double* x) {
    std::array<Vec3, 6> p;
    for (int a = 0; a < 6; ++a) p[a] = at(plan, x, face.points[a]);
    const Vec3 twice_area = glm::cross(p[1] - p[0], p[2] - p[0]);
    const double size = glm::length(twice_area);
    if (size == 0.0) return;
    const Vec3 normal = twice_area / size;
    // w.s = sum over the corners of turn.v: its part across the normal by the heights of the corners, that along it by the first side
    const auto turn = [&](const Vec3& s, int a) {
      const Vec3 gradient = glm::cross(normal, p[(a + 2) % 3] - p[(a + 1) % 3]) / size;
      Vec3 result = -glm::dot(glm::cross(normal, gradient), s) * normal;
      const Vec3 side = p[1] - p[0];
      if (a < 2) result += (a == 0 ? -1.0 : 1.0) * glm::dot(normal, s) / glm::dot(side, side) * glm::cross(normal, side);
      return result;
    };
    const HingeVectors c = hinge_vectors(plan, face, x);
    for (int i = 0; i < 3; ++i) {
      const Vec3 &j = p[(i + 1) % 3], &k = p[(i + 2) % 3];
      const Vec3 other = glm::cross(j - k, p[3 + i] - k);
      const double other_size = glm::length(other);
      const Vec3 sum = normal + (other_size > 0.0 ? other / other_size : Vec3(0.0));
      const double length = glm::length(sum);
      if (face.points[3 + i] == face.points[i] || !(other_size > 0.0) || !(length > 1e-9)) continue;  // no hinge, or folded flat
      const Vec3 bisector = sum / length, across = glm::cross(c[i], bisector);
      for (int a = 0; a < 6; ++a) gradient_[i][a] = face.weight(i, a) * bisector;
      // b.(w x c) = w.(c x b)
      for (int a = 0; a < 3; ++a) gradient_[i][a] -= turn(across, a);
    }
  }

  const Vec3& gradient(int hinge, int local) const { return gradient_[hinge][local]; }
  // sum_j M_ij r_j
  std::array<double, 3> moments(const Plan& plan, const HingedFace& face, const double* v) const {
    std::array<double, 3> rate{}, moment{};
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 6; ++a) rate[i] += glm::dot(gradient_[i][a], at(plan, v, face.points[a]));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) moment[i] += face.coupling[i][j] * rate[j];
    return moment;
  }

 private:
  std::array<std::array<Vec3, 6>, 3> gradient_{};
};

void add_damping(const Plan& plan, double damping, const double* x, const double* v, double* f) {
  const std::size_t n = plan.points;
  for (const HingedFace& face : plan.hinges.faces) {
    const HingeRates rates(plan, face, x);
    const std::array<double, 3> moment = rates.moments(plan, face, v);
    for (int a = 0; a < 6; ++a) {
      Vec3 force(0.0);
      for (int i = 0; i < 3; ++i) force += moment[i] * rates.gradient(i, a);
      for (int c = 0; c < 3; ++c) f[static_cast<std::size_t>(c) * n + static_cast<std::size_t>(face.points[a])] -= damping * force[c];
    }
  }
}

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double* v, double* f) {
  if (plan.hinges.empty()) return;
  add_elastic(plan, stiffness_of(values), x, f);
  if (damping_of(values) > 0.0) add_damping(plan, damping_of(values), x, v, f);
}

// Gershgorin's theorem for M^-1/2 K M^-1/2 of the free points. The dashpots have the same matrix where the sheet is flat; elsewhere it
// depends on the shape of the faces, which may be degenerate.
ForceBound bound(const System& system, const ForceValues& values, double) {
  const HingePlan hinges = plan_hinges(system);
  double max = 0.0;
  for (Index i = 0; !hinges.empty() && i < system.point_count(); ++i) {
    const Point& point = system.points()[i];
    if (point.nailed) continue;
    double row = 0.0;
    for (Index k = hinges.begin[i]; k < hinges.begin[i + 1]; ++k)
      if (const Point& other = system.points()[hinges.column[k]]; !other.nailed)
        row += std::abs(hinges.value[k]) / std::sqrt(point.mass * other.mass);
    max = std::max(max, row);
  }
  ForceBound bound{.stiffness = stiffness_of(values) * max, .estimated_rate = damping_of(values) * max};
  if (bound.estimated_rate > 0.0) bound.rate = ForceBound::none;
  return bound;
}

void add_tangent(const Plan& plan, const ForceValues& values, double, const double* x, const double*, ForceTangent& tangent) {
  tangent.add_hinges(stiffness_of(values));
  if (damping_of(values) == 0.0) return;
  for (const HingedFace& face : plan.hinges.faces) {
    const HingeRates rates(plan, face, x);
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        if (face.points[a] > face.points[b]) continue;
        glm::dmat3 block(0.0);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) block += face.coupling[i][j] * glm::outerProduct(rates.gradient(i, a), rates.gradient(j, b));
        tangent.add_hinge_damping(plan.hinges.entry(face.points[a], face.points[b]), damping_of(values) * block);
      }
  }
}

double potential(const Plan& plan, const ForceValues& values, double, const double* x) {
  double sum = 0.0;
  for (const HingedFace& face : plan.hinges.faces) {
    const HingeVectors c = hinge_vectors(plan, face, x);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += face.coupling[i][j] * glm::dot(c[i], c[j]);
  }
  return 0.5 * stiffness_of(values) * sum;
}

double power(const Plan& plan, const ForceValues& values, double, const double* x, const double* v) {
  if (damping_of(values) == 0.0) return 0.0;
  double sum = 0.0;
  for (const HingedFace& face : plan.hinges.faces) {
    const HingeRates rates(plan, face, x);
    const std::array<double, 3> moment = rates.moments(plan, face, v);
    for (int a = 0; a < 6; ++a) {
      if (plan.inverse_mass[face.points[a]] == 0.0) continue;
      for (int i = 0; i < 3; ++i) sum -= moment[i] * glm::dot(rates.gradient(i, a), at(plan, v, face.points[a]));
    }
  }
  return damping_of(values) * sum;
}

}  // namespace

constinit const ForceTerm bending_force{
    .id = "bending",
    .label = "Bending of faces",
    .description = "Resists bending between adjacent faces, which are flat at rest.",
    .numbers = numbers,
    .depends_on_velocity = true,
    .is_continuous = true,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .power = power,
    .is_damped = [](const ForceValues& values) { return damping_of(values) > 0.0; },
    .prepare = [](const System& system, Plan& plan) { plan.hinges = plan_hinges(system); },
};

}  // namespace hooke
