// The options that every subcommand with a scene has in common.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/subcommand.h"
#include "scene/scene.h"

namespace hooke {

struct SceneOptions {
  std::string scene;  // a file, or the id of a scene that ships
  std::optional<std::string> integrator;
  std::optional<int> substeps;
  std::optional<double> frame_rate;   // [1/s]
  std::optional<double> tolerance;    // [m]
  std::vector<std::string> settings;  // NAME=VALUE
  bool quiet = false;
};

// Declares SCENE, --integrator, --substeps, --frame-rate, --tolerance, --set and --quiet.
enum class SceneIs { Required, Optional };
std::shared_ptr<SceneOptions> add_scene_options(CLI::App& app, SceneIs scene = SceneIs::Required);

// The first of the options that say how a scene is stepped, if any is given: "--substeps"; none for nothing but SCENE and --quiet.
std::optional<std::string> first_stepping_option(const CLI::App& app);

// Loads the scene and sets what the options say; warnings go to stderr. Throws UsageError, InputError, FileError.
Scene open_scene(const SceneOptions& options);

}  // namespace hooke
