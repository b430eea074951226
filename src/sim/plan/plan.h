// The System compiled for stepping: only what this scene needs, packed for the vector units. Its structure (which
// springs join which points) is rebuilt on edits, its values are updated in place; neither happens inside a step.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sim/model/system.h"
#include "sim/plan/constants.h"
#include "sim/plan/enclosures.h"
#include "sim/plan/execution.h"
#include "sim/plan/grid.h"
#include "sim/plan/hinges.h"
#include "sim/plan/surface_plan.h"

namespace hooke {

struct State;

// One vector per point, component by component: component c of point i is at [c * points + i].
using Field = std::vector<double>;

// `count` consecutive springs that connect point first + e to point second + e, e = 0 .. count-1. A grid consists of a few long runs (one
// for each row and direction), whose ends are read and written as whole vectors; any other graph consists of short runs. Spring e of the
// run has the packed index begin + e.
struct SpringRun {
  Index begin = 0, first = 0, second = 0, count = 0;
  bool operator==(const SpringRun&) const = default;
};

// The hand's spring, attached to a point or to the weighted mean of three; each takes its weight of the force. The other end moves
// from `from` with `velocity` during the frame that starts at `start`.
struct PlannedPull {
  struct Part {
    Index point = no_index;
    double weight = 1.0;
  };
  std::array<Part, 3> parts{};
  int count = 1;
  double stiffness = 0.0;
  double start = 0.0;  // [s]
  Vec3 from{0.0}, velocity{0.0};
  Vec3 target_at(double time) const { return from + (time - start) * velocity; }
  std::span<const Part> points() const { return {parts.data(), static_cast<std::size_t>(count)}; }
};

// `cells` quads, from the panel `first` on,
//   (i, j, j+1, i+1)
// with i and j one larger than in the one before: as in a cloth.
struct PanelRow {
  Index first = 0, cells = 0;
};

// A spring on the held point.
struct HeldSpring {
  Index spring = 0;  // packed
  Index other = 0;   // point at its other end
};

// The collider that the hand holds during the frame that starts at `start`: it moves with `velocity` in addition to its path.
struct GrabbedCollider {
  std::size_t collider = 0;  // of the plan's
  double start = 0.0;        // [s]
  Vec3 velocity{0.0};        // [m/s]
};

// Upper bounds on the fastest rates of the scene, for any deformation.
struct Spectrum {
  double omega = 0.0;              // [rad/s], highest undamped frequency, of springs, the hand's pull and listed forces
  double dashpot_rate = 0.0;       // [1/s], highest rate of the dashpots
  double force_omega = 0.0;        // [rad/s], highest frequency of the listed forces alone
  double force_rate = 0.0;         // [1/s], highest rate of the listed forces that depend on velocity
  bool is_bounded = true;          // false: there is a listed force without a bound, which is not counted
  double drag_rate = 0.0;          // [1/s]
  double min_dashpot_ratio = 0.0;  // [s], minimum of damping / stiffness over the springs
  bool contact = false;            // whether there are solid colliders, or anything touches
  bool points_touch = false;       // whether points touch each other
  // Of the listed forces, for stability limits and the energy balance: estimates where there is no bound [rad/s], [1/s]; and the highest
  // frequency of the derivatives that implicit methods leave out [rad/s].
  double estimated_omega = 0.0, estimated_rate = 0.0, omitted_omega = 0.0;
  double force_acceleration = 0.0, force_speed = 0.0;  // [m/s^2], [m/s], by which listed forces drive points (ForceBound)
  bool operator==(const Spectrum&) const = default;
};

// A point that touches a plane.
struct StickyContact {
  Index point, collider;
  bool operator==(const StickyContact&) const = default;
};
// Planes that hold points (forces/terms/sticky.cpp).
struct StickyPlan {
  double strength = 0.0;            // [N]; 0: none does
  std::vector<StickyContact> held;  // during the step in progress (forces/terms/sticking.h)
};

// Points that do not move along some axes. A held one moves with the hand.
struct RollerPlan {
  std::vector<std::uint8_t> fixed;     // per component of a field: 1 where a point does not move; empty: there are no rollers
  std::vector<double> inverse_pushed;  // [1/kg], per point: Plan::inverse_mass, but 0 of rollers
  bool empty() const { return fixed.empty(); }
};

// A spring with a law, whose rest length moves, or on a roller. Among the packed springs, it has no stiffness and no damping.
struct LawSpring {
  Index first = 0, second = 0;
  SpringLaw law;
  double stiffness = 0.0, damping = 0.0, rest_length = 0.0;  // k, d and l0; k and d 0: it is broken or switched off
  bool acts() const { return stiffness > 0.0 || damping > 0.0; }
};
struct LawSprings {
  std::vector<LawSpring> springs;  // in the order of the packed springs
  std::vector<Index> of_packed;    // of a packed spring; no_index: it has no law; empty: none has
  MuscleClock clock;
  bool move = false;  // whether any rest length moves
  // [s], the longest step that resolves the oscillations of the muscles; infinity: none oscillates
  double resolving_step = std::numeric_limits<double>::infinity();
  bool empty() const { return springs.empty(); }
};

// The springs in the order of the runs.
struct PlannedSprings {
  std::vector<SpringRun> runs;
  std::vector<double> stiffness, rest_length;
  std::vector<double> damping;  // empty: no dashpots
  std::vector<Index> index;     // of the packed spring, in the System
  // The same springs for force kernels: those of grids, and the runs of all others.
  std::vector<Grid> grids;
  std::vector<SpringRun> loose_runs;
  std::vector<double> break_length;  // [m], at which the spring breaks; empty: none breaks
  std::vector<double> max_length;    // [m], of the strain limit; empty: no limit
  LawSprings laws;
};

// How the solid colliders move.
struct ColliderPaths {
  std::vector<Index> index;  // of the planned collider, in the System
  bool any_moves = false;    // along its path or with the hand
  // [s], the longest step that resolves the oscillations of the colliders; infinity: none oscillates
  double resolving_step = std::numeric_limits<double>::infinity();
  std::optional<GrabbedCollider> grabbed;
};

// Contact between points.
struct PairPlan {
  bool on = false;
  double thickness = 0.0;                    // [m], added to the sum of two radii
  double restitution = 0.0, friction = 0.0;  // [1]
  // Points joined by a spring that would touch at its rest length, such as neighbors in a cloth: the lower index first, sorted. They do not
  // touch.
  std::vector<EdgeEnds> joined;
  bool excludes(Index i, Index j) const { return std::ranges::binary_search(joined, edge_ends(i, j)); }
};

// What the listed forces need.
struct ForceData {
  bool depend_on_velocity = false;   // whether any of them does
  std::size_t faces = 0;             // 0 without listed forces
  std::vector<Panel<Index>> panels;  // faces and quads; empty without wind
  std::vector<PanelRow> panel_rows;  // in their order
  HingePlan hinges;                  // empty without the bending force
  EnclosurePlan enclosures;          // empty without the pressure force
  StickyPlan sticky;
  RollerPlan rollers;
  Index center = no_index;                   // the point at the center of forces
  std::vector<std::pair<Index, Vec3>> load;  // [N], of points
};

// What the hand pulls or holds.
struct PlannedHand {
  std::optional<PlannedPull> pull;
  std::optional<Index> held;             // the point that it holds
  double held_mass = 0.0;                // [kg], of it; 0 if it is a nail, which has no energy
  std::vector<HeldSpring> held_springs;  // on it; empty without one
};

struct Plan {
  Index points = 0;
  Index springs = 0;
  int dimensions = 3;

