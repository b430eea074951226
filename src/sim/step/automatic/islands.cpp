#include "sim/step/automatic/islands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/disjoint_sets.h"
#include "sim/plan/spectrum_rows.h"
#include "sim/step/automatic/rates.h"
#include "sim/step/automatic/trials.h"

namespace hooke {
namespace {

// Parts whose substeps differ by at most this factor are stepped together. Groups are stepped separately where the whole would be this
// factor more work.
constexpr double max_factor_in_group = 3.0, min_saving = 1.5;

// A connected part of the scene.
struct IslandPart {
  int substeps = 1;  // of the default method, for stability
  Index first = 0;   // its point with the smallest index
  Index points = 0, springs = 0;
};

// The smallest index of the points that each point is connected with.
std::vector<Index> find_parts(const Plan& plan) {
  DisjointSets sets(static_cast<std::size_t>(plan.points));
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) sets.join(run.first + e, run.second + e);
  std::vector<Index> root(static_cast<std::size_t>(plan.points));
  for (Index i = 0; i < plan.points; ++i) root[i] = sets.root(i);
  return root;
}

// The parts, by ascending substeps; `root` as of find_parts.
std::vector<IslandPart> measure_parts(const Plan& plan, const System& system, const std::vector<Index>& root, double frame_rate) {
  const auto count = static_cast<std::size_t>(plan.points);
  const SpectrumRows rows = spectrum_rows(system);
  std::vector<IslandPart> part_at(count);
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) ++part_at[root[run.first + e]].springs;
  std::vector<Spectrum> spectrum_at(count, plan.spectrum);
  for (Spectrum& spectrum : spectrum_at) spectrum.omega = spectrum.dashpot_rate = 0.0;
  for (Index i = 0; i < plan.points; ++i) {
    Spectrum& spectrum = spectrum_at[root[i]];
    spectrum.omega = std::max(spectrum.omega, std::sqrt(rows.stiffness[plan.listed_index(i)]));
    spectrum.dashpot_rate = std::max(spectrum.dashpot_rate, rows.dashpot[plan.listed_index(i)]);
    ++part_at[root[i]].points;
  }
  std::vector<IslandPart> parts;
  for (Index i = 0; i < plan.points; ++i) {
    if (root[i] != i) continue;
    part_at[i].first = i;
    part_at[i].substeps = stable_substeps(default_integrator(), spectrum_at[i], frame_rate);
    parts.push_back(part_at[i]);
  }
  std::ranges::sort(parts, {}, [](const IslandPart& part) { return std::pair(part.substeps, part.first); });
  return parts;
}

// Work of a frame, in springs and substeps: as the model of the cost weights them.
double work_of(double substeps, double points, double springs) { return substeps * (springs + 0.15 * points + 30.0); }

void add_counts(const Motion& part, Motion& sum) {
  sum.counts.force_evaluations += part.counts.force_evaluations;
  sum.counts.factorizations += part.counts.factorizations;
  sum.counts.solves += part.counts.solves;
  sum.counts.sweeps += part.counts.sweeps;
  sum.counts.dashpot_sweeps += part.counts.dashpot_sweeps;
  sum.counts.limit_sweeps += part.counts.limit_sweeps;
  sum.counts.unconverged_solves += part.counts.unconverged_solves;
  sum.crossings += part.crossings;
  sum.collider_work += part.collider_work;
  sum.break_work += part.break_work;
  sum.limit_work += part.limit_work;
  sum.limit_gain += part.limit_gain;
  sum.contact_work += part.contact_work;
  sum.hand_work += part.hand_work;
  sum.abs_hand_work += part.abs_hand_work;
  sum.force_work += part.force_work;
  sum.reversible_work += part.reversible_work;
}

// The group of each point of the System, in ascending order of the substeps that its part requires. Empty where nothing would be saved: the
// scene is stepped as a whole. `root` as of find_parts.
std::vector<int> find_island_groups(const Plan& plan, const System& system, const std::vector<Index>& root, double frame_rate) {
  const std::vector<IslandPart> parts = measure_parts(plan, system, root, frame_rate);
  if (parts.size() < 2) return {};

  std::vector<int> group_at(static_cast<std::size_t>(plan.points), 0);  // of a part, at its first point
  int group = -1, slowest = 0;
  double divided = 0.0;  // work
  Index points = 0, springs = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const bool begins = group < 0 || parts[p].substeps > max_factor_in_group * slowest;
    if (begins && group + 1 < static_cast<int>(IslandStepsList::max_size)) {
      ++group;
      slowest = parts[p].substeps;
      points = springs = 0;
    }
    group_at[parts[p].first] = group;
    points += parts[p].points;
    springs += parts[p].springs;
    const bool is_last = p + 1 == parts.size() || parts[p + 1].substeps > max_factor_in_group * slowest;
    if (is_last) divided += work_of(parts[p].substeps, points, springs);
  }
  if (work_of(parts.back().substeps, plan.points, plan.springs) < min_saving * divided) return {};
  std::vector<int> group_of_point(static_cast<std::size_t>(plan.points));
  for (Index i = 0; i < plan.points; ++i) group_of_point[plan.listed_index(i)] = group_at[root[i]];
  return group_of_point;
}

}  // namespace

