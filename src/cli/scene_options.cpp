#include "cli/scene_options.h"

#include <charconv>
#include <cmath>
#include <iostream>

#include "base/file_limits.h"
#include "base/printable.h"
#include "edit/apply.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "scene/flatness.h"
#include "scene/parameters.h"
#include "scene/step_limits.h"
#include "sim/integrator.h"
#include "study/remedy.h"

namespace hooke {
namespace {

std::string ids_of_integrators() {
  std::string ids;
  for (const Integrator& integrator : integrators()) ids += (ids.empty() ? "" : ", ") + std::string(integrator.id);
  return ids;
}

std::string names_of_parameters() {
  std::string names;
  for (const Parameter& parameter : parameters()) names += (names.empty() ? "" : ", ") + std::string(parameter.name);
  return names;
}

std::string ids_of_adaptive_integrators() {
  std::string ids;
  for (const Integrator& integrator : integrators())
    if (integrator.stability == Stability::Adaptive) ids += (ids.empty() ? "" : ", ") + std::string(integrator.id);
  return ids;
}

void set_tolerance(Settings& settings, double tolerance) {
  if (settings.integrator->stability != Stability::Adaptive)
    throw UsageError("--tolerance " + format_exact(tolerance) + ": requires an adaptive method: --integrator " +
                     ids_of_adaptive_integrators());
  settings.tolerance = tolerance;
}

std::string ids_of_choices(const Parameter& parameter) {
  std::string ids;
  for (const ParameterChoice& choice : parameter.choices) ids += (ids.empty() ? "" : ", ") + std::string(choice.id);
  return ids;
}

// The id of a choice; "0.5", and for switches also "on" and "off".
std::optional<double> parse_value(const Parameter& parameter, std::string_view text) {
  if (parameter.kind == Parameter::Kind::Switch) {
    if (text == "on" || text == "true" || text == "1") return 1.0;
    if (text == "off" || text == "false" || text == "0") return 0.0;
    return std::nullopt;
  }
  if (parameter.kind == Parameter::Kind::Choice) {
    for (std::size_t i = 0; i < parameter.choices.size(); ++i)
      if (text == parameter.choices[i].id) return static_cast<double>(i);
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// NAME=VALUE. A value out of range is an error here, not clamped.
SetParameter parse_setting(const std::string& setting) {
  const std::string shown = "--set " + printable(setting, 80);
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) throw UsageError(shown + ": must be NAME=VALUE");
  const Parameter* parameter = find_parameter(setting.substr(0, equals));
  if (parameter == nullptr) throw UsageError(shown + ": must name one of " + names_of_parameters());

  const auto value = parse_value(*parameter, std::string_view(setting).substr(equals + 1));
  if (parameter->kind == Parameter::Kind::Switch && !value) throw UsageError(shown + ": must be on or off");
  if (parameter->kind == Parameter::Kind::Choice && !value) throw UsageError(shown + ": must be one of " + ids_of_choices(*parameter));
  const Bounds range{.min = parameter->min, .max = parameter->max};
  if (!value || !range.contains(*value) || clamp_to(*parameter, *value) != *value)
    throw UsageError(shown + ": " + (parameter->kind == Parameter::Kind::Integer ? "must be whole, and " : "") + range.text() +
                     (parameter->unit.empty() ? "" : " [" + std::string(parameter->unit) + "]"));
  return {.parameter = parameter, .value = *value};
}

}  // namespace

CLI::Validator within(const Bounds& bounds) {
  const auto check = [bounds](std::string& text) {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
    return is_number && bounds.contains(value) ? std::string() : printable(text, 80) + ": " + bounds.text();
  };
  return CLI::Validator(check, "", "");
}

std::shared_ptr<SceneOptions> add_scene_options(CLI::App& app, SceneIs scene) {
  auto options = std::make_shared<SceneOptions>();
  app.add_option("SCENE", options->scene, "A file (" + readable_extensions() + "), or the name of a shipped scene")
      ->required(scene == SceneIs::Required);
  app.add_option("--integrator", options->integrator, "Method: " + ids_of_integrators())->type_name("ID");
  app.add_option("--substeps", options->substeps, "Integration steps per frame")
      ->type_name("N")
      ->check(within({.min = 1, .max = max_substeps}));
  app.add_option("--frame-rate", options->frame_rate, "Frames per simulated second [1/s]")->type_name("RATE")->check(within(positive));
  app.add_option("--tolerance", options->tolerance,
                 "Local error tolerance per step of an adaptive method (" + ids_of_adaptive_integrators() + ") [m]")
      ->type_name("METERS")
      ->check(within(positive));
  app.add_option("--set", options->settings, "Set a parameter; may be repeated: " + names_of_parameters())
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->take_all();
  app.add_flag("-q,--quiet", options->quiet, "Print no warnings, progress or summary");
  return options;
}

std::optional<std::string> first_stepping_option(const CLI::App& app) {
  for (const char* name : {"--integrator", "--substeps", "--frame-rate", "--tolerance", "--set"})
    if (app.count(name) > 0) return name;
  return std::nullopt;
}

Scene open_scene(const SceneOptions& options) {
  // check the command line before reading a large file
  const Integrator* integrator = options.integrator ? find_integrator(*options.integrator) : nullptr;
  if (options.integrator && integrator == nullptr)
    throw UsageError("--integrator " + printable(*options.integrator, 80) + ": must be one of " + ids_of_integrators());
  std::vector<SetParameter> settings;
  for (const std::string& setting : options.settings) settings.push_back(parse_setting(setting));

  LoadedScene loaded = load_file(find_scene(options.scene));
  Scene& scene = loaded.scene;
  // the warning about the step in the file does not apply once options change it
  if (const auto warning = step_warning(scene.system, scene.settings))
    std::erase_if(loaded.warnings, [&](const std::string& line) { return line.ends_with(*warning); });
  Effect effect;
  for (const SetParameter& setting : settings) {
    if (setting.parameter == &dimensions_parameter && setting.value == 0.0)
      if (const std::string reason = why_not_flat(scene.system, scene.state); !reason.empty())
        throw InputError(printable(options.scene, 80) + ": dimensions: 2: " + reason);
    apply(scene, setting, effect);
  }
  if (integrator != nullptr) scene.settings.integrator = integrator;
  if (options.substeps) scene.settings.substeps = *options.substeps;
  if (options.frame_rate) scene.settings.frame_rate = *options.frame_rate;
  if (options.tolerance) set_tolerance(scene.settings, *options.tolerance);

  if (!options.quiet) {
    for (const std::string& warning : loaded.warnings) std::cerr << "warning: " << warning << "\n";
    if (const auto warning = step_warning(scene.system, scene.settings)) std::cerr << "warning: " << *warning << "\n";
  }
  return std::move(loaded.scene);
}

std::string explain_divergence(Lab& lab, const SceneOptions& options, double seconds) {
  lab.publish();
  std::string message = lab.status()->diagnosis.message;
  if (options.quiet) return message;
  SceneOptions again = options;
  again.quiet = true;
  const std::atomic<bool> never = false;
  const Scene start = open_scene(again);
  return message + " " + describe(find_remedy(start, seconds, never), start.settings);
}

}  // namespace hooke
