#include "sim/plan/plan.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "sim/model/grab.h"
#include "sim/model/state.h"
#include "sim/plan/constants.h"

namespace hooke {
namespace {

struct Ends {
  Index first, second, spring;
};

// By a key from 0 to limit - 1; those of the same key stay in their order.
template <class Key>
void sort_by(std::vector<Ends>& ends, Index limit, const Key& key) {
  std::vector<std::size_t> next(static_cast<std::size_t>(limit) + 1, 0);
  for (const Ends& each : ends) ++next[static_cast<std::size_t>(key(each)) + 1];
  for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
  std::vector<Ends> sorted(ends.size());
  for (const Ends& each : ends) sorted[next[static_cast<std::size_t>(key(each))]++] = each;
  ends = std::move(sorted);
}

// Consecutive springs with consecutive ends form a run. `spring_index`: the spring of each packed one.
void find_runs(const System& system, std::vector<SpringRun>& runs, std::vector<Index>& spring_index) {
  std::vector<Ends> ends;
  ends.reserve(system.springs().size());
  Index points = 0;
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    ends.push_back({std::min(i, j), std::max(i, j), static_cast<Index>(ends.size())});
    points = std::max(points, ends.back().second + 1);
  }

  // sorted by offset, then index, springs form runs; sorted by the index of their first spring, the runs are in the order of the points, so
  // that neighboring runs find their points in the cache
  sort_by(ends, points, [](const Ends& each) { return each.first; });
  sort_by(ends, points, [](const Ends& each) { return each.second - each.first; });
  struct Found {
    std::size_t begin;
    Index count;
  };
  std::vector<Found> found;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    // split into some hundred springs, so that runs along the whole scene do not evict the cache for each direction
    const bool continues = !found.empty() && found.back().count < max_run_length && ends[e].first == ends[e - 1].first + 1 &&
                           ends[e].second == ends[e - 1].second + 1;
    if (continues)
      ++found.back().count;
    else
      found.push_back({e, 1});
  }
  std::stable_sort(found.begin(), found.end(), [&](const Found& a, const Found& b) { return ends[a.begin].first < ends[b.begin].first; });

  runs.clear();
  spring_index.clear();
  spring_index.reserve(ends.size());
  for (const Found& run : found) {
    runs.push_back({static_cast<Index>(spring_index.size()), ends[run.begin].first, ends[run.begin].second, run.count});
    for (Index e = 0; e < run.count; ++e) spring_index.push_back(ends[run.begin + e].spring);
  }
}

// Restricts a collider to points in the plane z = 0: spheres move into the plane, planes and boxes become perpendicular to it, and
// all motion is within it. False if a plane is parallel to it: it is not a collider there.
bool flatten(Collider& collider) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ColliderPath& path = collider.path;
  path.amplitude.z = path.belt.z = path.spin.x = path.spin.y = 0.0;
  if (auto* plane = std::get_if<Plane>(&collider.shape)) {
    plane->point.z = plane->normal.z = 0.0;
    plane->normal /= std::max(glm::length(plane->normal), std::numeric_limits<double>::min());
    return plane->normal != Vec3(0.0);
  }
  if (auto* sphere = std::get_if<Sphere>(&collider.shape)) sphere->center.z = 0.0;
  if (auto* box = std::get_if<Box>(&collider.shape)) {
    box->min.z = -infinity;
    box->max.z = infinity;
  }
  return true;
}

void plan_colliders(Plan& plan, const System& system) {
  plan.colliders.clear();
  plan.one_way.clear();
  plan.collider_paths.index.clear();
  plan.collider_paths.any_moves = false;
  plan.collider_paths.resolving_step = std::numeric_limits<double>::infinity();
  plan.collider_paths.grabbed.reset();
  for (std::size_t c = 0; c < system.colliders.size(); ++c) {
    Collider collider = system.colliders[c];
    if (!collider.solid || (plan.dimensions == 2 && !flatten(collider))) continue;
    if (collider.one_way && !collider.path.moves() && std::holds_alternative<Plane>(collider.shape)) {
      plan.one_way.push_back(collider);
      continue;
    }
    plan.collider_paths.any_moves = plan.collider_paths.any_moves || collider.path.moves();
    plan.collider_paths.resolving_step = std::min(plan.collider_paths.resolving_step, collider.path.resolving_step());
    plan.colliders.push_back(collider);
    plan.collider_paths.index.push_back(static_cast<Index>(c));
  }
}

