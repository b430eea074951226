#include "sim/control/cost_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace hooke {
namespace {

constexpr double ms_per_ns = 1e-6;
// Passes over all points for each stage, which methods without fused kicks and drifts make.
constexpr double unfused = 1.45;
// [ns], of contact of points, faces and springs with each other: within a factor of 1.5 in piles of balls and sheets in folds.
constexpr double contact_test = 45.0, contact_impulse = 18.0;

}  // namespace

CostModel::CostModel(const Plan& plan) {
  const double points = static_cast<double>(std::ranges::count_if(plan.inverse_mass, [](double w) { return w != 0.0; })),
               springs = plan.springs, dimensions = plan.dimensions;
  force_ = 2.8 * springs + 0.4 * points + 80.0;
  for (const Force& force : plan.forces) {
    const ForceCost cost = force.term->cost != nullptr ? force.term->cost(plan, force.values) : ForceCost{};
    const double items = cost.of_faces ? static_cast<double>(plan.force_data.faces.size()) : points;
    force_ += cost.evaluation * items;
    substep_ += cost.energy * items;
  }
  if (!plan.spring.max_length.empty()) {
    limit_sweep_ = 5.0 * springs;
    substep_ += springs;
    // while a part of the springs is at the limit
    expected_limit_ = 5.0 * limit_sweep_;
  }
  const double contacts = (plan.pairs.on ? 1.0 : 0.0) + (plan.surface.on ? 1.0 : 0.0);
  contact_ = points * (10.0 * static_cast<double>(plan.colliders.size()) + 20.0 * contacts);
  // between that in flight and in a pile
  expected_contact_ = contact_ + 380.0 * points * contacts;
  sweep_ = 10.2 * springs + points + 100.0;
  dashpots_ = plan.has_dashpots() ? 2.6 * springs : 0.0;

  // a chain fills nothing in; of the springs of a net that close loops, each separates regions of about sqrt(n) points
  const double loops = std::max(0.0, springs / std::max(1.0, points) - 1.0), area = dimensions * dimensions / 9.0;
  const double levels = std::bit_width(static_cast<unsigned>(points));
  factorization_ = area * points * (140.0 + 10.0 * loops * std::sqrt(points)) + 100.0;
  solve_ = area * points * (95.0 + 5.0 * loops * levels) + force_;
}

double CostModel::evaluation(const Integrator& method) const {
  return method.stability == Stability::Conditional && method.symplectic ? force_ : unfused * force_;
}

double CostModel::of(const Integrator& method, const Motion& motion, int substeps) const {
  const bool is_implicit = method.implicit_solve != ImplicitSolve::None;
  const double evaluations = is_implicit ? 0.0 : evaluation(method) * static_cast<double>(motion.counts.force_evaluations);
  const double contact = contact_test * static_cast<double>(motion.counts.contact_tests) +
                         contact_impulse * static_cast<double>(motion.counts.contact_impulses);
  return ms_per_ns *
         (evaluations + (contact_ + substep_) * substeps + contact + sweep_ * static_cast<double>(motion.counts.sweeps) +
          limit_sweep_ * static_cast<double>(motion.counts.limit_sweeps) + dashpots_ * static_cast<double>(motion.counts.dashpot_sweeps) +
          factorization_ * static_cast<double>(motion.counts.factorizations) + solve_ * static_cast<double>(motion.counts.solves));
}

double CostModel::expected(const Integrator& method, int substeps) const {
  const double between = expected_contact_ + substep_ + expected_limit_;
  if (method.implicit_solve == ImplicitSolve::Once) return ms_per_ns * substeps * (factorization_ + solve_ + between);
  if (method.implicit_solve == ImplicitSolve::Iterative) {
    constexpr int iterations = 4;
    const int stages = method.order <= 2 ? method.order : 5;
    return ms_per_ns * (factorization_ + substeps * (stages * iterations * solve_ + between));
  }
  if (method.stability == Stability::EachSpring) return ms_per_ns * substeps * (sweep_ + between);
  const int evaluations = method.order <= 2 ? 1 : method.symplectic ? 6 : method.order;
  const double dashpots = method.splits_dashpots ? 2.0 * dashpots_ : 0.0;
  return ms_per_ns * (substeps * (evaluations * evaluation(method) + dashpots + between) + force_);
}

}  // namespace hooke