bool IslandFrames::divide(const Plan& plan, const System& system, double frame_rate) {
  const bool may_interact =
      plan.touches_itself() || plan.hand.held || plan.hand.pull || plan.collider_paths.grabbed || !plan.forces.empty();
  if (may_interact || !plan.spring.break_length.empty() || plan.points < 2) return false;
  const bool has_same_structure =
      plan.points == points_ && plan.dimensions == dimensions_ && plan.spring.runs == runs_ && plan.numbering.index == point_index_;
  if (has_same_structure && is_connected_) return false;
  const double rates = rates_of(plan);
  const bool has_same_field = plan.gravity == gravity_ && plan.drag == drag_ && frame_rate == frame_rate_;
  if (has_same_structure && has_same_field && rates == rates_ && system.colliders == colliders_) return !groups_.empty();

  if (!has_same_structure) {
    root_ = find_parts(plan);
    is_connected_ = std::ranges::all_of(root_, [](Index first) { return first == 0; });
    points_ = plan.points;
    dimensions_ = plan.dimensions;
    runs_ = plan.spring.runs;
    point_index_ = plan.numbering.index;
  }
  rates_ = rates;
  gravity_ = plan.gravity;
  drag_ = plan.drag;
  frame_rate_ = frame_rate;
  colliders_ = system.colliders;
  rebuild(system, find_island_groups(plan, system, root_, frame_rate));
  return !groups_.empty();
}

void IslandFrames::rebuild(const System& system, std::span<const int> group_of_point) {
  past_trial_cost_ = trial_cost();
  groups_.clear();
  if (group_of_point.empty()) return;
  System common = system;  // without points and springs
  common.faces.clear();
  common.set_springs({});
  common.set_points({});
  common.scripted_hand.reset();
  const auto count = static_cast<std::size_t>(1 + *std::ranges::max_element(group_of_point));
  std::vector<std::vector<Point>> points(count);
  std::vector<std::vector<Spring>> springs(count);
  groups_.resize(count);
  for (Index i = 0; i < system.point_count(); ++i) {
    const auto g = static_cast<std::size_t>(group_of_point[i]);
    groups_[g].points.push_back(i);
    points[g].push_back(system.points()[i]);
  }
  for (const Spring& spring : system.springs())
    springs[static_cast<std::size_t>(group_of_point[system.index_of(spring.first)])].push_back(spring);
  double sum = 0.0;
  for (std::size_t g = 0; g < count; ++g) {
    Group& group = groups_[g];
    group.system = common;
    group.system.set_points(std::move(points[g]));
    group.system.set_springs(std::move(springs[g]));
    group.plan = make_plan(group.system);
    const int substeps = stable_substeps(default_integrator(), group.plan.spectrum, frame_rate_);
    group.expected_cost = CostModel(group.plan).expected(default_integrator(), substeps);
    sum += group.expected_cost;
  }
  for (Group& group : groups_) group.expected_cost /= sum;
}

void IslandFrames::begin(const Settings& settings, const State& state, MethodMemory& memory) {
  next_ = 0;
  failure_ = StepFailure::None;
  const bool is_chosen = settings.islands.empty();
  memory.islands.clear();
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    Group& group = groups_[g];
    State& own = group.state;
    own.time = state.time;
    own.position.resize(group.points.size());
    own.velocity.resize(group.points.size());
    for (std::size_t i = 0; i < group.points.size(); ++i) {
      own.position[i] = state.position[group.points[i]];
      own.velocity[i] = state.velocity[group.points[i]];
    }
    own.memory = {};
    if (is_chosen && state.memory.islands.size() == groups_.size()) own.memory.choice = state.memory.islands[g];

    Settings steps = settings;
    steps.islands.clear();
    steps.budget_ms *= group.expected_cost;
    if (!is_chosen) {
      steps.integrator = settings.islands[g].integrator;
      steps.substeps = settings.islands[g].substeps;
    }
    group.frame.begin(group.plan, group.system, steps, own);
    if (is_chosen) memory.islands.push_back(*group.frame.motion().memory.choice);
  }
  memory.choice.reset();
  if (!is_chosen) return;
  // of the scene: that of the group that costs the most, with the cost of all and the largest error
  const auto cost_of = [](const MethodChoice& choice) { return choice.cost; };
  memory.choice = *std::ranges::max_element(memory.islands, {}, cost_of);
  memory.choice->cost = 0.0;
  memory.choice->budget = settings.budget_ms;
  for (const MethodChoice& choice : memory.islands) {
    memory.choice->cost += choice.cost;
    memory.choice->ratio = std::max(memory.choice->ratio, choice.ratio);
  }
}

void IslandFrames::substep() {
  Group& group = groups_[next_];
  // a frame that was computed to choose is complete
  if (!group.frame.done()) group.frame.substep(group.plan);
  failure_ = group.frame.failure();
  if (group.frame.done()) ++next_;
}

bool IslandFrames::has_touched() const {
  return std::ranges::any_of(groups_, [](const Group& group) { return group.frame.has_touched(); });
}

void IslandFrames::end(const Plan& plan, Motion& motion) {
  double squared_error = 0.0;
  for (Group& group : groups_) {
    group.frame.end(group.plan, group.state);
    for (std::size_t i = 0; i < group.points.size(); ++i)
      for (int c = 0; c < plan.dimensions; ++c) {
        const std::size_t at =
            static_cast<std::size_t>(c) * static_cast<std::size_t>(plan.points) + static_cast<std::size_t>(plan.number_of(group.points[i]));
        motion.x[at] = group.state.position[i][c];
        motion.v[at] = group.state.velocity[i][c];
      }
    add_counts(group.frame.motion(), motion);
    const double error = group.frame.motion().local_error;
    squared_error += static_cast<double>(group.points.size()) * error * error;
  }
  motion.local_error = std::sqrt(squared_error / static_cast<double>(plan.points));
  motion.acceleration_is_current = false;
}

double IslandFrames::cost() const {
  double sum = 0.0;
  for (const Group& group : groups_) sum += group.frame.cost(group.plan);
  return sum;
}

double IslandFrames::trial_cost() const {
  double sum = past_trial_cost_;
  for (const Group& group : groups_) sum += group.frame.trial_cost();
  return sum;
}

}  // namespace hooke
