#include "lab/accuracy/judgement.h"

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "lab/accuracy/accuracy_text.h"

namespace hooke {
namespace {

// Above the first a result is doubtful, above the second it is bad [1].
struct Limits {
  double doubtful, bad;
};
constexpr Limits of_frame{1e-3, 1e-2};       // of the size: after a second of such frames the motion is another one
constexpr Limits of_accumulated{0.05, 0.5};  // of the motion
constexpr Limits of_energy{0.02, 0.2};       // of the energy supplied; the first is the limit of RunMonitor

// Relative to the size: what is less is hardly a motion, nor an error.
constexpr double min_error = 1e-6;

std::string percent(double part) { return number_text(100.0 * part, 2) + " %"; }

double energy_part(const Accuracy& accuracy) {
  return accuracy.energy.scale > 0.0 ? std::abs(accuracy.energy.method()) / accuracy.energy.scale : 0.0;
}

// What is judged, relative to its limits: the worst decides.
class Worst {
 public:
  void add(double value, Limits limits, const std::string& text, const std::string& brief) {
    const double severity = std::isfinite(value) ? value / limits.doubtful : HUGE_VAL;
    if (!(severity > std::max(1.0, severity_))) return;
    severity_ = severity;
    judgement_ = {value < limits.bad ? Judgement::Level::Doubtful : Judgement::Level::Bad, text, brief};
  }
  // Takes precedence over every number.
  void lose(Judgement::Level level, const std::string& text, const std::string& brief) {
    if (level >= judgement_.level) judgement_ = {level, text, brief};
  }
  const Judgement& judgement() const { return judgement_; }

 private:
  double severity_ = 0.0;
  Judgement judgement_;
};

}  // namespace

std::string part_of_motion_text(double part) {
  if (part < 1.0) return percent(part) + " of the motion";
  constexpr double max_shown = 1000.0;
  return (part > max_shown ? "more than 1000" : number_text(part, 2)) + " times the motion";
}

bool is_large_error(const Accuracy& accuracy, double error) {
  return error > std::max(of_accumulated.doubtful * accuracy.motion, min_error * accuracy.size);
}

bool has_wrong_energy(const Accuracy& accuracy) { return !(energy_part(accuracy) <= of_energy.doubtful); }

Judgement judge(const Accuracy& accuracy) {
  Worst worst;
  if (accuracy.frame.value)
    worst.add(
        *accuracy.frame.value / accuracy.size, of_frame,
        "error of a frame " + length_text(*accuracy.frame.value) + ", " + percent(*accuracy.frame.value / accuracy.size) + " of the size",
        "large frame error");
  if (accuracy.accumulated.value && accuracy.motion > 0.0 && is_large_error(accuracy, *accuracy.accumulated.value)) {
    const double error = *accuracy.accumulated.value, part = error / accuracy.motion;
    worst.add(part, of_accumulated, "accumulated error " + length_text(error) + ", " + part_of_motion_text(part),
              "error " + part_of_motion_text(part));
  }
  const double part = energy_part(accuracy);
  const std::string gone = accuracy.energy.method() < 0.0 ? "lost" : "gained";
  worst.add(part, of_energy, "energy " + gone + " by the method: " + percent(part) + " of what was supplied", "energy " + gone);
  switch (accuracy.loss) {
    case Loss::None:
      break;
    case Loss::Dissipated:
      worst.lose(Judgement::Level::Bad, "motion dissipated by the method: " + percent(part) + " of the energy", "motion dissipated");
      break;
    case Loss::HalfStepDiverged:
      worst.lose(Judgement::Level::Bad, "with half the step the run diverges", "half step diverges");
      break;
    case Loss::Unresolved:
    case Loss::Unpredictable:
      worst.lose(Judgement::Level::Doubtful, "positions not known: " + std::string(accuracy.accumulated.reason), "positions not known");
      break;
    case Loss::NoSecondRun:
      worst.lose(Judgement::Level::Doubtful, "accumulated error not known: " + std::string(accuracy.accumulated.reason),
                 "total error not known");
      break;
  }
  return worst.judgement();
}

}  // namespace hooke
