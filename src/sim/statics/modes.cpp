#include "sim/statics/modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/forces/spring_tangents.h"
#include "sim/statics/constants.h"

namespace hooke {
namespace {

using Vector = Eigen::VectorXd;
using Operator = std::function<void(Vector&)>;  // in place

struct RitzPair {
  double value, error;
  Vector vector;
};

// The eigenvalues of a symmetric operator found by Lanczos' method, in descending order, with a bound on the error of each.
class Lanczos {
 public:
  Lanczos(Vector start, const Operator& apply) {
    const int steps = static_cast<int>(std::min<Eigen::Index>(max_lanczos_steps, start.size()));
    Vector alpha(steps), beta(steps);
    double norm = start.norm();
    while (static_cast<int>(basis_.size()) < steps && norm > 0.0) {
      const int j = static_cast<int>(basis_.size());
      basis_.push_back(start / norm);
      start = basis_.back();
      apply(start);
      alpha[j] = basis_.back().dot(start);
      const double size = start.norm();
      // twice is enough (W. Kahan)
      for (int twice = 0; twice < 2; ++twice)
        for (const Vector& q : basis_) start -= q.dot(start) * q;
      norm = beta[j] = start.norm();
      if (!(norm > 1e-12 * size)) norm = beta[j] = 0.0;
    }
    const auto size = static_cast<Eigen::Index>(basis_.size());
    if (size == 0) return;
    last_beta_ = beta[size - 1];
    solver_.computeFromTridiagonal(alpha.head(size), beta.head(size - 1));
  }

  int size() const { return static_cast<int>(basis_.size()); }
  // `place`: 0 for the largest
  RitzPair at(int rank) const {
    const auto column = size() - 1 - rank;
    const Vector coefficients = solver_.eigenvectors().col(column);
    Vector vector = Vector::Zero(basis_[0].size());
    for (int j = 0; j < size(); ++j) vector += coefficients[j] * basis_[j];
    return {solver_.eigenvalues()[column], last_beta_ * std::abs(coefficients[size() - 1]), vector};
  }

