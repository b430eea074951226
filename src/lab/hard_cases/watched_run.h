// A scene under a method in a Lab of its own, frame by frame, as a person would see it: with the watch for divergence,
// and with books on where the energy came from and went.
#pragma once

#include <limits>
#include <string>

#include "lab/hard_cases/draft.h"
#include "lab/hard_cases/hard_case.h"
#include "lab/lab.h"

namespace hooke {

// From which size on a fault of a run counts as reported.
struct Tolerance {
  double energy = 0.02;                                         // [1], of what was put in, that nothing accounts for
  double position = std::numeric_limits<double>::infinity();    // [m], by the frames' errors as estimated
};

class WatchedRun {
 public:
  WatchedRun(const Draft& draft, const Settings& settings);

  // One frame; false when the watch stops the run, and from then on.
  bool frame();
  // As many whole frames as `seconds` hold.
  bool run(double seconds);

  Lab& lab() { return lab_; }
  const System& system() const { return lab_.scene().system; }
  const State& state() const { return lab_.scene().state; }
  const Settings& settings() const { return lab_.scene().settings; }
  bool stopped() const { return stopped_; }
  bool all_solves_converged() const { return unconverged_solves_ == 0; }

  // Energy that no hand, edit, dashpot or drag accounts for, of what was put in [1]: the method's own doing. Without
  // colliders, which take energy that the books do not know of.
  double unaccounted_energy() const;
  // The furthest that the energy, less what hand and edits gave, rose above an earlier value, of what was put in [1]:
  // nothing physical does.
  double energy_rise() const { return largest_rise_ / state().ledger.scale; }

  // How the run itself says that it is not to be trusted: the watch stopped it; its step is beyond the method's limit; a
  // solve did not converge; its energy balance is off; its estimate of the frames' errors adds up to too much. Empty: in
  // no way.
  std::string report(const Tolerance& tolerance) const;

 private:
  double energy_less_given() const;

  Lab lab_;
  bool stopped_ = false;
  bool stopped_openly_ = false;
  long frames_ = 0;
  long unconverged_solves_ = 0;
  double start_energy_ = 0.0;   // [J], less what was given
  double lowest_energy_ = 0.0;  // [J], less what was given
  double largest_rise_ = 0.0;   // [J]
  double dissipated_ = 0.0;     // [J], by dashpots and drag
  double power_ = 0.0;          // [W], being dissipated
};

// How a method is set on a scene: at 60 frames a second, with the fewest substeps at which it holds.
struct Stepping {
  int least = 1;           // substeps, at least
  int free = 1;            // substeps of the methods that hold at any step
  double share = 1.0;      // of the largest stable step, that may be taken
  int most = 1000000;      // substeps: where it takes more, these are too dear, and it is left at `least`
};
Settings settings_for(const Integrator& method, const System& system, const Stepping& stepping = {});

// Whether a step of any size may be asked of the method, if only for a spring alone.
bool takes_any_step(const Integrator& method);

// A run must hold, unless its step is beyond the limit of its method, or the method promises nothing of springs together.
Expectation expectation_of(const WatchedRun& run);

// The verdict on a run that was to meet a criterion, and did (`met`) or not.
Verdict judge(const WatchedRun& run, bool met, std::string measured, const Tolerance& tolerance = {});
Verdict judge(const WatchedRun& run, Expectation expected, bool met, std::string measured, const Tolerance& tolerance = {});

std::string text(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace hooke
