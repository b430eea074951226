#include "lab/accuracy/growth.h"

#include <cmath>

namespace hooke {
namespace {

constexpr double first_evaluation = 1.0, last_evaluation = 8.0;  // [s]
constexpr std::size_t min_frames = 8;

// Root mean square over [begin, end).
double typical(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0.0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i] * values[i];
  return std::sqrt(sum / static_cast<double>(end - begin));
}

}  // namespace

void GrowthMeasurement::start(double distance, double frame) {
  frame_ = frame;
  next_evaluation_ = first_evaluation;
  distances_.assign(1, distance);
  is_finished_ = false;
}

void GrowthMeasurement::add(double distance, double limit) {
  distances_.push_back(distance);
  const bool is_large = !(distance <= limit);
  const double seconds = frame_ * static_cast<double>(distances_.size() - 1);
  if (!is_large && seconds < next_evaluation_ * (1.0 - 1e-9)) return;
  if (is_large) distances_.pop_back();
  if (distances_.size() > min_frames) evaluate();
  next_evaluation_ *= 2.0;
  is_finished_ = is_large || next_evaluation_ > last_evaluation;
}

// In time t from the start the distance in a regular motion oscillates, decays or grows in proportion to t: from the second quarter of
// the measurement to the last one by a factor of up to 7 / 3. Growth well beyond that is exponential.
void GrowthMeasurement::evaluate() {
  const std::size_t n = distances_.size();
  const double seconds = frame_ * static_cast<double>(n - 1);
  const double early = typical(distances_, n / 4, n / 2), late = typical(distances_, 3 * n / 4, n);
  constexpr double max_regular_growth = 5.0;
  const double growth = late / early;
  result_ = Growth{.amplification = std::pow(late / distances_.front(), 1.0 / (0.875 * seconds)),
                   .rate = growth > max_regular_growth ? std::log(growth) / (0.5 * seconds) : 0.0};
}

}  // namespace hooke