 private:
  std::vector<Vector> basis_;
  double last_beta_ = 0.0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

// sqrt(m) of every unknown; 0 for fixed ones.
Vector sqrt_mass(const Plan& plan) {
  Vector sqrt_masses(static_cast<Eigen::Index>(plan.points) * plan.dimensions);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      sqrt_masses[static_cast<Eigen::Index>(c) * plan.points + i] = plan.inverse_mass[i] == 0.0 ? 0.0 : std::sqrt(plan.mass[i]);
  clear_fixed_axes(plan, sqrt_masses.data());
  return sqrt_masses;
}

Vector elementwise_inverse(const Vector& sqrt_masses) {
  return sqrt_masses.unaryExpr([](double each) { return each == 0.0 ? 0.0 : 1.0 / each; });
}

// Not symmetric like the scene, and always the same: the fractional parts of multiples of an irrational number (H. Weyl 1916). 0 for fixed
// unknowns.
Vector start_vector(const Vector& sqrt_masses, double irrational) {
  Vector start = sqrt_masses;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const double turns = irrational * static_cast<double>(i) * static_cast<double>(i + 1);
    if (start[i] != 0.0) start[i] = turns - std::floor(turns) - 0.5;
  }
  return start;
}
constexpr double golden_ratio = 0.6180339887498949, silver_ratio = 0.4142135623730951;

// A mode found from two start vectors: if their damping differs, there are several modes of this frequency.
template <class Find>
std::optional<Mode> confirmed_mode(const Find& find, bool is_damped) {
  std::optional<Mode> mode = find(golden_ratio);
  if (!mode || !is_damped) return mode;
  const std::optional<Mode> other = find(silver_ratio);
  if (!other || std::abs(mode->dashpot_rate - other->dashpot_rate) >
                    same_damping * std::max(mode->dashpot_rate, other->dashpot_rate) + same_damping_of_frequency * mode->omega)
    mode->dashpot_rate = std::numeric_limits<double>::quiet_NaN();
  return mode;
}

// u.K u and u.D u, of a mode with u.M u = 1.
Mode mode_of(const Plan& plan, const std::vector<double>& damping, const Field& x, const Vector& u) {
  double stiffness = 0.0, rate = 0.0;
  for_each_spring_tangent(plan, 0.0, x, nullptr, Curvature::Clamped, [&](Index i, Index j, Index s, const SpringTangent& tangent) {
    const Vec3 part = vector_at(plan, u.data(), i) - vector_at(plan, u.data(), j);
    const double axial = glm::dot(tangent.u, part);
    stiffness += tangent.axial * axial * axial + tangent.transverse * std::max(0.0, glm::dot(part, part) - axial * axial);
    if (!damping.empty()) rate += damping[s] * axial * axial;
  });
  return {std::sqrt(std::max(0.0, stiffness)), rate, {u.data(), u.data() + u.size()}};
}

}  // namespace

std::optional<Mode> fastest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x) {
  const Vector sqrt_masses = sqrt_mass(plan), inverse = elementwise_inverse(sqrt_masses);
  Vector force(sqrt_masses.size());
  const auto apply = [&](Vector& y) {
    y = y.cwiseProduct(inverse);
    force.setZero();
    for_each_spring_tangent(plan, 0.0, x, nullptr, Curvature::Clamped, [&](Index i, Index j, Index, const SpringTangent& tangent) {
      const Vec3 part = vector_at(plan, y.data(), i) - vector_at(plan, y.data(), j);
      const Vec3 f = (tangent.axial - tangent.transverse) * glm::dot(tangent.u, part) * tangent.u + tangent.transverse * part;
      add_vector(plan, force.data(), i, f);
      add_vector(plan, force.data(), j, -f);
    });
    y = force.cwiseProduct(inverse);
  };
  const auto find = [&](double irrational) -> std::optional<Mode> {
    const Lanczos lanczos(start_vector(sqrt_masses, irrational), apply);
    if (lanczos.size() == 0) return std::nullopt;
    const RitzPair found = lanczos.at(0);
    if (!(found.value > 0.0)) return std::nullopt;
    return mode_of(plan, damping, x, found.vector.cwiseProduct(inverse));
  };
  return confirmed_mode(find, !damping.empty());
}

std::optional<Mode> slowest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x, double rigid_mode_ratio,
                                 StiffnessMatrix& matrix) {
  const double b = 0.1 / (rigid_mode_ratio * plan.spectrum.omega);
  const Field zero_velocity(x.size(), 0.0);
  matrix.assemble(plan, b, x, zero_velocity, Curvature::Clamped);
  if (!std::isfinite(b) || !matrix.factorize()) return std::nullopt;

  const Vector sqrt_masses = sqrt_mass(plan), inverse = elementwise_inverse(sqrt_masses);
  Field solved(x.size());
  const auto apply = [&](Vector& y) {
    Vector::Map(solved.data(), y.size()) = y.cwiseProduct(sqrt_masses);
    matrix.solve(solved);
    y = Vector::Map(solved.data(), y.size()).cwiseProduct(sqrt_masses);
  };
  const auto find = [&](double irrational) -> std::optional<Mode> {
    const Lanczos lanczos(start_vector(sqrt_masses, irrational), apply);
    for (int rank = 0; rank < lanczos.size(); ++rank) {
      const RitzPair found = lanczos.at(rank);
      if (found.error > eigenvalue_tolerance * found.value) return std::nullopt;
      // the value is 1 / (1 + b^2 omega^2)
      const double omega = std::sqrt(std::max(0.0, 1.0 / found.value - 1.0)) / b;
      if (omega > 2.0 * rigid_mode_ratio * plan.spectrum.omega) return mode_of(plan, damping, x, found.vector.cwiseProduct(inverse));
    }
    return std::nullopt;
  };
  return confirmed_mode(find, !damping.empty());
}

}  // namespace hooke
