// The options common to all subcommands that run a scene.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/subcommand.h"
#include "lab/lab.h"
#include "scene/scene.h"

namespace hooke {

struct SceneOptions {
  std::string scene;  // a file, or the id of a shipped scene
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

// The first option given that changes how a scene is stepped, such as "--substeps"; none if only SCENE and --quiet are given.
std::optional<std::string> first_stepping_option(const CLI::App& app);

// Loads the scene and applies the options; warnings go to stderr. Throws UsageError, InputError, FileError.
Scene open_scene(const SceneOptions& options);

// Why the run of a scene opened with `options` stopped. Unless quiet also the cause and a remedy tested on copies for up to `seconds`
// [s]: takes a second or two. One line.
std::string explain_divergence(Lab& lab, const SceneOptions& options, double seconds);

}  // namespace hooke
