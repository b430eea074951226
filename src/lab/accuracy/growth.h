// Growth of a small difference between two runs, from their distance frame by frame: whether it is exponential, and how fast.
#pragma once

#include <optional>
#include <vector>

namespace hooke {

struct Growth {
  double amplification = 1.0;  // [1], factor per second
  double rate = 0.0;           // [1/s], of exponential growth; 0: it is not exponential
};

class GrowthMeasurement {
 public:
  // Starts with this distance; `frame` is the time between distances [s].
  void start(double distance, double frame);
  // The next distance. `limit`: distances above it are no longer small.
  void add(double distance, double limit);

  // After 1, 2, 4 and 8 s, and when the distance is no longer small; none before.
  const std::optional<Growth>& result() const { return result_; }
  // Whether it is over: another one may start.
  bool is_finished() const { return is_finished_; }

 private:
  void evaluate();

  double frame_ = 0.0, next_evaluation_ = 0.0;
  std::vector<double> distances_;
  std::optional<Growth> result_;
  bool is_finished_ = true;
};

}  // namespace hooke
