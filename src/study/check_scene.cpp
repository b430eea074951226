#include "study/check_scene.h"

#include <cmath>

#include "base/formatted.h"
#include "lab/lab.h"
#include "scene/quantity.h"
#include "sim/control/automatic.h"
#include "sim/step/divergence.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

// The estimated error and the warnings of the run.
std::string describe_accuracy(const RunMonitor& monitor) {
  std::string accuracy = formatted("; estimated error %.1g m in total", monitor.estimated_error());
  for (const std::string& warning : monitor.warnings({})) accuracy += "; " + warning;
  return accuracy;
}

// The quantities of the criteria, frame by frame.
class QuantityHistory {
 public:
  QuantityHistory(const SceneCheck& check, const Scene& scene) : check_(check), start_(scene.state.time), series_(check.criteria.size()) {
    for (const Criterion& criterion : check.criteria)
      quantities_.push_back(find_quantity(criterion.of, scene.system.point_count(), scene.system.spring_count()));
  }
  void add(const Scene& scene) {
    if (check_.criteria.empty()) return;
    const Measurement measured = measure(scene.system, scene.state);
    for (std::size_t i = 0; i < series_.size(); ++i) {
      if (!quantities_[i] || scene.state.time - start_ < check_.criteria[i].from) continue;
      series_[i].time.push_back(scene.state.time);
      series_[i].value.push_back(quantities_[i]->of(measured));
    }
  }
  CriterionResult evaluate_all() const {
    CriterionResult all{true, ""};
    for (std::size_t i = 0; i < series_.size(); ++i) {
      const CriterionResult one = series_[i].value.empty() ? CriterionResult{false, check_.criteria[i].of + ": nothing to measure"}
                                                           : evaluate_criterion(check_.criteria[i], series_[i]);
      all.holds = all.holds && one.holds;
      all.description += (all.description.empty() ? "" : "; ") + std::string(one.holds ? "" : "FAILED: ") + one.description;
    }
    return all;
  }

 private:
  const SceneCheck& check_;
  double start_;
  std::vector<std::optional<Quantity>> quantities_;
  std::vector<TimeSeries> series_;
};

CheckResult run(const SceneCheck& check, Scene scene, const CheckedMethod& checked, const std::function<void()>& after_substep) {
  const Integrator& method = *checked.method;
  scene.settings.integrator = &method;
  if (checked.substeps) scene.settings.substeps = *checked.substeps;
  if (method.stability != Stability::Adaptive) scene.settings.tolerance.reset();
  const long frames = std::lround(std::ceil(check.seconds * scene.settings.frame_rate));
  Lab lab(std::move(scene), KeepStart::No);
  lab.watch_substeps(after_substep);
  QuantityHistory history(check, lab.scene());
  history.add(lab.scene());
  constexpr int frames_per_estimate = 20;
  RunMonitor monitor(lab.plan(), lab.scene().settings, lab.scene().system, lab.scene().state,
                     check.expects_divergence ? 0 : frames_per_estimate);
  for (long frame = 0; frame < frames; ++frame) {
    monitor.begin_frame(lab.scene().system, lab.scene().settings, lab.scene().state);
    if (lab.step()) {
      monitor.end_frame(lab.plan(), settings_used(lab.scene().settings, lab.scene().state), lab.scene().system, lab.scene().state,
                        lab.last_frame().motion());
      history.add(lab.scene());
      continue;
    }
    lab.publish();
    const Status& status = *lab.status();
    const bool is_reported = status.snapshot->divergence && !status.diagnosis.message.empty() && is_finite(lab.scene().state);
    return {&method, is_reported && check.expects_divergence, status.diagnosis.message};
  }
  if (check.expects_divergence) return {&method, false, "expected to diverge, but ran to the end"};
  const CriterionResult verdict = history.evaluate_all();
  return {&method, verdict.holds && is_finite(lab.scene().state),
          (verdict.description.empty() ? "runs to the end" : verdict.description) + describe_accuracy(monitor)};
}

}  // namespace

std::vector<CheckResult> run_check(const SceneCheck& check, const Scene& scene, const std::function<void()>& after_substep) {
  std::vector<CheckResult> results;
  for (const CheckedMethod& method : check.methods) results.push_back(run(check, scene, method, after_substep));
  return results;
}

std::vector<CheckResult> check_scene(const Scene& scene, const std::function<void()>& after_substep) {
  return run_check(check_of(scene), scene, after_substep);
}

}  // namespace hooke
