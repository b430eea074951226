#include "sim/modes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sim/spring_frames.h"

namespace hooke {
namespace {

using Vector = Eigen::VectorXd;
using Operator = std::function<void(Vector&)>;  // in place

constexpr int most_steps = 40;
constexpr double close_enough = 0.02;  // of an eigenvalue, which is the square of a frequency

struct Ritz {
  double value, error;
  Vector vector;
};

// The eigenvalues that Lanczos' method sees of a symmetric operator, from the largest down, with a bound on the error of each.
class Lanczos {
 public:
  Lanczos(Vector start, const Operator& apply) {
    const int steps = static_cast<int>(std::min<Eigen::Index>(most_steps, start.size()));
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
    last_ = beta[size - 1];
    solver_.computeFromTridiagonal(alpha.head(size), beta.head(size - 1));
  }

  int size() const { return static_cast<int>(basis_.size()); }
  // `place`: 0 for the largest
  Ritz at(int place) const {
    const auto column = size() - 1 - place;
    const Vector share = solver_.eigenvectors().col(column);
    Vector vector = Vector::Zero(basis_[0].size());
    for (int j = 0; j < size(); ++j) vector += share[j] * basis_[j];
    return {solver_.eigenvalues()[column], last_ * std::abs(share[size() - 1]), vector};
  }

 private:
  std::vector<Vector> basis_;
  double last_ = 0.0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver_;
};

// sqrt(m) of every unknown; 0 where nothing moves.
Vector root_mass_of(const Plan& plan) {
  Vector root(static_cast<Eigen::Index>(plan.points) * plan.dimensions);
  for (int c = 0; c < plan.dimensions; ++c)
    for (Index i = 0; i < plan.points; ++i)
      root[static_cast<Eigen::Index>(c) * plan.points + i] = plan.inverse_mass[i] == 0.0 ? 0.0 : std::sqrt(plan.mass[i]);
  return root;
}

Vector inverse_of(const Vector& root) {
  return root.unaryExpr([](double each) { return each == 0.0 ? 0.0 : 1.0 / each; });
}

// No symmetry of a scene has it, and it is the same every time: multiples of an irrational number without their whole part
// (H. Weyl 1916). 0 where nothing moves.
Vector start_of(const Vector& root, double irrational) {
  Vector start = root;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const double turns = irrational * static_cast<double>(i) * static_cast<double>(i + 1);
    if (start[i] != 0.0) start[i] = turns - std::floor(turns) - 0.5;
  }
  return start;
}
constexpr double golden = 0.6180339887498949, silver = 0.4142135623730951;

// One mode, as it is found from two starts: where they differ in what the dashpots take, it is not one but several.
template <class Find>
std::optional<Mode> one_of(const Find& find, bool is_damped) {
  std::optional<Mode> mode = find(golden);
  if (!mode || !is_damped) return mode;
  const std::optional<Mode> other = find(silver);
  constexpr double alike = 0.1, none = 1e-6;
  if (!other ||
      std::abs(mode->dashpot_rate - other->dashpot_rate) > alike * std::max(mode->dashpot_rate, other->dashpot_rate) + none * mode->omega)
    mode->dashpot_rate = std::numeric_limits<double>::quiet_NaN();
  return mode;
}

// u.K u and u.D u, of a mode with u.M u = 1.
Mode mode_of(const Plan& plan, const std::vector<double>& damping, const Field& x, const Vector& u) {
  double stiffness = 0.0, rate = 0.0;
  for_each_frame(plan, x, [&](Index i, Index j, Index s, const SpringFrame& frame) {
    double along = 0.0, square = 0.0;
    for (int c = 0; c < plan.dimensions; ++c) {
      const Eigen::Index start = static_cast<Eigen::Index>(c) * plan.points;
      const double part = u[start + i] - u[start + j];
      along += frame.u[c] * part;
      square += part * part;
    }
    stiffness += frame.along * along * along + frame.across * std::max(0.0, square - along * along);
    if (!damping.empty()) rate += damping[s] * along * along;
  });
  return {std::sqrt(std::max(0.0, stiffness)), rate};
}

}  // namespace

std::optional<Mode> fastest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x) {
  const Vector root = root_mass_of(plan), inverse = inverse_of(root);
  Vector force(root.size());
  const auto apply = [&](Vector& y) {
    y = y.cwiseProduct(inverse);
    force.setZero();
    for_each_frame(plan, x, [&](Index i, Index j, Index, const SpringFrame& frame) {
      double along = 0.0;
      for (int c = 0; c < plan.dimensions; ++c) {
        const Eigen::Index start = static_cast<Eigen::Index>(c) * plan.points;
        along += frame.u[c] * (y[start + i] - y[start + j]);
      }
      for (int c = 0; c < plan.dimensions; ++c) {
        const Eigen::Index start = static_cast<Eigen::Index>(c) * plan.points;
        const double f = (frame.along - frame.across) * along * frame.u[c] + frame.across * (y[start + i] - y[start + j]);
        force[start + i] += f;
        force[start + j] -= f;
      }
    });
    y = force.cwiseProduct(inverse);
  };
  const auto find = [&](double irrational) -> std::optional<Mode> {
    const Lanczos lanczos(start_of(root, irrational), apply);
    if (lanczos.size() == 0) return std::nullopt;
    const Ritz found = lanczos.at(0);
    if (!(found.value > 0.0)) return std::nullopt;
    return mode_of(plan, damping, x, found.vector.cwiseProduct(inverse));
  };
  return one_of(find, !damping.empty());
}

std::optional<Mode> slowest_mode(const Plan& plan, const std::vector<double>& damping, const Field& x, double loose,
                                 StiffnessMatrix& matrix) {
  const double b = 0.1 / (loose * plan.spectrum.omega);
  const Field still(x.size(), 0.0);
  matrix.assemble(plan, b, x, still, Curvature::Clamped);
  if (!std::isfinite(b) || !matrix.factorize()) return std::nullopt;

  const Vector root = root_mass_of(plan), inverse = inverse_of(root);
  Field solved(x.size());
  const auto apply = [&](Vector& y) {
    Vector::Map(solved.data(), y.size()) = y.cwiseProduct(root);
    matrix.solve(solved);
    y = Vector::Map(solved.data(), y.size()).cwiseProduct(root);
  };
  const auto find = [&](double irrational) -> std::optional<Mode> {
    const Lanczos lanczos(start_of(root, irrational), apply);
    for (int place = 0; place < lanczos.size(); ++place) {
      const Ritz found = lanczos.at(place);
      if (found.error > close_enough * found.value) return std::nullopt;
      // the value is 1 / (1 + b^2 omega^2)
      const double omega = std::sqrt(std::max(0.0, 1.0 / found.value - 1.0)) / b;
      if (omega > 2.0 * loose * plan.spectrum.omega) return mode_of(plan, damping, x, found.vector.cwiseProduct(inverse));
    }
    return std::nullopt;
  };
  return one_of(find, !damping.empty());
}

}  // namespace hooke
