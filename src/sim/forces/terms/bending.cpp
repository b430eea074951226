// The bending of sheets by the hinges between their faces (hinges.h). If the rest shape is flat, then across a hinge of angle t between
// two faces,
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
//
// With the rest shape as built, of angles t0, c_i is replaced by the number l_i (t_i - t0_i), l the lengths at rest. The energy is zero in
// the rest shape, and its derivatives depend on the positions. The dashpots then act on l_i dt_i/dt.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/forces/force_tangent.h"
#include "sim/forces/terms/rows.h"
#include "sim/plan/plan.h"

namespace hooke {
namespace {

constexpr ForceChoice rest_shapes[] = {{"flat", "Flat"}, {"as_built", "As built"}};
constexpr ForceParameter numbers[] = {
    {"stiffness", "Stiffness B", "N m", 1e-8, 10.0, 1e-4},
    {"damping_time", "Damping time", "s", 0.0, 0.1, 0.0, false, {}, 1e6},
    {"rest", "Rest shape", "", 0.0, 1.0, 0.0, true, rest_shapes},
};

double stiffness_of(const ForceValues& values) { return values[0]; }
double damping_of(const ForceValues& values) { return values[0] * values[1]; }  // [N m s]
bool is_as_built(const ForceValues& values) { return values[2] != 0.0; }

// f_i = -B sum K_ij (x_j - x_i), as the rows of K have the sum 0.
void add_elastic(const Plan& plan, double stiffness, const double* x, double* f) {
  const HingePlan& hinges = plan.force_data.hinges;
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
  for (int a = 0; a < 3; ++a) corner[a] = vector_at(plan, field, face.points[a]);
  for (int i = 0; i < 3; ++i)
    c[i] = face.weights[i][0] * corner[0] + face.weights[i][1] * corner[1] + face.weights[i][2] * corner[2] +
           face.weights[i][3] * vector_at(plan, field, face.points[3 + i]);
  return c;
}

// A hinge angle as a function of its four points: those of the edge j and k, and the apexes i and q of the two triangles, one of which
// contributes -|e| m to the gradient at its apex a, (k - a).e m / |e| at j and (a - j).e m / |e| at k, with e = k - j, N = (j - a) x (k -
// a) and m = N / N^2 (R. Bridson, S. Marino, R. Fedkiw 2003; here from the areas of the triangles).
class AngleTriangle {
 public:
  // False: degenerate, without derivatives.
  bool set(const Vec3& a, const Vec3& j, const Vec3& k, double orientation) {
    corner_ = {a, j, k};
    const Vec3 normal = orientation * glm::cross(j - a, k - a), edge = k - j;
    square_ = glm::dot(normal, normal);
    length_ = glm::length(edge);
    if (!(square_ > 0.0) || !(length_ > 0.0)) return false;
    m_ = normal / square_;
    unit_ = edge / length_;
    orientation_ = orientation;
    factor_ = {-length_, glm::dot(k - a, unit_), glm::dot(a - j, unit_)};
    return true;
  }
  // Of a, j and k.
  Vec3 gradient(int corner) const { return factor_[corner] * m_; }
  // d(gradient of `row`) / d(`column`)
  glm::dmat3 curvature(int row, int column) const {
    // dm = (I - 2 m m^T N^2) / N^2 (side x d), since dN = side x d for the side opposite the corner that moves
    const Vec3 side = orientation_ * (corner_[(column + 2) % 3] - corner_[(column + 1) % 3]);
    glm::dmat3 turn;
    for (int c = 0; c < 3; ++c) {
      Vec3 direction(0.0);
      direction[c] = 1.0;
      const Vec3 change = glm::cross(side, direction);
      turn[c] = (change - 2.0 * glm::dot(m_, change) * square_ * m_) / square_;
    }
    return glm::outerProduct(m_, factor_gradient(row, column)) + factor_[row] * turn;
  }

 private:
  // d(factor of `row`) / d(`column`)
  Vec3 factor_gradient(int row, int column) const {
    const Vec3 from_j = corner_[0] - corner_[1], across = (from_j - glm::dot(from_j, unit_) * unit_) / length_;
    const std::array<Vec3, 3> of_k{unit_, -unit_ - across, across};  // of (a - j).e / |e|
    const std::array<Vec3, 3> of_length{Vec3(0.0), -unit_, unit_};
    return row == 0 ? -of_length[column] : row == 2 ? of_k[column] : of_length[column] - of_k[column];
  }

