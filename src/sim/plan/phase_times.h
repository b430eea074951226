// The time that frames take, by what is computed. The clock belongs to whoever steps: sim reads none, and no result depends on it.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace hooke {

// Forces: all of a step but the other phases. Solve: matrices of implicit methods. Auto: what `auto` computes and does not keep.
enum class Phase { None, Forces, Contact, Solve, Auto, Accuracy };
inline constexpr std::size_t phase_count = 6;

struct PhaseTimes {
  double (*clock)();                          // [s]
  std::array<double, phase_count> seconds{};  // of real time
  Phase phase = Phase::None;                  // in progress
  double since = 0.0;                         // [s], on the clock

  // Returns the phase that ends.
  Phase enter(Phase next) {
    const double now = clock();
    seconds[static_cast<std::size_t>(phase)] += now - std::exchange(since, now);
    return std::exchange(phase, next);
  }
  // The run so far is not kept.
  void move_to_auto() {
    enter(phase);
    for (const Phase of_run : {Phase::Forces, Phase::Contact, Phase::Solve})
      seconds[static_cast<std::size_t>(Phase::Auto)] += std::exchange(seconds[static_cast<std::size_t>(of_run)], 0.0);
  }
};

// A phase until the end of the scope; null: not measured.
class InPhase {
 public:
  InPhase(PhaseTimes* times, Phase phase) : times_(times), before_(times != nullptr ? times->enter(phase) : phase) {}
  ~InPhase() {
    if (times_ != nullptr) times_->enter(before_);
  }
  InPhase(const InPhase&) = delete;
  InPhase& operator=(const InPhase&) = delete;

 private:
  PhaseTimes* times_;
  Phase before_;
};

}  // namespace hooke
