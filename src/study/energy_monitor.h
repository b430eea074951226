// Compares the energy of a run, frame by frame, with what was supplied and with what the scene may dissipate.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/forces/energy/energy.h"
#include "sim/forces/motion.h"
#include "sim/model/settings.h"
#include "sim/model/state.h"
#include "sim/model/system.h"

namespace hooke {

class EnergyMonitor {
 public:
  // As RunMonitor.
  EnergyMonitor(const Plan& plan, const Settings& settings, const System& system, const State& start);
  void begin_frame(const System& system, const State& state) { kinetic_ = kinetic_energy(system, state); }
  void end_frame(const Plan& plan, const Settings& settings, const System& system, const State& state, const Motion& motion);

  // Relative to the supplied energy [1]: RunMonitor::energy_rise.
  double rise() const { return rise_.energy / scale_; }
  // Of a gain, or a loss beyond what the scene may dissipate, of more than this part of the supplied energy; empty: none.
  std::string warning(double tolerance) const;

 private:
  // An energy of the scene, minus the work done on it, and by how much the modified energy exceeded it then [J]. The latter costs some
  // force evaluations: in a large net, where a state takes much memory and a frame has many steps, it is computed at once, otherwise from a
  // copy of the state where it is needed.
  struct Reference {
    double energy;
    std::size_t points;
    std::shared_ptr<const State> state{};
    std::optional<double> difference{};
  };
  struct Now;
  static double modified_difference(const Now& now);
  static double modified_change(Reference& since, double energy, const Now& now);
  static void keep(Reference& reference, const Now& now);

  // The largest one so far, and when.
  struct Extreme {
    double energy = 0.0, time = 0.0;  // [J], [s]
  };
  std::string describe(const Extreme& extreme, double present, const char* kind) const;

  Reference start_, lowest_;
  // At the start of the frame: the kinetic energy [J], and the rate of the dashpots [1/s], of which some may break.
  double kinetic_ = 0.0, dashpot_rate_;
  double max_dissipated_ = 0.0;       // [J], by drag, dashpots, contact and forces so far, a bound
  double dissipated_ = 0.0;           // [J], of it, as far as it is measured; negative
  Extreme rise_, loss_;               // above an earlier value; since the start, beyond what the scene may have dissipated until then
  Extreme hidden_gain_;               // since the start, beyond what contact, drag and dashpots are known to have dissipated
  double change_ = 0.0, gain_ = 0.0;  // [J], since the start, of the modified energy where that changed less; and the gain that is left
  double scale_;                      // [J]
};

}  // namespace hooke
