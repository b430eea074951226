// The options common to all subcommands that run a scene, on the command line.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "batch/scene_options.h"
#include "cli/subcommand.h"

namespace hooke {

// Declares the options of meshes: --weld, --scale, --up, also as --mesh-weld and so on, for a subcommand that has another --scale.
void add_import_options(CLI::App& app, ImportOptions& options);

// Writes the size of a mesh and the warnings to stderr.
void print_notes(const LoadedScene& loaded);

// Declares SCENE, --integrator, --substeps, --frame-rate, --tolerance, --set and --quiet.
enum class SceneIs { Required, Optional };
std::shared_ptr<SceneOptions> add_scene_options(CLI::App& app, SceneIs scene = SceneIs::Required);

// The first option given that changes how a scene is read or stepped, such as "--substeps"; none if only SCENE and --quiet are given.
std::optional<std::string> first_stepping_option(const CLI::App& app);

// Declares --threads N, on which frames are computed; and --device.
void add_threads_option(CLI::App& app, int& threads);
void add_device_option(CLI::App& app, Device& device);
// Writes the renderer that computes the frames to stderr, if one does.
void print_device(const Execution& execution);

// Declares --fail-above: the limit of an ErrorLimit (batch/capture_report.h) [m].
void add_fail_above_option(CLI::App& app, std::optional<double>& limit);

// Declares --shard I/N, of which `shard` gets the text.
void add_shard_option(CLI::App& app, std::string& shard);

// Loads the scene and applies the options; warnings go to stderr. Throws UsageError, InputError, FileError.
Scene open_scene(const SceneOptions& options);

// Why the run of a scene opened with `options` stopped. Unless quiet also the cause and a remedy tested on copies for up to `seconds`
// [s]: takes a second or two. One line. Throws InputError if the network is too large for the method: nothing has diverged.
std::string explain_divergence(Lab& lab, const SceneOptions& options, double seconds, const State* before = nullptr);

}  // namespace hooke
