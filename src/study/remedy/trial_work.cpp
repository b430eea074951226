#include "study/remedy/trial_work.h"

#include <algorithm>

namespace hooke {
namespace {

constexpr double of_frame = 2000.0, of_point = 100.0, of_spring = 10.0;  // [ns]

}  // namespace

double work_beside_substeps(double points, double springs, double frames) {
  return frames * (of_frame + of_point * points + of_spring * springs);
}

double TrialWork::since_last(const FrameRunner& frame, bool is_finished) {
  constexpr double ns_per_ms = 1e6;
  // what each call costs by itself [ns], which the cost model of `auto` leaves out
  constexpr double call = 250.0;
  ++calls_;
  const double counted = ns_per_ms * frame.cost(plan_) + call * static_cast<double>(calls_);
  const double trials = ns_per_ms * frame.trial_cost();
  const double work = std::max(0.0, counted - counted_) + std::max(0.0, trials - trials_);
  counted_ = is_finished ? 0.0 : counted;
  trials_ = trials;
  if (!is_finished) return work;
  calls_ = 0;
  const double items = plan_.points + 3.0 * static_cast<double>(plan_.force_data.faces), forces = static_cast<double>(plan_.forces.size());
  return work + of_frame + items * (of_point + 45.0 * forces) + of_spring * plan_.springs;
}

}  // namespace hooke
