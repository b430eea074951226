#include "study/remedy/trial_work.h"

#include <algorithm>

namespace hooke {

double TrialWork::since_last(const Frame& frame, bool is_finished) {
  constexpr double ns_per_ms = 1e6;
  // What the cost model of `auto` leaves out or counts for laws that cost little [ns]: power laws, at every force evaluation and for the
  // work that they do in a substep; the strain limit; and what each call and each frame costs by itself.
  constexpr double law = 45.0, work_of_law = 130.0, limit = 75.0, call = 250.0, of_frame = 2000.0;
  ++calls_;
  const Motion& motion = frame.motion();
  if (motion.limit_work != limit_work_) ++limited_;
  limit_work_ = motion.limit_work;
  const double items = plan_.points + 3.0 * static_cast<double>(plan_.faces.size());
  const double laws = items * static_cast<double>(plan_.forces.size());
  const double counted = ns_per_ms * frame.cost(plan_) +
                         laws * (law * static_cast<double>(motion.force_evaluations) + work_of_law * static_cast<double>(calls_)) +
                         limit * plan_.springs * static_cast<double>(limited_) + call * static_cast<double>(calls_);
  const double trials = ns_per_ms * frame.trial_cost();
  const double work = std::max(0.0, counted - counted_) + std::max(0.0, trials - trials_);
  counted_ = is_finished ? 0.0 : counted;
  trials_ = trials;
  if (!is_finished) return work;
  calls_ = limited_ = 0;
  limit_work_ = 0.0;
  return work + of_frame + items * (100.0 + law * static_cast<double>(plan_.forces.size())) + 10.0 * plan_.springs;
}

}  // namespace hooke
