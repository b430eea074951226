#include "sim/forces/dashpots/dashpot_sweeps.h"

#include <algorithm>

#include "sim/forces/bands.h"
#include "sim/forces/spring_laws.h"

namespace hooke {

void DashpotSweeps::divide_springs(const Plan& plan) {
  if (plan.springs < min_springs_of_halves) return;

  // between two rows, if there is a grid
  Index middle = plan.points / 2;
  for (const Grid& grid : plan.spring.grids)
    if (grid.first < middle && middle < grid.first + grid.points())
      middle = grid.first + (middle - grid.first) / grid.columns * grid.columns;

  Index crossings = 0;
  for (const SpringRun& run : plan.spring.runs) {
    // the parts of the run: both ends before the middle, one of them, none
    const Index before = std::clamp(middle - run.second, Index{0}, run.count), until = std::clamp(middle - run.first, Index{0}, run.count);
    const auto add = [&](std::vector<SpringRun>& runs, Index begin, Index end) {
      if (begin < end) runs.push_back({run.begin + begin, run.first + begin, run.second + begin, end - begin});
    };
    add(halves_[0], 0, before);
    add(middle_, before, until);
    add(halves_[1], until, run.count);
    crossings += until - before;
  }
  if (min_springs_per_crossing * crossings > plan.springs) clear_halves();
}

void DashpotSweeps::clear_halves() {
  for (std::vector<SpringRun>* runs : {&halves_[0], &halves_[1], &middle_}) runs->clear();
}

void DashpotSweeps::prepare(const Plan& plan, double duration) {
  duration_ = duration;
  plan_dashpot_decay(plan, duration, decay_);
  if (known_runs_ == plan.spring.runs) return;
  clear_halves();
  divide_springs(plan);
  known_runs_ = plan.spring.runs;
}

// Forward: from the middle to both sides.
void DashpotSweeps::sweep_halves(const Plan& plan, SweepDirection sweep, const Field& x, Field& v) const {
  using enum SweepDirection;
  if (sweep == Forward) decay_dashpots(plan, middle_, decay_, Forward, x, v);
  for_parts(plan, 2, 1, [&](int, Index begin, Index end) {
    for (Index half = begin; half < end; ++half)
      decay_dashpots(plan, halves_[half], decay_, (half == 1) == (sweep == Forward) ? Forward : Backward, x, v);
  });
  if (sweep == Backward) decay_dashpots(plan, middle_, decay_, Backward, x, v);
}

void DashpotSweeps::measure(bool is_measured, std::size_t size) {
  is_measured_ = is_measured;
  has_swept_ = false;
  if (!is_measured) return;
  for (Field* field : {&before_, &change_, &work_}) field->resize(size);
}

void DashpotSweeps::begin_step() {
  if (!is_measured_) return;
  has_swept_ = false;
  std::ranges::fill(change_, 0.0);
  std::ranges::fill(work_, 0.0);
}

void DashpotSweeps::sweep(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v) {
  if (!is_measured_) return apply(plan, sweep, time, x, v);
  std::ranges::copy(v, before_.begin());
  apply(plan, sweep, time, x, v);
  has_swept_ = true;
  for (int c = 0; c < plan.dimensions; ++c)
    for (std::size_t i = 0, at = static_cast<std::size_t>(c) * plan.points; i < static_cast<std::size_t>(plan.points); ++i, ++at) {
      const double change = v[at] - before_[at];
      change_[at] += change;
      work_[at] += plan.mass[i] * change * (before_[at] + 0.5 * change);
    }
}

void DashpotSweeps::apply(const Plan& plan, SweepDirection sweep, double time, const Field& x, Field& v) {
  if (sweep == SweepDirection::Backward) sweep_law_dashpots(plan, sweep, duration_, time, x, v);
  if (!halves_[0].empty())
    sweep_halves(plan, sweep, x, v);
  else
    decay_dashpots(plan, plan.spring.runs, decay_, sweep, x, v);
  if (sweep == SweepDirection::Forward) sweep_law_dashpots(plan, sweep, duration_, time, x, v);
}

}  // namespace hooke
