// What an optional force of a scene is: the kind of a row in the table of forces (forces/force_terms.h), and its values in a scene.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "base/bounds.h"
#include "base/types.h"

namespace hooke {

class ForceTangent;
class System;
struct Passage;
struct PassingPoint;
struct Plan;

// One of the values of a parameter that is not a number.
struct ForceChoice {
  std::string_view id;     // in files
  std::string_view label;  // in the panel
};

// A parameter of a force.
struct ForceParameter {
  std::string_view name;   // in files
  std::string_view label;  // on the slider
  std::string_view unit;
  double min, max, default_value;
  bool integer = false;
  std::span<const ForceChoice> choices{};  // then the value is an index of these
  // In files and commands: values beyond would drown masses in rounding.
  double max_valid = std::numeric_limits<double>::infinity();

  // Values outside the range of the slider are valid.
  Bounds valid() const { return min >= 0.0 ? Bounds{.min = min, .max = max_valid} : any_number; }
};

inline constexpr std::size_t max_force_parameters = 8;
using ForceValues = std::array<double, max_force_parameters>;  // one for each parameter of the row, in its order

// Upper bounds over all positions and velocities; infinity where there is none. Then there is an estimate, for stability limits and the
// energy balance: near the rest lengths, in air at its full speed against that of the points, and 1 m from a center.
struct ForceBound {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double stiffness = 0.0;     // [1/s^2], on the eigenvalues of M^-1/2 (df/dx) M^-1/2, in magnitude
  double rate = 0.0;          // [1/s], on those of M^-1/2 (df/dv) M^-1/2
  double acceleration = 0.0;  // [m/s^2], that can drive points away; an attraction that grows with distance does not count
  double speed = 0.0;         // [m/s], the speed towards which points are driven, for example by moving air
  double estimated_stiffness = 0.0, estimated_rate = 0.0;  // [1/s^2], [1/s], where there is no bound
  double omitted_stiffness = 0.0;  // [1/s^2], bound or estimate of the part of the stiffness that add_tangent leaves out
};

// [ns], by the model of the cost (control/cost_model.h), for each point or, of forces on faces, for each face: of an evaluation, and of
// what is computed in a substep for the energy that it supplies.
struct ForceCost {
  double evaluation = 1.0, energy = 8.0;
  bool of_faces = false;
};

struct ForceTerm {
  std::string_view id;                         // in files
  int rank = std::numeric_limits<int>::max();  // forces act in ascending order: `sticky` balances the sum of all others
  std::string_view label;                      // in the panel
  std::string_view description;                // one sentence
  std::span<const ForceParameter> numbers;
  bool depends_on_velocity = false;
  bool is_continuous = true;  // in x and v; false: Newton iterations freeze it after some iterations
  // Adds the force [N] to f at `time` [s], positions x [m] and velocities v [m/s], all in the layout of the Plan. `f` already contains
  // gravity, springs, dashpots, the pull of the hand, and the forces of the rows above.
  void (*add)(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f);
  // The plan is prepared as by `prepare`, whatever else it contains. `point_speed` [m/s], of the fastest point: only estimates depend on
  // it.
  ForceBound (*bound)(const System& system, const Plan& prepared, const ForceValues& values, double point_speed);
  // Adds the derivatives of the force for implicit methods. Null: zero, or not continuous.
  void (*add_tangent)(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v,
                      ForceTangent& tangent) = nullptr;
  // [J], of the conservative part of the force, or of the whole force if there is no `power`. Null: not conservative, or does no work.
  double (*potential)(const Plan& plan, const ForceValues& values, double time, const double* x) = nullptr;
  // [W], of the other part. Null: zero.
  double (*power)(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v) = nullptr;
  // Adds the force as `add` does, and returns what `power` does. Null: one after the other.
  double (*add_with_power)(const Plan& plan, const ForceValues& values, double time, const double* x, const double* v, double* f) = nullptr;
  // Whether it depends on the velocity with these values. Null: always, if depends_on_velocity.
  bool (*is_damped)(const ForceValues& values) = nullptr;
  // Whether it depends on the time with these values, other than by colliders that move. Null: no, of forces with a potential.
  bool (*depends_on_time)(const ForceValues& values) = nullptr;
  // Null: that of a force that is constant or linear in the position of its point.
  ForceCost (*cost)(const Plan& plan, const ForceValues& values) = nullptr;
  // [J/kg], the potential of a point at this place. Null: it does not depend on the place alone.
  double (*potential_at)(const System& system, const ForceValues& values, const Vec3& place) = nullptr;
  // The passage of a point through a small region in which the force is strongest (passage.h). Null: there is none.
  Passage (*passage)(const ForceValues& values, const PassingPoint& point) = nullptr;
  // Packs into the Plan, which has the points and faces, what else it needs of the System. Null: nothing.
  void (*prepare)(const System& system, Plan& plan) = nullptr;
};

// A force of a scene.
struct Force {
  const ForceTerm* term = nullptr;
  bool on = true;
  ForceValues values{};
  bool depends_on_velocity() const { return term->depends_on_velocity && (term->is_damped == nullptr || term->is_damped(values)); }
  bool operator==(const Force&) const = default;
};

}  // namespace hooke
