#include "lab/accuracy/companions.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/control/frame_error.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

// Of the table; the older half is dropped when it is full.
constexpr std::size_t max_times = 20'000;

}  // namespace

void Companions::set(std::vector<Companion> companions) {
  companions_ = std::move(companions);
  runs_.clear();
  runs_.resize(companions_.size());
  is_new_ = true;
  has_frame_ = false;
  status_ = {};
  for (const Companion& companion : companions_) status_.list.push_back({.name = companion.name, .positions = {}});
}

void Companions::restart() {
  if (companions_.empty()) return;
  set(std::exchange(companions_, {}));
}

void Companions::start(const Plan& plan, const State& state) {
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    runs_[i] = {.shadow = {}, .is_on = true};
    runs_[i].shadow.set_plan(plan);
    runs_[i].shadow.start(state);
  }
  table_ = {};
  table_.distances.resize(runs_.size());
  status_.since = state.time;
  is_new_ = false;
}

void Companions::add_frame(const Plan& plan, const System& system, const Settings& settings, const State& before, const State& after) {
  if (companions_.empty()) return;
  while (has_frame_) substep(system);
  if (is_new_) start(plan, before);
  time_ = before.time;
  end_time_ = after.time;
  frame_rate_ = settings.frame_rate;
  hand_ = before.hand;
  end_ = after.position;
  for (Run& run : runs_) run.is_done = !run.is_on;
  has_frame_ = true;
}

void Companions::substep(const System& system) {
  const auto next = std::ranges::find(runs_, false, &Run::is_done);
  if (next == runs_.end()) return finish_frame(system);
  const auto i = static_cast<std::size_t>(next - runs_.begin());
  if (!next->shadow.is_in_frame()) {
    Settings settings = companions_[i].settings;
    settings.frame_rate = frame_rate_;
    next->shadow.begin_frame(system, settings, time_, hand_);
  }
  next->shadow.substep();
  next->is_done = !next->shadow.is_in_frame();
  if (std::ranges::all_of(runs_, &Run::is_done)) finish_frame(system);
}

void Companions::finish_frame(const System& system) {
  has_frame_ = false;
  if (table_.times.size() >= max_times) {
    const auto half = static_cast<std::ptrdiff_t>(max_times / 2);
    table_.times.erase(table_.times.begin(), table_.times.begin() + half);
    for (auto& distances : table_.distances) distances.erase(distances.begin(), distances.begin() + half);
  }
  table_.times.push_back(end_time_);
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    CompanionStatus& status = status_.list[i];
    const State& state = runs_[i].shadow.state();
    if (runs_[i].is_on && (runs_[i].shadow.failed() || !is_finite(state))) {
      runs_[i].is_on = false;
      status.has_diverged = true;
      status.positions.reset();
    }
    if (runs_[i].is_on) {
      status.positions = std::make_shared<const std::vector<Vec3>>(state.position);
      status.distance = weighted_distance(system, end_, state.position, 1.0).rms;
    }
    table_.distances[i].push_back(runs_[i].is_on ? status.distance : std::numeric_limits<double>::quiet_NaN());
  }
  status_.table = std::make_shared<const CompanionTable>(table_);
}

}  // namespace hooke
