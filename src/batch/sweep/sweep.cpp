#include "batch/sweep/sweep.h"

#include <algorithm>
#include <cmath>

#include "base/option_error.h"
#include "base/printable.h"
#include "batch/run_frames.h"
#include "batch/scene_options.h"
#include "edit/command.h"
#include "lab/lab.h"
#include "scene/flatness.h"
#include "scene/step_advice.h"
#include "sim/model/hash.h"

namespace hooke {
namespace {

constexpr std::size_t max_note_bytes = 1000;

// Collects the values of the measures over the frames of a run.
class Measuring {
 public:
  explicit Measuring(const std::vector<SweepMeasure>& measures) : measures_(measures), sums_(measures.size()) {}

  // The last state, which is also one of the frames.
  void add_end(const Scene& scene, const Accuracy& accuracy) {
    add(scene, accuracy, [](const SweepMeasure& each) { return each.of == SweepMeasure::Of::End; });
  }
  void add_frame(const Scene& scene, const Accuracy& accuracy) {
    add(scene, accuracy, [](const SweepMeasure& each) { return each.of != SweepMeasure::Of::End; });
  }

  std::vector<std::optional<double>> results(double cpu) const {
    std::vector<std::optional<double>> values;
    for (std::size_t i = 0; i < measures_.size(); ++i) {
      const Sum& sum = sums_[i];
      const bool is_mean = measures_[i].of == SweepMeasure::Of::Mean, is_known = !measures_[i].quantity || sum.count > 0;
      const double value = !measures_[i].quantity ? cpu : is_mean ? sum.value / static_cast<double>(sum.count) : sum.value;
      values.push_back(is_known && std::isfinite(value) ? std::optional(value) : std::nullopt);
    }
    return values;
  }

 private:
  struct Sum {
    double value = 0.0;
    long count = 0;
  };

  template <class IsWanted>
  void add(const Scene& scene, const Accuracy& accuracy, IsWanted is_wanted) {
    if (!std::ranges::any_of(measures_, is_wanted)) return;
    const Measurement measurement = measure(scene.system, scene.state, &accuracy);
    for (std::size_t i = 0; i < measures_.size(); ++i)
      if (measures_[i].quantity && is_wanted(measures_[i])) add(sums_[i], measures_[i].of, measures_[i].quantity->of(measurement));
  }

  // What is not known in a frame, such as its error before the first one, does not count.
  static void add(Sum& sum, SweepMeasure::Of of, double value) {
    using enum SweepMeasure::Of;
    if (std::isnan(value)) return;
    if (sum.count == 0 || of == End)
      sum.value = value;
    else if (of == Max)
      sum.value = std::max(sum.value, value);
    else if (of == Min)
      sum.value = std::min(sum.value, value);
    else
      sum.value += value;
    ++sum.count;
  }