  std::array<Vec3, 3> corner_{};
  std::array<double, 3> factor_{};
  Vec3 m_{0.0}, unit_{0.0};
  double square_ = 0.0, length_ = 0.0, orientation_ = 1.0;
};

// The hinges of a face at the present positions.
class HingeGradients {
 public:
  // dr_i / dv of the points of the face; with the rest shape as built d(l_i t_i) / dx.
  const Vec3& gradient(int hinge, int local) const { return gradient_[hinge][local]; }
  // sum_j M_ij r_j
  std::array<double, 3> moments(const Plan& plan, const HingedFace& face, const double* v) const {
    std::array<double, 3> rate{};
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 6; ++a) rate[i] += glm::dot(gradient_[i][a], vector_at(plan, v, face.points[a]));
    return coupled(face, rate);
  }

 protected:
  static std::array<double, 3> coupled(const HingedFace& face, const std::array<double, 3>& value) {
    std::array<double, 3> sum{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum[i] += face.coupling[i][j] * value[j];
    return sum;
  }
  std::array<std::array<Vec3, 6>, 3> gradient_{};
};

class HingeRates : public HingeGradients {
 public:
  HingeRates(const Plan& plan, const HingedFace& face, const double* x) {
    std::array<Vec3, 6> p;
    for (int a = 0; a < 6; ++a) p[a] = vector_at(plan, x, face.points[a]);
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
};

// With the rest shape as built.
class HingeAngles : public HingeGradients {
 public:
  HingeAngles(const Plan& plan, const HingedFace& face, const double* x) {
    std::array<Vec3, 6> p;
    for (int a = 0; a < 6; ++a) p[a] = vector_at(plan, x, face.points[a]);
    for (int i = 0; i < 3; ++i) {
      has_angle_[i] = face.points[3 + i] != face.points[i];
      for (int t = 0; t < 2 && has_angle_[i]; ++t) {
        const auto [a, j, k] = corners_of(i, t);
        has_angle_[i] = triangle_[i][t].set(p[a], p[j], p[k], t == 0 ? 1.0 : -1.0);
      }
      if (!has_angle_[i]) continue;
      for (int t = 0; t < 2; ++t)
        for (int c = 0; c < 3; ++c) gradient_[i][corners_of(i, t)[c]] += face.length[i] * triangle_[i][t].gradient(c);
      const auto [own, j, k] = corners_of(i, 0);
      deviation_[i] = face.length[i] * (hinge_angle(p[own], p[j], p[k], p[3 + i]) - face.rest_angle[i]);
    }
  }

  // l_i (t_i - t0_i) [m]
  const std::array<double, 3>& deviation() const { return deviation_; }
  // sum_j M_ij l_j (t_j - t0_j)
  std::array<double, 3> elastic_moments(const HingedFace& face) const { return coupled(face, deviation_); }
  // sum_i moment_i d2(l_i t_i) / dx_a dx_b
  glm::dmat3 curvature(const HingedFace& face, const std::array<double, 3>& moment, int a, int b) const {
    glm::dmat3 sum(0.0);
    for (int i = 0; i < 3; ++i)
      for (int t = 0; t < 2 && has_angle_[i]; ++t) {
        const std::array<int, 3> corners = corners_of(i, t);
        const auto row = std::ranges::find(corners, a), column = std::ranges::find(corners, b);
        if (row != corners.end() && column != corners.end())
          sum += moment[i] * face.length[i] *
                 triangle_[i][t].curvature(static_cast<int>(row - corners.begin()), static_cast<int>(column - corners.begin()));
      }
    return sum;
  }

 private:
  // Of the triangles at a hinge, the own one first: the apex, and the points of the edge.
  static std::array<int, 3> corners_of(int hinge, int triangle) {
    return {triangle == 0 ? hinge : 3 + hinge, (hinge + 1) % 3, (hinge + 2) % 3};
  }

