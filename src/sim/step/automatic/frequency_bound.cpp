// The stiffness matrix of springs is K = sum k u u^T + k (1 - l0 / l) (I - u u^T) over the springs, u their directions. With B the matrix
// whose columns are the directions of the springs at their ends, the first part is B k B^T, and M^-1/2 B k B^T M^-1/2 has the eigenvalues
// of k^1/2 B^T M^-1 B k^1/2, whose rows are springs: Gershgorin's theorem, with rows scaled by k^1/2, bounds them by
//   omega^2 <= max_e sum_f k_f |u_e.u_f| / m     over the springs f that share a point of mass m with e, itself at both ends included.
// It is the highest frequency of a chain and of a square net, and 1.1 times that of a sheet with diagonals. The second part is bounded by
// the rows of its points (bound_spectrum), without springs that are compressed. Dashpots have the form of the first part.
#include "sim/step/automatic/frequency_bound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

// Motion that accelerates turns a spring by more than its present rate does.
constexpr double turn_margin = 2.0, margin = 1.02;
constexpr double ns_per_pair = 1.5, ns_per_spring = 12.0;

}  // namespace

// Those of the previous call, if the scene still has the same springs.
void FrequencyBound::find_neighbors(const Plan& plan) {
  if (runs_ == plan.spring.runs && begin_.size() == static_cast<std::size_t>(plan.points) + 1) return;
  runs_ = plan.spring.runs;
  first_.assign(plan.springs, 0);
  second_.assign(plan.springs, 0);
  begin_.assign(static_cast<std::size_t>(plan.points) + 1, 0);
  for (const SpringRun& run : runs_)
    for (Index e = 0; e < run.count; ++e) {
      first_[run.begin + e] = run.first + e;
      second_[run.begin + e] = run.second + e;
    }
  for (Index e = 0; e < plan.springs; ++e) ++begin_[first_[e] + 1], ++begin_[second_[e] + 1];
  pairs_ = 0;
  for (std::size_t i = 1; i < begin_.size(); ++i) {
    pairs_ += static_cast<std::size_t>(begin_[i]) * begin_[i];
    begin_[i] += begin_[i - 1];
  }
  adjacent_.assign(2 * static_cast<std::size_t>(plan.springs), 0);
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (Index e = 0; e < plan.springs; ++e) {
    adjacent_[next[first_[e]]++] = e;
    adjacent_[next[second_[e]]++] = e;
  }
}

double FrequencyBound::cost(const Plan& plan) {
  find_neighbors(plan);
  return 1e-6 * (ns_per_pair * static_cast<double>(pairs_) + ns_per_spring * plan.springs);
}

double FrequencyBound::relative(const Plan& plan, const State& state, double duration) {
  const Spectrum& bounds = plan.spectrum;
  if (plan.springs == 0 || !plan.forces.empty() || plan.hand.pull || plan.has_contact() || !plan.spring.max_length.empty() ||
      bounds.omega <= 0.0)
    return 1.0;
  find_neighbors(plan);

  // directions, how far they may turn, and what tension adds
  directions_.resize(plan.springs);
  tension_.assign(plan.points, 0.0);
  for (Index e = 0; e < plan.springs; ++e) {
    const Index i = first_[e], j = second_[e];
    const Index listed_i = plan.listed_index(i), listed_j = plan.listed_index(j);
    const Vec3 d = state.position[listed_j] - state.position[listed_i], w = state.velocity[listed_j] - state.velocity[listed_i];
    const double length = glm::length(d);
    Direction& direction = directions_[e];
    if (!(length > 0.0)) return 1.0;
    direction.along = d / length;
    const double approach = glm::dot(w, direction.along);
    direction.turn = turn_margin * duration * glm::length(w - approach * direction.along) / length;
    const double longest = length + turn_margin * duration * std::abs(approach);
    const double k = plan.spring.stiffness[e] * std::max(0.0, 1.0 - plan.spring.rest_length[e] / longest);
    const double a = plan.inverse_mass[i], b = plan.inverse_mass[j], coupling = std::sqrt(a * b);
    tension_[i] += k * (a + coupling);
    tension_[j] += k * (b + coupling);
  }

  double max_row = 0.0, max_dashpot_row = 0.0;
  for (Index e = 0; e < plan.springs; ++e) {
    const Direction& of = directions_[e];
    double row = 0.0, dashpot_row = 0.0;
    for (const Index i : {first_[e], second_[e]}) {
      double sum = 0.0, dashpot_sum = 0.0;
      for (Index at = begin_[i]; at < begin_[i + 1]; ++at) {
        const Index f = adjacent_[at];
        const Direction& other = directions_[f];
        const double part = std::min(1.0, std::abs(glm::dot(of.along, other.along)) + of.turn + other.turn);
        sum += plan.spring.stiffness[f] * part;
        if (plan.has_dashpots()) dashpot_sum += plan.spring.damping[f] * part;
      }
      row += plan.inverse_mass[i] * sum;
      dashpot_row += plan.inverse_mass[i] * dashpot_sum;
    }
    max_row = std::max(max_row, row);
    max_dashpot_row = std::max(max_dashpot_row, dashpot_row);
  }
  const double omega = std::sqrt(max_row + *std::ranges::max_element(tension_));
  double relative = omega / bounds.omega;
  if (bounds.dashpot_rate > 0.0) relative = std::max(relative, max_dashpot_row / bounds.dashpot_rate);
  return std::min(1.0, margin * relative);
}

}  // namespace hooke
