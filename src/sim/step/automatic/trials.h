// The coming frame, computed on copies with other methods and substeps: what it costs and how large its error is.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "sim/step/automatic/cost_model.h"
#include "sim/step/automatic/frequency_bound.h"
#include "sim/step/step.h"

namespace hooke {

inline constexpr int max_automatic_substeps = 1 << 16;
// Frames for which the frequencies are bounded at once, and after which this is tried again where they are not much lower than the bound
// for every deformation.
inline constexpr int frames_per_bound = 4, frames_without_bound = 32;

// The fewest substeps with which no linear mode grows; one more than the maximum if that is not enough.
int stable_substeps(const Integrator& method, const Spectrum& spectrum, double frame_rate);

// The fewest substeps that resolve the oscillations of the colliders, 1 without any; likewise.
int collider_substeps(const Plan& plan, double frame_rate);

// Whether the method splits dashpots off that decay within a quarter of a step: then its error is that of the splitting, which is the same
// for every such method, and falls slowly with the step.
bool is_splitting_saturated(const Integrator& method, const Spectrum& spectrum, double step);

// The table of integrators, and the steps that only `auto` takes.
std::span<const Integrator* const> compared_methods();

class Trials {
 public:
  struct Result {
    double error = std::numeric_limits<double>::infinity();  // [m], RMS over the points; infinity: it diverged or cost too much
    double cost = std::numeric_limits<double>::infinity();   // [ms], by the model, also of a frame that diverged; infinity: too much
    bool is_too_expensive = false;
    bool breaks = false;  // whether springs broke, in the frame or in its repetition: its error is of first order
    // Of the repetition, if its error follows from the order; 0 substeps: it does not.
    int fine_substeps = 0;
    double fine_error = std::numeric_limits<double>::infinity(), fine_cost = std::numeric_limits<double>::infinity();
  };

  // Begins another frame: none is kept. Whether steps beyond the resonance of blanes_moan4 may be used (resonance.h).
  void forget(bool beyond_resonance);
  // The scene and the state at the start of the frame, which must outlive the calls of measure. Data that belong to the structure of the
  // scene are kept as long as it is the same.
  void begin(const Plan& plan, const System& system, const State& start);
  // The fewest substeps with which no linear mode grows, or only slowly (resonance.h), for each of compared_methods(); more than the
  // maximum where there are too many. `frequency`: of the fastest mode relative to the spectrum of the plan. Computed again only when that
  // has changed.
  const std::vector<int>& stable_substeps(const Plan& plan, double frame_rate, double frequency);
  int stable_substeps(const Integrator& method, const Plan& plan, double frame_rate, double frequency);
  // A bound on the frequencies of the springs in the coming frames (FrequencyBound); 1 where it would cost more than it saves in a frame of
  // `frame_cost` [ms].
  double bound_frequency(const Plan& plan, const State& state, double frame_rate, double frame_cost);
  enum class End { Finished, Diverged, TooExpensive };
  // Computes the frame, unless the last call did. Abandoned if it costs more than `max_cost` [ms].
  End compute_frame(const Settings& settings, double max_cost, double* cost);
  // Whether something touched in the frame that was computed last, and changed its velocity so much that an impact at another time within
  // a substep would be an error of more than this [m]; or whether a method of first order has such an error without a touch.
  bool has_impact(double max_error) const { return impact_error(max_error) > max_error; }
  // Whether springs broke in the frame that was computed last.
  bool has_broken() const { return last_.method != nullptr && !last_.frame.broken().empty(); }
  // The substeps that resolve the vibrations of the springs, and whether springs break in the frame in that many of the default method. No
  // if it costs more than `max_cost` [ms].
  int resolving_substeps(double frame_rate);
  bool breaks_if_resolved(const Settings& settings, int substeps, double max_cost);
  // The error of the frame, from its repetition with half the step. Abandoned if it costs more than `max_cost` [ms]. `limit`: the largest
  // error that is acceptable [m]; where the method itself estimates that it is smaller or much larger, the frame is not repeated.
  Result measure(const Settings& settings, double max_cost, double limit);
  // The same from its repetition with twice the step, for half the cost: where those steps are stable and short enough for the order.
  Result measure_by_coarser(const Settings& settings, double max_cost);
  // [m/s], RMS over the points: by how much the velocities changed in the frame that was computed last; infinity: none was.
  double velocity_change() const;
  // [m], RMS over the points: the distance of the frame that was measured last, with these settings, to one that resolves every vibration
  // (frame_error.h); 0 where its method does so, or where that frame costs too much.
  double unresolved(const Settings& settings);
  // Keeps the frame that was computed or measured last, or its repetition, to be used as the frame itself.
  void keep();
  void keep_repetition(const Integrator& method, const Result& result);
  // The frame that was kept, if it has these settings; it may be used once.
  Frame* kept(const Integrator& method, int substeps);
  // [ms], of all trials so far but the frames used, by the model.
  double total_cost() const { return total_cost_; }

 private:
  double impact_error(double resolution) const;
  // A frame with the settings with which it was computed.
  struct Computed {
    Frame frame;
    const Integrator* method = nullptr;  // null: none
    int substeps = 0;
    double cost = 0.0;  // [ms], by the model
  };
  End compute(const Settings& settings, const CostModel& model, double max_cost, double* cost);
  // The error [m] of the frame that was computed last by the embedded estimate of its method, if that is reliable.
  std::optional<double> embedded_error(const Integrator& method) const;
  bool starts_on_collider(std::size_t point, double max_error) const;
  // [m], by which the positions of a frame of so many substeps may be off because they are rounded.
  double round_off(int substeps) const;

  Plan plan_;
  Frame frame_;
  Computed last_, kept_;
  const System* system_ = nullptr;
  const State* start_ = nullptr;
  std::vector<Vec3> last_positions_, last_velocities_;  // at the end of the last frame
  std::vector<Vec3> resolved_positions_;                // at the end of the frame that resolves every vibration; empty: not computed
  State end_;
  double total_cost_ = 0.0;
  Spectrum spectrum_;
  double frame_rate_ = 0.0;
  double frequency_ = 1.0, resolving_step_ = 0.0;
  bool beyond_resonance_ = false, is_beyond_resonance_ = false;  // now, and of the numbers below
  std::vector<int> stable_for_any_, stable_substeps_;
  FrequencyBound bound_;
};

}  // namespace hooke
