#include "sim/control/cost_model.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/control/constants.h"
#include "sim/methods/integrator.h"

namespace hooke {
namespace {

using namespace control;

constexpr double ms_per_ns = 1e-6;

}  // namespace

CostModel::CostModel(const Plan& plan) {
  const double points = static_cast<double>(std::ranges::count_if(plan.inverse_mass, [](double w) { return w != 0.0; })),
               springs = plan.springs, dimensions = plan.dimensions;
  force_ = spring_cost * springs + point_cost * points + call_cost;
  for (const Force& force : plan.forces) {
    const ForceCost cost = force.term->cost != nullptr ? force.term->cost(plan, force.values) : ForceCost{};
    const double items = cost.of_faces ? static_cast<double>(plan.force_data.faces) : points;
    force_ += cost.evaluation * items;
    substep_ += cost.energy * items;
  }
  if (!plan.spring.max_length.empty()) {
    limit_sweep_ = limit_cost * springs;
    substep_ += springs;
    expected_limit_ = expected_limit_sweeps * limit_sweep_;
  }
  const double contacts = (plan.pairs.on ? 1.0 : 0.0) + (plan.surface.on ? 1.0 : 0.0);
  const double search = (plan.pairs.on ? neighbor_cost : 0.0) + (plan.surface.on ? surface_cost : 0.0);
  contact_ = points * (collider_cost * static_cast<double>(plan.colliders.size()) + search);
  expected_contact_ = contact_ + points * std::max(0.0, expected_neighbor_cost * contacts - search);
  sweep_ = constraint_cost * springs + constraint_point_cost * points + constraint_call_cost;
  dashpots_ = plan.has_dashpots() ? dashpot_cost * springs : 0.0;

  // a chain fills nothing in; of the springs of a net that close loops, each separates regions of about sqrt(n) points
  const double loops = std::max(0.0, springs / std::max(1.0, points) - 1.0), area = dimensions * dimensions / 9.0;
  const double levels = std::bit_width(static_cast<unsigned>(points));
  factorization_ = area * points * (factor_cost + factor_loop_cost * loops * std::sqrt(points)) + constraint_call_cost;
  solve_ = area * points * (solve_cost + solve_loop_cost * loops * levels) + force_;
}

double CostModel::evaluation(const Integrator& method) const {
  return method.stability == Stability::Conditional && method.is_symplectic() ? force_ : unfused_factor * force_;
}

double CostModel::of(const Integrator& method, const Motion& motion, int substeps) const {
  const double evaluations = method.is_implicit() ? 0.0 : evaluation(method) * static_cast<double>(motion.counts.force_evaluations);
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
    const int stages = method.order <= 2 ? method.order : 5;
    return ms_per_ns * (factorization_ + substeps * (stages * expected_iterations * solve_ + between));
  }
  if (method.stability == Stability::EachSpring) return ms_per_ns * substeps * (sweep_ + between);
  const int evaluations = method.order <= 2 ? 1 : method.is_symplectic() ? 6 : method.order;
  const double dashpots = method.splits_dashpots ? 2.0 * dashpots_ : 0.0;
  return ms_per_ns * (substeps * (evaluations * evaluation(method) + dashpots + between) + force_);
}

}  // namespace hooke
