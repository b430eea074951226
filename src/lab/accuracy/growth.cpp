#include "lab/accuracy/growth.h"

#include <algorithm>
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

// In time t from the start the distance in a regular motion oscillates, decays or grows in proportion to t: from the second quarter of
// the measurement to the last one by a factor of up to 7 / 3. Growth well beyond that is exponential.
constexpr double max_regular_growth = 5.0;
double growth_of(const std::vector<double>& distances, std::size_t n) {
  return typical(distances, 3 * n / 4, n) / typical(distances, n / 4, n / 2);
}

// Whether the distance grew regularly before and after one event, such as when a point slides off a block: both runs meet that at other
// times, so that their velocities differ from then on. Only where such events repeat does the growth become exponential.
bool has_single_event(const std::vector<double>& distances) {
  constexpr std::size_t half = 2;  // frames, of those in which the event is
  const std::size_t n = distances.size();
  const auto slope = [&](std::size_t i) { return distances[i + 1] - distances[i]; };
  std::size_t event = 0;
  double largest = 0.0;
  for (std::size_t i = half; i + half + 1 < n; ++i)
    if (const double change = slope(i + half) - slope(i - half); change > largest) {
      largest = change;
      event = i;
    }
  if (event < min_frames || growth_of(distances, event) > max_regular_growth) return false;
  constexpr double margin = 1.5;
  const std::size_t after = event + half;
  const double rise = std::max(0.0, slope(after));
  for (std::size_t i = after; i < n; ++i)
    if (!(distances[i] <= margin * (distances[after] + rise * static_cast<double>(i - after)))) return false;
  return true;
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

void GrowthMeasurement::evaluate() {
  const std::size_t n = distances_.size();
  const double seconds = frame_ * static_cast<double>(n - 1), late = typical(distances_, 3 * n / 4, n);
  const double growth = growth_of(distances_, n);
  const bool is_exponential = growth > max_regular_growth && !has_single_event(distances_);
  // what a single event contributes within less than a second is not repeated in the rest of it
  const double measured_seconds = is_exponential ? 0.875 * seconds : std::max(1.0, 0.875 * seconds);
  result_ = Growth{.amplification = std::pow(late / distances_.front(), 1.0 / measured_seconds),
                   .rate = is_exponential ? std::log(growth) / (0.5 * seconds) : 0.0};
}

}  // namespace hooke