// Moves the carried collider to its position under the hand, and towards its target during the coming frame.
void plan_carried_collider(Plan& plan, const System& system, const State& state, double duration) {
  const CarriedCollider& carried = *state.hand.collider;
  const auto planned = std::ranges::find(plan.collider_paths.index, carried.collider);
  if (planned == plan.collider_paths.index.end()) return;
  const auto c = static_cast<std::size_t>(planned - plan.collider_paths.index.begin());
  plan.colliders[c] = carried_collider(system, state, static_cast<std::size_t>(carried.collider));
  if (plan.dimensions == 2) flatten(plan.colliders[c]);
  plan.collider_paths.any_moves = true;

  const Vec3 anchor = anchor_of(carried.shape);
  Vec3 velocity = (clamp_hand_target(system, anchor, carried.target, duration) - anchor) / duration;
  if (plan.dimensions == 2) velocity.z = 0.0;
  plan.collider_paths.grabbed = {.collider = c, .start = state.time, .velocity = velocity};
}

// The lengths at which springs break and those of the strain limit; empty if there are none.
void plan_length_limits(Plan& plan, const System& system) {
  plan.spring.break_length.resize(system.any_spring_breaks() ? plan.springs : 0);
  plan.spring.max_length.resize(system.strain_limit > 0.0 ? plan.springs : 0);
  for (Index s = 0; s < static_cast<Index>(plan.spring.break_length.size()); ++s)
    plan.spring.break_length[s] = system.break_length_of(system.springs()[plan.spring.index[s]]);
  // a spring that is switched off, or has no rest length, has no limit
  for (Index s = 0; s < static_cast<Index>(plan.spring.max_length.size()); ++s) {
    const Spring& spring = system.springs()[plan.spring.index[s]];
    const bool holds = system.is_on(spring) && spring.rest_length > 0.0;
    plan.spring.max_length[s] = holds ? spring.rest_length * (1.0 + system.strain_limit) : never_breaks;
  }
}

// What the contact of rollers needs, after masses, nails or the held point have changed.
void refresh_rollers(Plan& plan) {
  RollerPlan& rollers = plan.force_data.rollers;
  if (rollers.empty()) return;
  rollers.inverse_pushed = plan.inverse_mass;
  for (std::size_t at = 0; at < rollers.fixed.size(); ++at)
    if (rollers.fixed[at] != 0) rollers.inverse_pushed[at % static_cast<std::size_t>(plan.points)] = 0.0;
}

void plan_rollers(Plan& plan, const System& system) {
  std::vector<std::uint8_t>& fixed = plan.force_data.rollers.fixed;
  const bool has_rollers = std::ranges::any_of(system.points(), [](const Point& point) { return point.fixed_axes != 0 && !point.nailed; });
  fixed.assign(has_rollers ? system.points().size() * static_cast<std::size_t>(plan.dimensions) : 0, 0);
  for (std::size_t at = 0; at < fixed.size(); ++at) {
    const Point& point = system.points()[at % system.points().size()];
    fixed[at] = !point.nailed && point.is_fixed_along(static_cast<int>(at / system.points().size())) ? 1 : 0;
  }
}

// Whether it is planned as a spring with a law (LawSpring).
bool has_law(const Plan& plan, const System& system, const Spring& spring) {
  const auto is_roller = [&](PointId id) { return system.points()[system.index_of(id)].fixed_axes != 0; };
  return spring.law || (!plan.force_data.rollers.empty() && (is_roller(spring.first) || is_roller(spring.second)));
}

// The springs with a law, into a plan that has its runs and its rollers.
void plan_laws(Plan& plan, const System& system) {
  LawSprings& laws = plan.spring.laws;
  laws = {.clock = system.muscles};
  if (!system.springs().have_laws() && plan.force_data.rollers.empty()) return;
  laws.of_packed.assign(plan.springs, no_index);
  for_each_spring(plan, [&](Index i, Index j, Index s) {
    const Spring spring = system.springs()[plan.spring.index[s]];
    if (!has_law(plan, system, spring)) return;
    laws.of_packed[s] = static_cast<Index>(laws.springs.size());
    laws.springs.push_back({.first = i,
                            .second = j,
                            .law = spring.law.value_or(SpringLaw{}),
                            .stiffness = system.stiffness_of(spring),
                            .damping = system.damping_of(spring),
                            .rest_length = spring.rest_length});
    laws.move = laws.move || (laws.springs.back().law.moves() && system.muscles.rate() != 0.0);
    laws.resolving_step = std::min(laws.resolving_step, laws.springs.back().law.resolving_step(system.muscles.rate()));
  });
  if (laws.springs.empty()) laws = {};
}

