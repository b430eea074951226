// The coming frame, computed on copies with other methods and substeps: what it costs and how large its error is.
#pragma once

#include <limits>

#include "sim/automatic/cost_model.h"
#include "sim/step.h"

namespace hooke {

inline constexpr int max_automatic_substeps = 1 << 16;

// The fewest substeps with which no linear mode grows; one more than the maximum if that is not enough.
int stable_substeps(const Integrator& method, const Spectrum& spectrum, double frame_rate);

class Trials {
 public:
  struct Result {
    double error = std::numeric_limits<double>::infinity();  // [m], RMS over the points; infinity: it diverged or cost too much
    double cost = std::numeric_limits<double>::infinity();   // [ms], by the model, also of a frame that diverged; infinity: too much
    bool is_too_expensive = false;
  };

  // The scene and the state at the start of the frame, which must outlive the calls of measure. Data that belong to the structure of the
  // scene are kept as long as it is the same.
  void begin(const Plan& plan, const System& system, const State& start);
  // The fewest substeps with which no linear mode grows, for each method of the table; more than the maximum where there are too many.
  // Computed again only when the spectrum has changed.
  const std::vector<int>& stable_substeps(const Plan& plan, double frame_rate);
  // The error of the frame, from its repetition with half the step. Abandoned if it costs more than `max_cost` [ms].
  Result measure(const Settings& settings, double max_cost);
  // The same from its repetition with twice the step, for half the cost: where those steps are stable and short enough for the order.
  Result measure_by_coarser(const Settings& settings, double max_cost);
  // [ms], of all trials so far, by the model.
  double total_cost() const { return total_cost_; }

 private:
  enum class End { Finished, Diverged, TooExpensive };
  End compute(const Settings& settings, const CostModel& model, double max_cost, double* cost);

  Plan plan_;
  Frame frame_;
  const System* system_ = nullptr;
  const State* start_ = nullptr;
  std::vector<Vec3> coarse_;
  State end_;
  double total_cost_ = 0.0;
  Spectrum spectrum_;
  double frame_rate_ = 0.0;
  std::vector<int> stable_substeps_;
};

}  // namespace hooke
