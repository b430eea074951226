#include "batch/scene_options.h"

#include <atomic>
#include <stdexcept>

#include "base/file_limits.h"
#include "base/threads/thread_team.h"
#include "device/gpu_device.h"
#include "edit/command.h"
#include "formats/open_file.h"
#include "scene/parameters.h"
#include "scene/step_advice.h"
#include "scene/warnings/warnings.h"
#include "sim/control/automatic.h"
#include "sim/forces/single_precision.h"
#include "sim/methods/integrator.h"
#include "sim/methods/precision.h"
#include "study/remedy/remedy.h"

namespace hooke {

std::string ids_of_adaptive_integrators() {
  std::string ids;
  for (const Integrator& integrator : integrators())
    if (integrator.stability == Stability::Adaptive) ids += std::string(integrator.id) + ", ";
  return ids + std::string(automatic_method().id);
}

namespace {

// Without a named method, the tolerance is that of `auto`.
void set_tolerance(Settings& settings, double tolerance, bool is_method_named) {
  if (settings.integrator->stability != Stability::Adaptive && !is_method_named) settings.integrator = &automatic_method();
  if (settings.integrator->stability != Stability::Adaptive)
    throw OptionError("tolerance", format_exact(tolerance), "requires an adaptive method: " + ids_of_adaptive_integrators());
  settings.tolerance = tolerance;
}

// A setting that the method of the run does not use.
void refuse_unused(const SetParameter& setting, const Settings& settings) {
  const auto refuse = [&](const std::string& reason) {
    throw OptionError("set", std::string(setting.parameter->name) + "=" + format_exact(setting.value), reason);
  };
  if (setting.parameter == &tolerance_parameter && settings.integrator->stability != Stability::Adaptive)
    refuse("requires an adaptive method: " + ids_of_adaptive_integrators());
  if (setting.parameter->name == "budget" && setting.value > 0.0 && !is_automatic(settings)) refuse("requires the method auto");
}

struct ParsedOptions {
  const Integrator* integrator;
  std::vector<SetParameter> settings;
};

ParsedOptions parse(const SteppingOptions& options) {
  ParsedOptions parsed{options.integrator ? &parse_integrator(*options.integrator) : nullptr, {}};
  if (options.substeps) check_option("substeps", static_cast<double>(*options.substeps), {.min = 1, .max = max_substeps});
  if (options.frame_rate) check_option("frame-rate", *options.frame_rate, positive);
  if (options.tolerance) check_option("tolerance", *options.tolerance, positive);
  for (const std::string& setting : options.settings) parsed.settings.push_back(parse_setting(setting));
  return parsed;
}

}  // namespace

void set_options(Scene& scene, const SteppingOptions& options, const std::string& name) {
  const auto [integrator, settings] = parse(options);
  for (const SetParameter& setting : settings) apply_setting(scene, setting, name);
  if (integrator != nullptr) scene.settings.integrator = integrator;
  if (options.substeps) scene.settings.substeps = static_cast<int>(*options.substeps);
  if (options.frame_rate) scene.settings.frame_rate = *options.frame_rate;
  if (options.tolerance) set_tolerance(scene.settings, *options.tolerance, integrator != nullptr);
  for (const SetParameter& setting : settings) refuse_unused(setting, scene.settings);
}

void apply_options(LoadedScene& loaded, const SteppingOptions& options, const std::string& name) {
  Scene& scene = loaded.scene;
  const auto limit_warning = [&] { return strain_limit_warning(scene.system, scene.state); };
  // warnings about settings in the file do not apply once options change them
  for (const auto& warning : {step_warning(scene.system, scene.state, scene.settings), oscillation_warning(scene.system, scene.settings),
                              unused_setting_warning(scene.settings), limit_warning()})
    if (warning) std::erase_if(loaded.warnings, [&](const std::string& line) { return line.ends_with(*warning); });
  set_options(scene, options, name);
  // a method that an option names does not need what the file says to that of the file
  if (!options.integrator)
    if (const auto warning = unused_setting_warning(scene.settings)) loaded.warnings.push_back(*warning);
  for (const auto& warning :
       {step_warning(scene.system, scene.state, scene.settings), oscillation_warning(scene.system, scene.settings), limit_warning()})
    if (warning) loaded.warnings.push_back(*warning);
  // a file with one has been warned about when it was read
  const auto small = small_collider_warning(scene.system, scene.state);
  if (small && std::ranges::none_of(loaded.warnings, [&](const std::string& line) { return line.ends_with(*small); }))
    loaded.warnings.push_back(*small);
  if (options.substeps && is_automatic(scene.settings))
    loaded.warnings.push_back("substeps: " + std::to_string(scene.settings.substeps) + ": not used: auto chooses the substeps");
}

std::shared_ptr<GpuDevice> open_gpu() {
  try {
    return std::make_shared<GpuDevice>();
  } catch (const std::runtime_error& error) {
    throw OptionError("device", "gpu", error.what());
  }
}

Execution make_execution(const Lab& lab, const ExecutionOptions& options) {
  Execution execution{.team = options.threads > 1 ? std::make_shared<ThreadTeam>(options.threads) : nullptr};
  const Settings& settings = lab.scene().settings;
  if (options.device == Device::Gpu) {
    if (const std::string needs = needs_processor(lab.plan(), *settings.integrator); !needs.empty())
      throw OptionError("device", "gpu", "not for " + needs);
    execution.device = open_gpu();
  }
  if (options.precision == Precision::Double) return execution;
  const std::string needs = options.device == Device::Cpu ? needs_double_precision(lab.plan(), settings) : "";
  if (!needs.empty()) throw OptionError("precision", "single", "not for " + needs);
  execution.single = std::make_shared<SinglePrecision>();
  return execution;
}

LoadedScene load_with_options(const SceneOptions& options) {
  parse(options);
  LoadedScene loaded = load_file(find_scene(options.scene), {}, options.import);
  apply_options(loaded, options, options.scene);
  return loaded;
}

std::string explain_divergence(Lab& lab, const Scene* start, double seconds, const std::function<void()>& progress, const State* before) {
  lab.publish();
  const std::string& message = lab.status()->diagnosis.message;
  if (start == nullptr) return message;
  const std::atomic<bool> stops = false;
  const auto report = [&](const std::string&) {
    if (progress) progress();
  };
  Remedy remedy = find_remedy(*start, seconds, stops, default_remedy_work, report);
  if (remedy.cause == Remedy::Cause::SearchLimit && before != nullptr) {
    Scene later = lab.scene();
    const double seconds_to_failure = later.state.time - before->time;
    later.state = *before;
    Remedy from_later = find_remedy(later, 2.0 * seconds_to_failure + 1.0, stops, default_remedy_work, report);
    from_later.from = before->time;
    if (from_later.cause != Remedy::Cause::NotReproduced) remedy = std::move(from_later);
  }
  return message + " " + describe(remedy, start->settings);
}

}  // namespace hooke