// The forces that are on, and the faces if there are any such forces.
void plan_forces(Plan& plan, const System& system) {
  plan.forces.clear();
  std::ranges::copy_if(system.forces, std::back_inserter(plan.forces), &Force::on);
  plan.force_data.load.clear();
  for (Index i = 0; i < system.point_count(); ++i)
    if (const Vec3& load = system.points()[i].load; load != Vec3(0.0)) plan.force_data.load.emplace_back(i, load);
  if (!plan.force_data.load.empty()) plan.forces.push_back({.term = &load_force});
  if (!plan.force_data.rollers.empty()) plan.forces.push_back({.term = &roller_force});
  std::ranges::stable_sort(plan.forces, {}, [](const Force& force) { return force.term->rank; });
  plan.force_data.depend_on_velocity = std::ranges::any_of(plan.forces, &Force::depends_on_velocity);

  plan.force_data.faces = 0;
  plan.force_data.panels.clear();
  plan.force_data.panel_rows.clear();
  plan.force_data.hinges = {};
  plan.force_data.enclosures = {};
  plan.force_data.sticky.strength = 0.0;
  plan.force_data.center = system.center_point ? system.index_of(*system.center_point) : no_index;
  if (plan.forces.empty()) return;
  plan.force_data.faces = system.faces.size();
  for (const Force& force : plan.forces)
    if (force.term->prepare != nullptr) force.term->prepare(system, plan);
}

PlannedPull plan_pull(const System& system, const Grab& grab) {
  PlannedPull pull{.stiffness = grab.stiffness};
  pull.parts[0].point = system.index_of(grab.point);
  if (!grab.patch) return pull;
  pull.count = 3;
  for (std::size_t p = 0; p < 3; ++p) pull.parts[p] = {system.index_of(grab.patch->points[p]), grab.patch->weights[p]};
  return pull;
}

// Releases the held point, and holds this one.
void set_held_point(Plan& plan, const System& system, std::optional<Index> point) {
  const auto held_point = [&]() -> const Point& { return system.points()[*plan.hand.held]; };
  if (plan.hand.held) plan.inverse_mass[*plan.hand.held] = held_point().nailed ? 0.0 : 1.0 / held_point().mass;
  plan.hand.held = point;
  plan.hand.held_springs.clear();
  if (plan.hand.held) plan.inverse_mass[*plan.hand.held] = 0.0;
  refresh_rollers(plan);
  if (!plan.hand.held) return;
  plan.hand.held_mass = held_point().nailed ? 0.0 : held_point().mass;
  for (const SpringRun& run : plan.spring.runs)
    for (const auto& [held_end, other_end] : {std::pair{run.first, run.second}, std::pair{run.second, run.first}})
      if (const Index e = *plan.hand.held - held_end; e >= 0 && e < run.count)
        plan.hand.held_springs.push_back({run.begin + e, other_end + e});
}

}  // namespace

PairPlan plan_pairs(const System& system) {
  const PairContact& contact = system.contact;
  if (!contact.points) return {};
  PairPlan plan{.on = true, .thickness = contact.thickness, .restitution = contact.restitution, .friction = contact.friction, .joined = {}};
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const double touching = system.points()[i].radius + system.points()[j].radius + contact.thickness;
    // placed at the distance at which they touch, up to rounding, is touching
    if (spring.rest_length <= touching * (1.0 + 1e-9)) plan.joined.push_back(edge_ends(i, j));
  }
  std::ranges::sort(plan.joined);
  return plan;
}

Plan make_plan(const System& system) {
  Plan plan;
  plan.points = system.point_count();
  plan.springs = system.spring_count();
  find_runs(system, plan.spring.runs, plan.spring.index);
  if (plan.springs >= min_springs_of_grids)
    plan.spring.grids = find_grids(plan.spring.runs, plan.points, plan.spring.loose_runs);
  else
    plan.spring.loose_runs = plan.spring.runs;
  refresh_values(plan, system);
  return plan;
}

