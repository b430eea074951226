#include "sim/statics/linear_motion.h"
#include "sim/statics/constants.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

namespace hooke {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

}  // namespace

struct LinearMotion::Matrices {
  std::vector<std::size_t> points;  // index of each unknown's point
  std::vector<Vec3> directions;     // and its direction
  std::vector<Vec3> origin;         // x0 of all points
  Vector root_mass;                 // [kg^(1/2)], of each unknown
  Matrix rates;                     // of (x - x0, x', 1)
  bool is_supported = false;        // by a nail
  double seconds = 0.0;             // that `step` is the exponential for
  Matrix step;

  void advance(State& state, double duration) {
    const auto n = static_cast<Eigen::Index>(points.size());
    if (duration == 0.0) return;
    // frames of the same length, up to rounding
    if (!(std::abs(duration - seconds) <= 1e-12 * std::abs(duration))) {
      step = (rates * duration).exp();
      seconds = duration;
    }
    Vector now(2 * n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t point = points[static_cast<std::size_t>(i)];
      const Vec3& direction = directions[static_cast<std::size_t>(i)];
      now[i] = glm::dot(direction, state.position[point] - origin[point]);
      now[n + i] = glm::dot(direction, state.velocity[point]);
    }
    now[2 * n] = 1.0;
    const Vector change = step * now - now;
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t point = points[static_cast<std::size_t>(i)];
      state.position[point] += change[i] * directions[static_cast<std::size_t>(i)];
      state.velocity[point] += change[n + i] * directions[static_cast<std::size_t>(i)];
    }
  }
};

std::optional<LinearMotion> LinearMotion::about(const System& system, const std::vector<Vec3>& origin, const std::vector<Vec3>& axes) {
  auto matrices = std::make_shared<Matrices>();
  Matrices& motion = *matrices;
  motion.origin = origin;
  const auto axis_count = static_cast<Index>(axes.size());
  std::vector<Index> first(origin.size(), no_index);  // unknown of each point
  for (std::size_t i = 0; i < origin.size(); ++i) {
    if (system.points()[i].nailed) {
      motion.is_supported = true;
      continue;
    }
    if (system.points()[i].fixed_axes != 0) return std::nullopt;
    first[i] = static_cast<Index>(motion.points.size());
    for (const Vec3& axis : axes) motion.points.push_back(i), motion.directions.push_back(axis);
  }
  const auto n = static_cast<Eigen::Index>(motion.points.size());
  if (n == 0 || n > max_unknowns) return std::nullopt;

  Matrix stiffness = Matrix::Zero(n, n), damping = Matrix::Zero(n, n);
  Vector force = Vector::Zero(n);
  for (const Spring& spring : system.springs()) {
    const auto i = static_cast<std::size_t>(system.index_of(spring.first)), j = static_cast<std::size_t>(system.index_of(spring.second));
    const double length = glm::distance(origin[i], origin[j]), k = system.stiffness_of(spring), d = system.damping_of(spring);
    if (!(length > 0.0)) return std::nullopt;
    const Vec3 u = (origin[j] - origin[i]) / length;
    const double transverse = k * (1.0 - spring.rest_length / length);
    for (Index a = 0; a < axis_count; ++a) {
      const double pull = k * (length - spring.rest_length) * glm::dot(u, axes[static_cast<std::size_t>(a)]);
      if (first[i] != no_index) force[first[i] + a] += pull;
      if (first[j] != no_index) force[first[j] + a] -= pull;
      for (Index b = 0; b < axis_count; ++b) {
        const Vec3 &p = axes[static_cast<std::size_t>(a)], &q = axes[static_cast<std::size_t>(b)];
        const double axial = glm::dot(u, p) * glm::dot(u, q);
        const double of_k = k * axial + transverse * (glm::dot(p, q) - axial), of_d = d * axial;
        for (const auto& [row, column, sign] : {std::tuple{i, i, 1.0}, {i, j, -1.0}, {j, i, -1.0}, {j, j, 1.0}}) {
          if (first[row] == no_index || first[column] == no_index) continue;
          stiffness(first[row] + a, first[column] + b) += sign * of_k;
          damping(first[row] + a, first[column] + b) += sign * of_d;
        }
      }
    }
  }
  motion.root_mass.resize(n);
  motion.rates = Matrix::Zero(2 * n + 1, 2 * n + 1);
  motion.rates.block(0, n, n, n).setIdentity();
  for (Eigen::Index i = 0; i < n; ++i) {
    const double mass = system.points()[motion.points[static_cast<std::size_t>(i)]].mass;
    const Vec3& direction = motion.directions[static_cast<std::size_t>(i)];
    motion.root_mass[i] = std::sqrt(mass);
    motion.rates.block(n + i, 0, 1, n) = -stiffness.row(i) / mass;
    motion.rates.block(n + i, n, 1, n) = -damping.row(i) / mass;
    motion.rates(n + i, n + i) -= system.drag_rate();
    motion.rates(n + i, 2 * n) = (force[i] + glm::dot(direction, system.points()[motion.points[static_cast<std::size_t>(i)]].load)) / mass +
                                 glm::dot(direction, system.gravity) + system.drag_rate() * glm::dot(direction, system.wind);
  }
  LinearMotion result;
  result.matrices_ = std::move(matrices);
  return result;
}

void LinearMotion::advance(State& state, double seconds) { matrices_->advance(state, seconds); }

double LinearMotion::drift_speed(const State& state) const {
  const Matrices& motion = *matrices_;
  const auto n = static_cast<Eigen::Index>(motion.points.size());
  const Vector& root = motion.root_mass;
  // M^(-1/2) K M^(-1/2), whose modes are orthogonal
  Matrix stiffness = root.asDiagonal() * -motion.rates.block(n, 0, n, n) * root.cwiseInverse().asDiagonal();
  stiffness = 0.5 * (stiffness + stiffness.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Matrix> modes(stiffness);
  const double max = modes.eigenvalues().cwiseAbs().maxCoeff();
  Vector velocity(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto u = static_cast<std::size_t>(i);
    velocity[i] = root[i] * glm::dot(motion.directions[u], state.velocity[motion.points[u]]);
  }
  Vector drift = Vector::Zero(n);
  for (Eigen::Index mode = 0; mode < n; ++mode)
    if (modes.eigenvalues()[mode] < zero_eigenvalue * max)
      drift += modes.eigenvectors().col(mode).dot(velocity) * modes.eigenvectors().col(mode);
  // of the whole scene, along each axis
  for (const Vec3& axis : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0), Vec3(0.0, 0.0, 1.0)}) {
    if (motion.is_supported) break;
    Vector translation(n);
    for (Eigen::Index i = 0; i < n; ++i) translation[i] = root[i] * glm::dot(motion.directions[static_cast<std::size_t>(i)], axis);
    const double square = translation.squaredNorm();
    if (square > 0.0) drift -= translation.dot(velocity) / square * translation;
  }
  return drift.cwiseQuotient(root).norm() / std::sqrt(static_cast<double>(n));
}

}  // namespace hooke
