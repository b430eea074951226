// One judgement of a run for every place that shows its accuracy: the worst of the error of a frame, the accumulated error, the energy that
// the method gained or lost, and the loss of the motion.
#pragma once

#include <string>

#include "sim/model/accuracy.h"

namespace hooke {

struct Judgement {
  enum class Level { Good, Doubtful, Bad };
  Level level = Level::Good;
  // Names the worst: "motion dissipated by the method: 99 % of the energy", and in fewer words: "motion dissipated". Empty where all is
  // well, or nothing is known.
  std::string text{}, brief{};
};

Judgement judge(const Accuracy& accuracy);

// Whether an error accumulated so far is large in comparison with the motion.
bool is_large_error(const Accuracy& accuracy, double error);
// Whether the method gained or lost so much energy that averages are wrong, too.
bool has_wrong_energy(const Accuracy& accuracy);
// "43 % of the motion", "12 times the motion"
std::string part_of_motion_text(double part);

}  // namespace hooke