  const std::vector<SweepMeasure>& measures_;
  std::vector<Sum> sums_;
};

bool needs_accuracy(const Sweep& sweep) {
  return std::ranges::any_of(sweep.measures, [](const SweepMeasure& each) { return each.quantity && each.quantity->row->needs_accuracy; });
}

// Throws UsageError if the scene does not have the parameter or cannot have one of its values.
void check_axis(const SweepAxis& axis, const Scene& scene) {
  const auto refuse = [&](const std::string& reason) { throw OptionError("vary", std::string(axis.parameter->name), reason); };
  if (axis.parameter->applies != nullptr && !axis.parameter->applies(scene)) refuse("the scene has nothing that it sets");
  if (axis.parameter == &dimensions_parameter && std::ranges::count(axis.values, 0.0) > 0)
    if (const std::string reason = why_not_flat(scene.system, scene.state); !reason.empty()) refuse("2: " + reason);
}

// Throws UsageError.
void check_size(const Sweep& sweep, const Scene& scene) {
  if (sweep.row_count() > max_sweep_rows) throw UsageError("--vary: more than " + std::to_string(max_sweep_rows) + " combinations");
  double frame_rate = scene.settings.frame_rate;
  for (const SweepAxis& axis : sweep.axes)
    if (axis.parameter->name == "frame_rate") frame_rate = *std::ranges::max_element(axis.values);
  count_frames(sweep.seconds, frame_rate);
}

}  // namespace

std::size_t Sweep::row_count() const {
  std::size_t rows = 1;
  for (const SweepAxis& axis : axes) {
    rows *= axis.values.size();
    if (rows > max_sweep_rows) return max_sweep_rows + 1;
  }
  return rows;
}

std::vector<double> Sweep::values_of(std::size_t row) const {
  std::vector<double> values(axes.size());
  for (std::size_t i = axes.size(); i-- > 0; row /= axes[i].values.size()) values[i] = axes[i].values[row % axes[i].values.size()];
  return values;
}

Sweep make_sweep(const std::string& name, const Scene& scene, const std::vector<std::string>& axes, const std::string& measures,
                 double seconds) {
  if (axes.empty()) throw UsageError("--vary is required");
  if (measures.empty()) throw UsageError("--measure is required");
  Sweep sweep{.scene = name, .fingerprint = hash_bytes(format_scene(scene)), .seconds = seconds, .axes = {}, .measures = {}};
  for (const std::string& text : axes) {
    const auto refuse = [&](const std::string& reason) { throw OptionError("vary", printable(text, 80), reason); };
    SweepAxis axis;
    if (const std::string reason = parse_axis(text, axis); !reason.empty()) refuse(reason);
    if (std::ranges::count(sweep.axes, axis.parameter, &SweepAxis::parameter) > 0) refuse("varied twice");
    check_axis(axis, scene);
    sweep.axes.push_back(std::move(axis));
  }
  const std::string reason = parse_measures(measures, scene.system.point_count(), scene.system.spring_count(), sweep.measures);
  if (!reason.empty()) throw OptionError("measure", reason);
  check_size(sweep, scene);
  return sweep;
}

std::optional<SweepRow> run_row(const Sweep& sweep, const Scene& scene, std::size_t row, const std::function<bool()>& should_continue) {
  Scene copy = scene;
  Effect effect;
  const std::vector<double> values = sweep.values_of(row);
  for (std::size_t i = 0; i < values.size(); ++i) apply(copy, SetParameter{sweep.axes[i].parameter, values[i]}, effect);
  std::vector<std::string> warnings;
  for (const auto& warning : {step_warning(copy.system, copy.state, copy.settings), oscillation_warning(copy.system, copy.settings)})
    if (warning) warnings.push_back(*warning);

  Lab lab(std::move(copy), KeepStart::No);
  Measuring measuring(sweep.measures);
  bool is_stopped = false;
  RunHooks hooks;
  hooks.sample = [&](const State&, const Accuracy& accuracy) { measuring.add_end(lab.scene(), accuracy); };
  hooks.frame = [&] {
    measuring.add_frame(lab.scene(), lab.accuracy());
    return !(is_stopped = !should_continue());
  };
  const RunRequest request{.seconds = sweep.seconds, .accuracy = needs_accuracy(sweep) ? AccuracyMode::Full : AccuracyMode::Off};
  const RunResults run = run_frames(lab, request, hooks);
  if (is_stopped) return std::nullopt;

  SweepRow result{.row = row};
  if (run.totals.diverged) {
    result.status = SweepRow::Status::Diverged;
    result.note = printable(explain_divergence(lab, nullptr, sweep.seconds), max_note_bytes);
    result.values.resize(sweep.measures.size());
    return result;
  }
  result.values = measuring.results(run.totals.cpu_seconds);
  warnings.insert(warnings.end(), run.warnings.begin(), run.warnings.end());
  for (const std::string& warning : warnings) result.note += (result.note.empty() ? "" : "; ") + warning;
  result.note = printable(result.note, max_note_bytes);
  if (!warnings.empty()) result.status = SweepRow::Status::Warning;
  return result;
}

}  // namespace hooke
