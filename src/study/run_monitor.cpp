#include "study/run_monitor.h"

#include <algorithm>

#include "base/number_text.h"
#include "base/text_lines.h"
#include "scene/crossed_parts.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_error.h"

namespace hooke {

RunMonitor::RunMonitor(const Plan& plan, const Settings& settings, const System& system, const State& start, int frames_per_estimate)
    : frames_per_estimate_(frames_per_estimate), energy_(plan, settings, system, start) {
  if (system.dimensions == 2) crossings_.first = static_cast<long>(count_crossings(system, start));
}

void RunMonitor::begin_frame(const System& system, const Settings& settings, const State& state) {
  energy_.begin_frame(system, state);
  if (estimate_is_due() && !is_automatic(settings))
    estimated_error_ += frames_per_estimate_ * estimate_frame_error(system, settings, state);
}

void RunMonitor::note_crossings(long crossings, double time) {
  if (!crossings_.first) crossings_.first = crossings;
  if (crossings > 0 && crossings_.max == 0) crossings_.time = time;
  crossings_.max = std::max(crossings_.max, crossings);
}

void RunMonitor::end_frame(const Plan& plan, const Settings& settings, const System& system, const State& state, const Motion& motion) {
  ++frames_;
  // of `auto`
  if (state.memory.choice) estimated_error_ += state.memory.choice->error.value_or(0.0);
  unconverged_solves_ += motion.counts.unconverged_solves;
  if (system.dimensions == 3) note_crossings(motion.crossings, state.time - 1.0 / settings.frame_rate);
  energy_.end_frame(plan, settings, system, state, motion);
}

std::vector<std::string> RunMonitor::warnings(const Tolerance& tolerance) const {
  std::vector<std::string> warnings;
  if (unconverged_solves_ > 0)
    warnings.push_back(pluralize(static_cast<std::size_t>(unconverged_solves_), "solve", "solves") +
                       " did not converge; take more substeps");
  // those of the start are another warning
  if (crossings_.first == 0 && crossings_.max > 0)
    warnings.push_back("up to " + pluralize(static_cast<std::size_t>(crossings_.max), "edge passes", "edges pass") +
                       " through faces or springs, from " + quantity_text(crossings_.time, "s", 4) + " on");
  if (std::string warning = energy_.warning(tolerance.energy); !warning.empty()) warnings.push_back(std::move(warning));
  if (!(estimated_error_ <= tolerance.position))
    warnings.push_back("estimated error: " + quantity_text(estimated_error_, "m", 1) + " in total");
  return warnings;
}

}  // namespace hooke