  std::vector<double> mass;          // [kg], per point
  std::vector<double> inverse_mass;  // [1/kg], per point; 0 if nailed or held
  Vec3 gravity{0.0};                 // [m/s^2]
  Vec3 acceleration{0.0};            // [m/s^2], of every point: gravity, and drag times wind
  double drag = 0.0;                 // [1/s]

  PlannedSprings spring;

  std::vector<double> radius;       // [m], per point; empty: no contact and no listed forces
  std::vector<Collider> colliders;  // the solid ones, at the start of their paths, without the planes that act one way
  std::vector<Collider> one_way;    // these planes
  ColliderPaths collider_paths;
  PairPlan pairs;             // of points that touch
  SurfacePlan surface;        // of faces and springs that touch
  std::vector<Force> forces;  // those switched on, in the order of the table
  ForceData force_data;
  PlannedHand hand;

  Spectrum spectrum;

  Execution execution;  // set by whoever steps; a new plan is stepped by one thread in double precision

  bool has_contact() const { return !colliders.empty() || !one_way.empty() || touches_itself(); }
  bool touches_itself() const { return pairs.on || surface.on; }
  bool has_dashpots() const { return !spring.damping.empty(); }
  // [s], the longest step that resolves the oscillations of colliders and muscles
  double resolving_step() const { return std::min(collider_paths.resolving_step, spring.laws.resolving_step); }
  // Whether a force balances the sum of all others.
  bool has_balancing_forces() const { return force_data.sticky.strength > 0.0 || !force_data.rollers.empty(); }
  // [1/kg], per point, for contact, which pushes no roller.
  const std::vector<double>& inverse_mass_in_contact() const {
    return force_data.rollers.empty() ? inverse_mass : force_data.rollers.inverse_pushed;
  }