  std::array<double, 3> deviation_{};
  std::array<bool, 3> has_angle_{};                         // false: no hinge, or degenerate
  std::array<std::array<AngleTriangle, 2>, 3> triangle_{};  // of the hinges: the own one, and the other
};

// The force of the hinges of a face under `scale` times their moments.
void add_moments(const Plan& plan, const HingedFace& face, const HingeGradients& hinges, const std::array<double, 3>& moment, double scale,
                 double* f) {
  for (int a = 0; a < 6; ++a)
    for (int i = 0; i < 3; ++i) add_vector(plan, f, face.points[a], -scale * moment[i] * hinges.gradient(i, a));
}

void add_damping(const Plan& plan, double damping, const double* x, const double* v, double* f) {
  for (const HingedFace& face : plan.force_data.hinges.faces) {
    const HingeRates rates(plan, face, x);
    add_moments(plan, face, rates, rates.moments(plan, face, v), damping, f);
  }
}

void add_as_built(const Plan& plan, const ForceValues& values, const double* x, const double* v, double* f) {
  for (const HingedFace& face : plan.force_data.hinges.faces) {
    const HingeAngles angles(plan, face, x);
    add_moments(plan, face, angles, angles.elastic_moments(face), stiffness_of(values), f);
    if (damping_of(values) > 0.0) add_moments(plan, face, angles, angles.moments(plan, face, v), damping_of(values), f);
  }
}

void add(const Plan& plan, const ForceValues& values, double, const double* x, const double* v, double* f) {
  if (plan.force_data.hinges.empty()) return;
  if (is_as_built(values)) return add_as_built(plan, values, x, v, f);
  add_elastic(plan, stiffness_of(values), x, f);
  if (damping_of(values) > 0.0) add_damping(plan, damping_of(values), x, v, f);
}

// The sum over b of |w_a M w_b| over all faces: at least the row of the stiffness in any shape whose faces have the sizes and, if they are
// not obtuse, the angles at rest, without the part that is due to the moments.
double row_of_any_shape(const HingedFace& face, int a, const std::vector<Point>& points) {
  double row = 0.0;
  for (int b = 0; b < 6; ++b) {
    if (points[face.points[b]].nailed) continue;
    double entry = 0.0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) entry += std::abs(face.weight(i, a) * face.coupling[i][j] * face.weight(j, b));
    row += entry / std::sqrt(points[face.points[a]].mass * points[face.points[b]].mass);
  }
  return row;
}

// Gershgorin's theorem for M^-1/2 K M^-1/2 of the free points [1/(kg m^2)], of which K is constant if the rest shape is flat.
double highest_row(const System& system, const HingePlan& hinges, bool is_constant) {
  const std::vector<Point>& points = system.points();
  std::vector<double> row(points.size(), 0.0);
  if (is_constant) {
    for (std::size_t i = 0; i < points.size(); ++i)
      for (Index k = hinges.begin[i]; k < hinges.begin[i + 1]; ++k)
        if (const Point& other = points[hinges.column[k]]; !other.nailed)
          row[i] += std::abs(hinges.value[k]) / std::sqrt(points[i].mass * other.mass);
  } else {
    for (const HingedFace& face : hinges.faces)
      for (int a = 0; a < 6; ++a) row[face.points[a]] += row_of_any_shape(face, a, points);
  }
  double max = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].nailed) max = std::max(max, row[i]);
  return max;
}

// The dashpots have the same matrix where the sheet is flat; elsewhere, and with the rest shape as built also the stiffness, it depends on
// the shape of the faces, which may be degenerate.
ForceBound bound(const System& system, const Plan& prepared, const ForceValues& values, double) {
  if (prepared.force_data.hinges.empty()) return {};
  const double max = highest_row(system, prepared.force_data.hinges, !is_as_built(values));
  ForceBound bound{.estimated_rate = damping_of(values) * max};
  if (bound.estimated_rate > 0.0) bound.rate = ForceBound::none;
  (is_as_built(values) ? bound.estimated_stiffness : bound.stiffness) = stiffness_of(values) * max;
  if (is_as_built(values)) bound.stiffness = ForceBound::none;
  return bound;
}

