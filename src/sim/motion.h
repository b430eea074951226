// The State packed for stepping, in the Plan's layout. Lives for one frame; integrators read and write it.
#pragma once

#include <memory>
#include <utility>

#include "sim/plan.h"
#include "sim/state.h"

namespace hooke {

struct Motion {
  double time = 0.0;
  Field x, v;  // positions [m] and velocities [m/s]
  Field a;     // accelerations [m/s^2] at (x, v), if acceleration_is_current
  bool acceleration_is_current = false;
  MethodMemory memory;
  // since the frame began
  long force_evaluations = 0;
  long factorizations = 0;
  long solves = 0;              // linear systems solved with a factorisation
  long sweeps = 0;              // over all springs as constraints
  long unconverged_solves = 0;  // nonlinear systems left at the limit of iterations
  // [J], of what is no force of the scene: colliders that move, springs that break, springs that are held to a length
  double collider_work = 0.0, break_work = 0.0, limit_work = 0.0;
  double hand_work = 0.0, abs_hand_work = 0.0;  // [J], what the hand put in, and the sum of the sizes of what it put in and took
  double local_error = 0.0;                     // [m], sum over the steps of the method's own estimate, RMS over the points; 0: it has none
};

// What a method builds from the Plan's structure alone (an order of springs, a symbolic factor). It outlives the frame
// and serves until the structure is another.
class Structure {
 public:
  explicit Structure(const Plan& plan) : points_(plan.points), dimensions_(plan.dimensions), runs_(plan.runs) {}
  virtual ~Structure() = default;
  bool fits(const Plan& plan) const { return plan.points == points_ && plan.dimensions == dimensions_ && plan.runs == runs_; }

 private:
  Index points_;
  int dimensions_;
  std::vector<SpringRun> runs_;
};

// An integrator's own scratch: sized and filled by its `prepare`; a step never allocates.
struct Workspace {
  std::vector<Field> fields;
  std::optional<double> tolerance;  // [m], from the settings
  std::unique_ptr<Structure> structure;

  // `count` fields of the motion's size, whatever they hold; allocates only when there were fewer or smaller ones.
  void size_fields(std::size_t count, const Motion& motion);
};

// The workspace's structure of this kind, made anew if there is none or it is of another topology. For `prepare`.
template <class Kind>
Kind& make_structure(const Plan& plan, Workspace& work) {
  auto* known = dynamic_cast<Kind*>(work.structure.get());
  if (known != nullptr && known->fits(plan)) return *known;
  auto made = std::make_unique<Kind>(plan);
  Kind& kind = *made;
  work.structure = std::move(made);
  return kind;
}

// The one that `prepare` made. For `step`.
template <class Kind>
Kind& structure_of(Workspace& work) {
  return static_cast<Kind&>(*work.structure);
}

// v = v e^(-c h) + a (1 - e^(-c h)) / c over `h` [s], a without drag: exact for constant a; v + h a when c = 0. A held
// point keeps the hand's velocity.
void kick(const Plan& plan, Motion& motion, double h);

// x = x + h v.
void drift(Motion& motion, double h);

// RMS over the points that move freely, of a field that is zero at the others: by the length of each point's vector.
double root_mean_square(const Plan& plan, const Field& field);

// [m], [m/s] of every point into the packed layout and back. What is nailed or held starts without velocity.
void pack(const Plan& plan, const State& state, Motion& motion);
void unpack(const Plan& plan, const Motion& motion, State& state);

}  // namespace hooke