  // Displacement of a collider from its rest position at a time, and its velocity.
  Vec3 offset_of(std::size_t collider, double time) const;
  Vec3 velocity_of(std::size_t collider, double time) const;
};

// The vector of point i in a field; flat in flat scenes.
inline Vec3 vector_at(const Plan& plan, const double* field, Index i) {
  const auto n = static_cast<std::size_t>(plan.points);
  return {field[i], field[n + i], plan.dimensions == 3 ? field[2 * n + i] : 0.0};
}
inline Vec3 vector_at(const Plan& plan, const Field& field, Index i) { return vector_at(plan, field.data(), i); }
// That of point j relative to point i.
inline Vec3 difference_at(const Plan& plan, const Field& field, Index i, Index j) {
  return vector_at(plan, field, j) - vector_at(plan, field, i);
}
// The weighted mean over the points that the hand pulls.
inline Vec3 pulled_mean(const Plan& plan, const Field& field) {
  Vec3 mean(0.0);
  for (const auto& [point, weight] : plan.hand.pull->points()) mean += weight * vector_at(plan, field, point);
  return mean;
}
// [m], of the spring of the hand.
inline Vec3 pull_stretch(const Plan& plan, const Field& x, double time) {
  Vec3 target = plan.hand.pull->target_at(time);
  if (plan.dimensions == 2) target.z = 0.0;
  return pulled_mean(plan, x) - target;
}
inline void add_vector(const Plan& plan, double* field, Index i, const Vec3& vector) {
  for (int c = 0; c < plan.dimensions; ++c) field[static_cast<std::size_t>(c) * plan.points + i] += vector[c];
}
inline void add_vector(const Plan& plan, Field& field, Index i, const Vec3& vector) { add_vector(plan, field.data(), i, vector); }

inline void set_vector(const Plan& plan, Field& field, Index i, const Vec3& vector) {
  for (int c = 0; c < plan.dimensions; ++c) field[static_cast<std::size_t>(c) * plan.points + i] = vector[c];
}

// The vector of point i without what is along its fixed axes; and a field without that of all points.
inline Vec3 free_part(const Plan& plan, Index i, Vec3 vector) {
  const std::vector<std::uint8_t>& fixed = plan.force_data.rollers.fixed;
  for (int c = 0; c < plan.dimensions && !fixed.empty(); ++c)
    if (fixed[static_cast<std::size_t>(c) * plan.points + i] != 0) vector[c] = 0.0;
  return vector;
}
inline void clear_fixed_axes(const Plan& plan, double* field) {
  const std::vector<std::uint8_t>& fixed = plan.force_data.rollers.fixed;
  for (std::size_t at = 0; at < fixed.size(); ++at)
    if (fixed[at] != 0) field[at] = 0.0;
}

// [kg], that a matrix adds to the mass of point i along axis c: where it does not move, so much that the solution there is zero.
inline double fixed_mass(const Plan& plan, Index i, int c) {
  const std::vector<std::uint8_t>& fixed = plan.force_data.rollers.fixed;
  return fixed.empty() || fixed[static_cast<std::size_t>(c) * plan.points + i] == 0 ? 0.0 : fixed_mass_ratio * plan.mass[i];
}

// For the packed springs in their order: use(first point, second point, packed index).
template <class Use>
void for_each_spring(const Plan& plan, const Use& use) {
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e) use(run.first + e, run.second + e, run.begin + e);
}

// Whether test(first point, second point, packed index) is true for any of them.
template <class Test>
bool any_spring(const Plan& plan, const Test& test) {
  for (const SpringRun& run : plan.spring.runs)
    for (Index e = 0; e < run.count; ++e)
      if (test(run.first + e, run.second + e, run.begin + e)) return true;
  return false;
}

// Loads, and the opposite of the sum of all other forces along the fixed axes of rollers (point_forces.cpp).
extern const ForceTerm load_force, roller_force;

// Compiles the structure and the values. O(springs log springs). Points keep their indices.
Plan make_plan(const System& system);
PairPlan plan_pairs(const System& system);

// Updates values (masses, nails, stiffness, damping, rest lengths, forces, colliders) after edits that did not change the lists of points
// and springs. The hand is set by prepare_hand.
void refresh_values(Plan& plan, const System& system);

// Takes over the values of the packed springs into the grids.
void refresh_grids(Plan& plan);
// The same for stiffness and damping alone, after springs have broken. Allocates nothing.
void refresh_grid_stiffness(Plan& plan);

// The position of the hand, or of the anchor of the collider it carries, at the end of a frame of `duration` [s] that starts at `from`: the
// target, or as close to it as System::hand_speed allows.
Vec3 clamp_hand_target(const System& system, const Vec3& from, const Vec3& target, double duration);

// Sets what the hand holds or carries and how it moves during the coming frame of `duration` [s]: in a straight line from
// state.hand.position, or from the anchor of the carried collider, towards the target of the active grab (hand.h).
void prepare_hand(Plan& plan, const System& system, const State& state, double duration);

// An upper bound on the distance of a point from the origin [m] after `time` [s], if the scene started within `extent` [m] of it at a
// maximum speed of `speed` [m/s]: moving at the initial speed, at that of the fastest oscillation, of the air and of the hand, and falling
// all the time. Infinity if a force drives points away without limit. A generous bound that only an unstable run exceeds.
double plausible_reach(const System& system, const Spectrum& spectrum, double extent, double speed, double time);

// Gershgorin bounds on M^-1/2 K M^-1/2 by 3x3 blocks: omega^2 <= max_i sum_j k_ij (1/m_i + 1/sqrt(m_i m_j)), the second
// term absent for a nailed j; the dashpots likewise. `point_speed` [m/s], of the fastest point: for estimates of listed forces.
Spectrum bound_spectrum(const System& system, double point_speed = 0.0);
// `prepared` has the listed forces and the pull of the system.
Spectrum bound_spectrum(const System& system, const Plan& prepared, double point_speed);

}  // namespace hooke