// Calls use(a, b, entry, block) with sum M_ij g_ia g_jb^T, g the gradients, for the entries on and above the diagonal.
template <class Use>
void for_each_block(const Plan& plan, const HingedFace& face, const HingeGradients& hinges, const Use& use) {
  for (int a = 0; a < 6; ++a)
    for (int b = 0; b < 6; ++b) {
      if (face.points[a] > face.points[b]) continue;
      glm::dmat3 block(0.0);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) block += face.coupling[i][j] * glm::outerProduct(hinges.gradient(i, a), hinges.gradient(j, b));
      use(a, b, plan.force_data.hinges.entry(face.points[a], face.points[b]), block);
    }
}

void add_tangent(const Plan& plan, const ForceValues& values, double, const double* x, const double*, ForceTangent& tangent) {
  const double stiffness = stiffness_of(values), damping = damping_of(values);
  if (is_as_built(values)) {
    for (const HingedFace& face : plan.force_data.hinges.faces) {
      const HingeAngles angles(plan, face, x);
      std::array<double, 3> moment = angles.elastic_moments(face);
      for (double& each : moment) each *= stiffness;
      for_each_block(plan, face, angles, [&](int a, int b, Index entry, const glm::dmat3& block) {
        tangent.hinges.add_stiffness(entry, stiffness * block, angles.curvature(face, moment, a, b));
        if (damping > 0.0) tangent.hinges.add_damping(entry, damping * block);
      });
    }
    return;
  }
  tangent.hinges.stiffness += stiffness;
  if (damping == 0.0) return;
  for (const HingedFace& face : plan.force_data.hinges.faces)
    for_each_block(plan, face, HingeRates(plan, face, x),
                   [&](int, int, Index entry, const glm::dmat3& block) { tangent.hinges.add_damping(entry, damping * block); });
}

double power_of(const Plan& plan, const HingedFace& face, const HingeGradients& hinges, const double* v) {
  const std::array<double, 3> moment = hinges.moments(plan, face, v);
  double sum = 0.0;
  for (int a = 0; a < 6; ++a) {
    if (plan.inverse_mass[face.points[a]] == 0.0) continue;
    for (int i = 0; i < 3; ++i) sum -= moment[i] * glm::dot(hinges.gradient(i, a), vector_at(plan, v, face.points[a]));
  }
  return sum;
}

double potential(const Plan& plan, const ForceValues& values, double, const double* x) {
  double sum = 0.0;
  for (const HingedFace& face : plan.force_data.hinges.faces) {
    if (is_as_built(values)) {
      const HingeAngles angles(plan, face, x);
      const std::array<double, 3> moment = angles.elastic_moments(face);
      for (int i = 0; i < 3; ++i) sum += moment[i] * angles.deviation()[i];
      continue;
    }
    const HingeVectors c = hinge_vectors(plan, face, x);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += face.coupling[i][j] * glm::dot(c[i], c[j]);
  }
  return 0.5 * stiffness_of(values) * sum;
}

double power(const Plan& plan, const ForceValues& values, double, const double* x, const double* v) {
  if (damping_of(values) == 0.0) return 0.0;
  double sum = 0.0;
  for (const HingedFace& face : plan.force_data.hinges.faces)
    sum += is_as_built(values) ? power_of(plan, face, HingeAngles(plan, face, x), v) : power_of(plan, face, HingeRates(plan, face, x), v);
  return damping_of(values) * sum;
}

// The gradients of the hinges, from which the moments of dashpots and of built angles follow, take most of the time.
ForceCost cost(const Plan&, const ForceValues& values) {
  const bool is_damped = damping_of(values) > 0.0;
  if (is_as_built(values)) return {.evaluation = 130.0, .energy = is_damped ? 690.0 : 230.0, .of_faces = true};
  return {.evaluation = is_damped ? 77.0 : 7.0, .energy = is_damped ? 500.0 : 16.0, .of_faces = true};
}

}  // namespace

constinit const ForceTerm bending_force{
    .id = "bending",
    .rank = 1,
    .label = "Bending of faces",
    .description = "Resists bending between adjacent faces, which are flat at rest, or as built.",
    .numbers = numbers,
    .depends_on_velocity = true,
    .add = add,
    .bound = bound,
    .add_tangent = add_tangent,
    .potential = potential,
    .power = power,
    .is_damped = [](const ForceValues& values) { return damping_of(values) > 0.0; },
    .cost = cost,
    .prepare = [](const System& system, Plan& plan) { plan.force_data.hinges = plan_hinges(system); },
};

}  // namespace hooke