void refresh_values(Plan& plan, const System& system) {
  plan.dimensions = system.dimensions;
  plan.drag = system.drag_rate();
  plan.gravity = system.gravity;
  plan.acceleration = system.gravity + plan.drag * system.wind;

  plan.hand.held.reset();
  plan.hand.pull.reset();

  plan.mass.resize(plan.points);
  plan.inverse_mass.resize(plan.points);
  for (Index i = 0; i < plan.points; ++i) {
    const Point& point = system.points()[i];
    plan.mass[i] = point.mass;
    plan.inverse_mass[i] = point.nailed ? 0.0 : 1.0 / point.mass;
  }
  plan_rollers(plan, system);
  if (system.grab && system.grab->kind == GrabKind::Hold)
    set_held_point(plan, system, system.index_of(system.grab->point));
  else
    set_held_point(plan, system, std::nullopt);
  if (system.grab && system.grab->kind == GrabKind::Pull) plan.hand.pull = plan_pull(system, *system.grab);

  plan.spring.stiffness.resize(plan.springs);
  plan.spring.rest_length.resize(plan.springs);
  bool damped = false;
  for (Index s = 0; s < plan.springs; ++s) {
    const Spring& spring = system.springs()[plan.spring.index[s]];
    plan.spring.stiffness[s] = has_law(plan, system, spring) ? 0.0 : system.stiffness_of(spring);
    plan.spring.rest_length[s] = spring.rest_length;
    damped = damped || system.damping_of(spring) > 0.0;
  }
  plan.spring.damping.assign(damped ? plan.springs : 0, 0.0);
  for (Index s = 0; s < static_cast<Index>(plan.spring.damping.size()); ++s)
    if (const Spring spring = system.springs()[plan.spring.index[s]]; !has_law(plan, system, spring))
      plan.spring.damping[s] = system.damping_of(spring);
  plan_laws(plan, system);

  plan_length_limits(plan, system);
  refresh_grids(plan);
  plan_colliders(plan, system);
  plan.pairs = plan_pairs(system);
  plan.surface = plan_surface(system);
  plan_forces(plan, system);
  plan.spectrum = bound_spectrum(system, plan, 0.0);
  plan.radius.clear();
  if (plan.has_contact() || !plan.forces.empty())
    for (const Point& point : system.points()) plan.radius.push_back(point.radius);
}

void refresh_grids(Plan& plan) {
  for (Grid& grid : plan.spring.grids) {
    set_values(grid, plan.spring.rest_length, false, grid.rest_length);
    grid.damping = {};
  }
  refresh_grid_stiffness(plan);
}

void refresh_grid_stiffness(Plan& plan) {
  const bool may_break = !plan.spring.break_length.empty();
  for (Grid& grid : plan.spring.grids) {
    set_values(grid, plan.spring.stiffness, may_break, grid.stiffness);
    if (plan.has_dashpots()) set_values(grid, plan.spring.damping, may_break, grid.damping);
  }
}

Vec3 clamp_hand_target(const System& system, const Vec3& from, const Vec3& target, double duration) {
  const Vec3 displacement = target - from;
  const double length = glm::length(displacement), max = system.hand_speed * duration;
  return system.hand_speed > 0.0 && length > max ? from + max / length * displacement : target;
}

void prepare_hand(Plan& plan, const System& system, const State& state, double duration) {
  // a scripted hand grabs and releases its point between frames
  const std::optional<ActiveGrab> grab = active_grab(system, state, duration);
  std::optional<Index> held;
  if (grab && grab->kind == GrabKind::Hold) held = system.index_of(grab->point);
  if (plan.hand.held != held) set_held_point(plan, system, held);

  if (plan.hand.pull) {
    plan.hand.pull->start = state.time;
    const Vec3& from = state.hand.position;
    plan.hand.pull->from = from;
    plan.hand.pull->velocity = (clamp_hand_target(system, from, state.hand.target, duration) - from) / duration;
  }
  plan.collider_paths.grabbed.reset();
  if (state.hand.collider) plan_carried_collider(plan, system, state, duration);
}

Spectrum bound_spectrum(const System& system, double point_speed) {
  Plan prepared;
  plan_forces(prepared, system);
  if (system.grab && system.grab->kind == GrabKind::Pull) prepared.hand.pull = plan_pull(system, *system.grab);
  return bound_spectrum(system, prepared, point_speed);
}

Vec3 Plan::offset_of(std::size_t collider, double time) const {
  const Vec3 offset = colliders[collider].path.offset(time);
  const std::optional<GrabbedCollider>& grabbed = collider_paths.grabbed;
  return grabbed && grabbed->collider == collider ? offset + (time - grabbed->start) * grabbed->velocity : offset;
}

Vec3 Plan::velocity_of(std::size_t collider, double time) const {
  const Vec3 velocity = colliders[collider].path.velocity(time);
  const std::optional<GrabbedCollider>& grabbed = collider_paths.grabbed;
  return grabbed && grabbed->collider == collider ? velocity + grabbed->velocity : velocity;
}

}  // namespace hooke
