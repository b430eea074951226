#include "cli/scene_options.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/errors.h"
#include "base/file_limits.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "device/gpu_device.h"
#include "formats/file_kind.h"
#include "scene/parameter_value.h"
#include "sim/forces/bands.h"

namespace hooke {

CLI::Validator within(const Bounds& bounds) {
  const auto check = [bounds](std::string& text) {
    const std::optional<double> value = parse_number(text);
    double any = 0.0;  // CLI11 knows numbers that are not finite, and reads 0x10 as 16 and 010 as 8
    const bool is_infinite = !value && CLI::detail::lexical_cast(text, any) && !std::isfinite(any);
    std::string reason = value ? why_refused(*value, bounds) : (is_infinite ? "not a finite number: " : "not a number: ") + bounds.text();
    if (!reason.empty()) return printable(text, 80) + ": " + reason;
    text = format_exact(*value);
    return reason;
  };
  return CLI::Validator(check, "", "");
}

CLI::Validator one_of(std::vector<std::string> names) {
  const auto check = [names = std::move(names)](std::string& text) {
    const auto at = std::ranges::find(names, text);
    if (at == names.end()) return printable(text, 80) + ": must be " + joined(names, {}, " or ");
    text = std::to_string(at - names.begin());
    return std::string();
  };
  return CLI::Validator(check, "", "");
}

void add_import_options(CLI::App& app, ImportOptions& options) {
  for (const ImportOption& row : import_options()) {
    const std::string name(row.name);
    const bool is_taken = app.get_option_no_throw("--" + name) != nullptr;
    app.add_option_function<std::string>((is_taken ? "" : "--" + name + ",") + "--mesh-" + name,
                                         [&row, &options](const std::string& text) { row.set(options, text); },
                                         std::string(row.description))
        ->type_name(std::string(row.value));
  }
}

void print_notes(const LoadedScene& loaded) {
  if (!loaded.summary.empty()) std::cerr << loaded.summary << "\n";
  for (const std::string& warning : loaded.warnings) std::cerr << "warning: " << warning << "\n";
}

std::shared_ptr<SceneOptions> add_scene_options(CLI::App& app, SceneIs scene) {
  auto options = std::make_shared<SceneOptions>();
  app.add_option("SCENE", options->scene, "A file (" + readable_extensions() + "), or the name of a shipped scene")
      ->required(scene == SceneIs::Required);
  app.add_option("--integrator", options->integrator, "Method: " + ids_of_integrators())->type_name("ID");
  app.add_option("--substeps", options->substeps, "Integration steps per frame")
      ->type_name("N")
      ->transform(within({.min = 1, .max = max_substeps}));
  app.add_option("--frame-rate", options->frame_rate, "Frames per simulated second [1/s]")->type_name("RATE")->transform(within(positive));
  app.add_option(
         "--tolerance", options->tolerance,
         "RMS error of the positions that a simulated second may add [m]; selects auto unless a method is named. With dop853: local error "
         "per step [m]")
      ->type_name("METERS")
      ->transform(within(positive));
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
  for (const ImportOption& row : import_options())
    if (const std::string name = "--mesh-" + std::string(row.name); app.count(name) > 0) return name;
  return std::nullopt;
}

void add_threads_option(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "Threads that compute a frame, with the same bits; scenes of less than 2000 points use one")
      ->type_name("N")
      ->transform(within({.min = 1, .max = max_parts}))
      ->capture_default_str();
}

void add_device_option(CLI::App& app, Device& device) {
  app.add_option("--device", device,
                 "cpu, the default, or gpu: compute shaders of OpenGL 4.3 step scenes of springs, nails, colliders and wind, with "
                 "symplectic_euler, velocity_verlet and velocity_verlet_explicit")
      ->type_name("cpu|gpu")
      ->transform(one_of({"cpu", "gpu"}));  // as Device lists them
}

void print_device(const Execution& execution) {
  if (const auto* gpu = dynamic_cast<const GpuDevice*>(execution.device.get())) std::cerr << "computed by " << gpu->renderer() << "\n";
}

void add_fail_above_option(CLI::App& app, std::optional<double>& limit) {
  app.add_option("--fail-above", limit,
                 "Exit with 1 if the accumulated error exceeds this or is not known, and name the first such frame [m]")
      ->type_name("METERS")
      ->transform(within(positive));
}

void add_shard_option(CLI::App& app, std::string& shard) {
  app.add_option("--shard", shard,
                 "Do only part I of N; run the parts in any order, on any machines, each with its own --out, and combine them with --merge")
      ->type_name("I/N");
}

Scene open_scene(const SceneOptions& options) {
  LoadedScene loaded = load_with_options(options);
  if (!options.quiet) print_notes(loaded);
  return std::move(loaded.scene);
}

std::string explain_divergence(Lab& lab, const SceneOptions& options, double seconds, const State* before) {
  lab.publish();
  if (const DiagnosisStatus& diagnosis = lab.status()->diagnosis; diagnosis.is_too_large)
    throw InputError(diagnosis.message + " Use an explicit method, such as velocity_verlet.");
  if (options.quiet) return explain_divergence(lab, nullptr, seconds);
  std::cerr << "Looking for the cause and for a setting that does not diverge...\n" << std::flush;
  // opened again, because a copy of a large scene is not kept during the run
  const Scene start = load_with_options(options).scene;
  return explain_divergence(lab, &start, seconds, {}, before);
}

}  // namespace hooke
