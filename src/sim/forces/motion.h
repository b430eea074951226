// The State packed for stepping, in the layout of the Plan. It lives for one frame; integrators read and write it.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "sim/forces/constants.h"
#include "sim/forces/dashpots/dashpot_sweeps.h"
#include "sim/model/energy_ledger.h"
#include "sim/model/state.h"
#include "sim/plan/plan.h"

namespace hooke {

// What was done since the start of the frame.
struct StepCounts {
  long force_evaluations = 0;
  long factorizations = 0;
  long solves = 0;              // linear systems solved with a factorization
  long sweeps = 0;              // over all springs as constraints
  long dashpot_sweeps = 0;      // over all dashpots
  long limit_sweeps = 0;        // over all springs, to limit their strain
  long breaks = 0;              // of springs
  long unconverged_solves = 0;  // nonlinear systems that reached the iteration limit
  // of contact of points, faces and springs with each other: pairs that were examined, on paths once for each distance, and impulses
  // between two, those of each sweep
  long contact_tests = 0, contact_impulses = 0;
};

struct Motion {
  double time = 0.0;
  Field x, v;  // positions [m] and velocities [m/s]
  Field a;     // accelerations [m/s^2] at (x, v), if acceleration_is_current
  // Nothing has changed x or v since the method's last step. Where forces depend on velocity, `a` may be at another one.
  bool acceleration_is_current = false;
  // [W], of the listed forces at the end of the method's last step, but for what follows from potentials; none: the method does not know
  // it.
  std::optional<double> power;
  MethodMemory memory;
  StepCounts counts;
  // at the start of the frame: edges that pass through faces, in flat scenes springs through each other, of those that contact keeps apart
  long crossings = 0;
  EnergyLedger energy;       // of drag and dashpots only as far as PowerWork measures them
  Field contact;             // [N s], by contact on each point since the start of the frame; empty: nothing can touch
  double local_error = 0.0;  // [m], sum over the steps of the error estimates of the method, RMS over the points; 0 if it has none
};

// What a method derives from the Plan's structure alone (an order of springs, a symbolic factorization). It outlives the frame
// and remains valid until the structure changes.
class Structure {
 public:
  explicit Structure(const Plan& plan)
      : points_(plan.points),
        dimensions_(plan.dimensions),
        runs_(plan.spring.runs),
        hinge_begin_(plan.force_data.hinges.begin),
        hinge_column_(plan.force_data.hinges.column),
        enclosure_edges_(plan.force_data.enclosures.edges) {}
  virtual ~Structure() = default;
  bool fits(const Plan& plan) const {
    return plan.points == points_ && plan.dimensions == dimensions_ && plan.spring.runs == runs_ &&
           plan.force_data.hinges.begin == hinge_begin_ && plan.force_data.hinges.column == hinge_column_ &&
           plan.force_data.enclosures.edges == enclosure_edges_;
  }

 private:
  Index points_;
  int dimensions_;
  std::vector<SpringRun> runs_;
  std::vector<Index> hinge_begin_, hinge_column_;
  std::vector<EdgeEnds> enclosure_edges_;
};

// Scratch memory of an integrator: sized and filled by its `prepare`; a step never allocates.
struct Workspace {
  std::vector<Field> fields;
  std::optional<double> tolerance;  // [m], from the settings; none: default_tolerance
  double min_step = 0.0;            // [s], the shortest step that an adaptive method takes
  int iterations = 1;               // from the settings
  std::unique_ptr<Structure> structure;
  DashpotSweeps dashpots;

  // Provides `count` fields of the motion's size with unspecified contents; allocates only if there were fewer or smaller ones.
  void size_fields(std::size_t count, const Motion& motion);
};

// The workspace's structure of this kind, created if there is none or its topology differs. For `prepare`.
template <class Kind>
Kind& make_structure(const Plan& plan, Workspace& work) {
  auto* known = dynamic_cast<Kind*>(work.structure.get());
  if (known != nullptr && known->fits(plan)) return *known;
  auto made = std::make_unique<Kind>(plan);
  Kind& kind = *made;
  work.structure = std::move(made);
  return kind;
}

// The one that `prepare` created. For `step`.
template <class Kind>
Kind& structure_of(Workspace& work) {
  return static_cast<Kind&>(*work.structure);
}

// v = v e^(-c h) + a (1 - e^(-c h)) / c over `h` [s], a without drag: exact for constant a; v + h a when c = 0. A held
// point keeps the hand's velocity.
void kick(const Plan& plan, Motion& motion, double h);

// The velocity that kick would give.
void predict_velocity(const Plan& plan, const Motion& motion, double h, Field& v);

// x = x + h v.
void drift(Motion& motion, double h);

// The sum of the products of the elements.
double dot(const Field& a, const Field& b);

// RMS of the vector lengths over the free points, of a field that is zero at the others.
double root_mean_square(const Plan& plan, const Field& field);

// [m], [m/s] of every point to the packed layout and back. Nailed and held points, and rollers along their fixed axes, start with
// velocity zero.
void pack(const Plan& plan, const State& state, Motion& motion);
void unpack(const Plan& plan, const Motion& motion, State& state);

}  // namespace hooke
