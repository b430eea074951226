#include "sim/contact/pair_solver.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hooke {
namespace {

bool is_fixed(const Plan& plan, Index i) { return plan.inverse_mass_in_contact()[i] == 0.0; }

// [m], a bound on how far an obstacle moves in a substep.
double max_path(const Obstacle& obstacle, double h) {
  return h * (glm::length(obstacle.velocity_at(0.0)) + glm::length(obstacle.velocity_at(h)) + glm::length(obstacle.velocity_correction));
}

// Whether a point from x may touch the obstacle within the substep if it moves by no more than `reach`.
bool is_near(const Obstacle& obstacle, double radius, const Vec3& x, double reach, double h) {
  return gap_to(*obstacle.collider, radius, x - obstacle.offset).distance <= reach + max_path(obstacle, h);
}

// Touches examined and impulses of a substep: those of some hundred sweeps over what points touch in a heap.
long usual_work(std::size_t points) { return 5'000 * static_cast<long>(points); }
// In a frame, beyond usual_work of each substep: parts of a second.
constexpr long max_excess = 10'000'000;

}  // namespace

bool PairSolver::resolve(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h, Motion& motion,
                         std::span<Vec3> displaced) {
  has_failed_ = false;
  near_.clear();
  is_involved_.assign(plan.points, 0);
  // a motion that is not finite has diverged
  if (!measure(plan, obstacles, x0, v0, h, motion)) return false;

  // the pairs that may touch; those that may do so after an impact of these; and again when a point gets farther than expected
  long work = 0;
  bool is_complete = false;
  for (int round = 0; !is_complete && !has_failed_; ++round) {
    if (!is_covered(plan, x0) && !find_pairs(plan, x0)) break;
    work += static_cast<long>(pairs_.size());
    if (!involve_pairs(plan, x0)) break;
    if (round == 0) continue;
    fill(plan, obstacles, x0, v0, h, motion);
    simulation_.begin(plan.surface, h);
    const auto is_affordable = [&] { return excess_ + work + simulation_.counts().work() - usual_work(plan.points) <= max_excess; };
    is_complete = is_within_bounds(plan, x0, h);
    while (is_affordable() && simulation_.advance()) is_complete = is_within_bounds(plan, x0, h) && is_complete;
    has_failed_ = !is_affordable();
    work += simulation_.counts().work();
    motion.counts.contact_tests += simulation_.counts().tests;
    motion.counts.contact_impulses += simulation_.counts().impulses;
  }
  motion.counts.contact_tests += static_cast<long>(pairs_.size());
  if (!is_complete || has_failed_) {
    is_involved_.assign(plan.points, 0);
    return false;
  }
  excess_ += std::max(0L, work - usual_work(plan.points));
  write(plan, motion, displaced);
  return simulation_.any_touched();
}

// Returns whether all are finite.
bool PairSolver::measure(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                         const Motion& motion) {
  free_.resize(plan.points);
  double sum = 0.0;
  for (Index i = 0; i < plan.points; ++i) {
    const Vec3 start = vector_at(plan, x0, i);
    const double change = h * glm::length(vector_at(plan, motion.v, i) - vector_at(plan, v0, i));
    FreeMotion& free = free_[i];
    free = {.displacement = vector_at(plan, motion.x, i) - start, .deviation = 3.125 * change};
    const double length = glm::length(free.displacement) + change;
    // an impact on an obstacle leads away by at most this much: the point is no faster than before, or than the obstacle
    for (const Obstacle& obstacle : obstacles)
      if (!is_fixed(plan, i) && is_near(obstacle, plan.radius[i], start, length, h))
        free.impact = std::max(free.impact, 2.0 * (length + max_path(obstacle, h)));
    sum += free.reach();
  }
  return std::isfinite(sum);
}

// Whether the pairs contain all points that may meet in this substep.
bool PairSolver::is_covered(const Plan& plan, const Field& x0) const {
  if (margin_.empty() || margin_.size() != free_.size()) return false;
  for (Index i = 0; i < plan.points; ++i) {
    const double moved = glm::length(vector_at(plan, x0, i) - vector_at(plan, found_at_, i));
    if (!(moved + free_[i].reach() <= margin_[i])) return false;
  }
  return true;
}

bool PairSolver::find_pairs(const Plan& plan, const Field& x0) {
  margin_.resize(plan.points);
  extent_.resize(plan.points);
  for (Index i = 0; i < plan.points; ++i) {
    margin_[i] = std::max(0.5 * plan.radius[i], 4.0 * free_[i].reach());
    extent_[i] = plan.radius[i] + 0.5 * plan.pairs.thickness + margin_[i];
  }
  found_at_ = x0;
  has_failed_ = !search_.find(plan, x0, extent_, pairs_, max_pairs);
  if (has_failed_) margin_.clear();
  return !has_failed_;
}

// Marks the points that may touch another, and bounds where impacts on them may lead. Returns whether there are any.
bool PairSolver::involve_pairs(const Plan& plan, const Field& x0) {
  near_.clear();
  for (const PointPair& pair : pairs_) {
    const FreeMotion &first = free_[pair.i], &second = free_[pair.j];
    const double distance = glm::length(vector_at(plan, x0, pair.i) - vector_at(plan, x0, pair.j));
    const double approach = glm::length(first.displacement - second.displacement);
    const double reach = approach + first.deviation + first.impact + second.deviation + second.impact;
    if (distance <= touching_distance(plan, pair) + reach + contact_tolerance(Vec3(distance))) near_.push_back(pair);
  }
  for (const PointPair& pair : near_) {
    // at least so much that points in a heap, which push each other, seldom get farther
    const double approach = glm::length(free_[pair.i].displacement - free_[pair.j].displacement);
    const double impact = std::max(2.0 * approach, touching_distance(plan, pair) / 16.0);
    for (const Index i : {pair.i, pair.j}) {
      is_involved_[i] = 1;
      free_[i].impact = std::max(free_[i].impact, impact);
    }
  }
  return !near_.empty();
}

void PairSolver::fill(const Plan& plan, std::span<const Obstacle> obstacles, const Field& x0, const Field& v0, double h,
                      const Motion& motion) {
  simulation_.clear();
  path_of_.assign(plan.points, no_path);
  for (Index i = 0; i < plan.points; ++i) {
    if (is_involved_[i] == 0) continue;
    path_of_[i] = simulation_.paths.size();
    simulation_.add_point(plan, i, vector_at(plan, x0, i), vector_at(plan, v0, i), vector_at(plan, motion.x, i),
                          vector_at(plan, motion.v, i), h);
  }

  for (const PointPair& pair : near_)
    simulation_.add_pair(path_of_[pair.i], path_of_[pair.j], touching_distance(plan, pair), plan.pairs.restitution, plan.pairs.friction);
  const std::size_t points = simulation_.paths.size();
  simulation_.add_obstacles(obstacles, h);
  for (std::size_t p = 0; p < points; ++p) {
    const Index i = simulation_.paths[p].point;
    if (is_fixed(plan, i)) continue;
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      if (is_near(obstacles[o], plan.radius[i], vector_at(plan, x0, i), free_[i].reach(), h))
        simulation_.add_touch(p, obstacles[o], o, plan.radius[i]);
  }
}

// Whether the paths that have just changed stay within their bounds. Otherwise extends these.
bool PairSolver::is_within_bounds(const Plan& plan, const Field& x0, double h) {
  bool is_within = true;
  const double left = h - simulation_.time();
  for (const std::size_t p : simulation_.changed()) {
    const PointPath& path = simulation_.paths[p];
    const Vec3 x = path.position(simulation_.time()), v = path.velocity(simulation_.time());
    const double length = left * (glm::length(v) + 0.5 * left * glm::length(path.a)) + 3.0 * h * path.velocity_change;
    const double reach = glm::length(x - vector_at(plan, x0, path.point)) + length;
    FreeMotion& free = free_[path.point];
    if (reach <= free.reach()) continue;
    free.impact = 2.0 * reach;
    is_within = false;
  }
  return is_within;
}

// Positions and velocities at the end, and the work of contact in addition to that of the forces.
void PairSolver::write(const Plan& plan, Motion& motion, std::span<Vec3> displaced) {
  work_ = 0.0;
  for (const PointPath& path : simulation_.paths) {
    if (!path.is_changed) continue;
    work_ += path.contact_work();
    displaced[path.point] = path.displaced;
    set_vector(plan, motion.x, path.point, path.x);
    set_vector(plan, motion.v, path.point, path.v - path.velocity_correction);
  }
}

}  // namespace hooke
