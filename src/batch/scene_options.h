// The options common to all commands that run a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edit/setting_text.h"
#include "formats/import_options.h"
#include "formats/scene_file.h"
#include "lab/lab.h"

namespace hooke {

// How a scene is stepped, where it differs from its file.
struct SteppingOptions {
  std::optional<std::string> integrator;
  std::optional<std::int64_t> substeps;
  std::optional<double> frame_rate;   // [1/s]
  std::optional<double> tolerance;    // [m]
  std::vector<std::string> settings;  // NAME=VALUE
  bool operator==(const SteppingOptions&) const = default;
};

struct SceneOptions : SteppingOptions {
  std::string scene;  // a file, or the id of a shipped scene
  ImportOptions import;
  bool quiet = false;
};

// "dop853, ..."
std::string ids_of_adaptive_integrators();

// Applies the options to a scene that was loaded from `name`. Throws UsageError, InputError.
void set_options(Scene& scene, const SteppingOptions& options, const std::string& name);

// Sets the options of a scene loaded from `name`, and replaces the warning about its step. Throws UsageError, InputError.
void apply_options(LoadedScene& loaded, const SteppingOptions& options, const std::string& name);

// How frames are computed.
class GpuDevice;
enum class Precision { Double, Single };
enum class Device { Cpu, Gpu };
struct ExecutionOptions {
  int threads = 1;
  Precision precision = Precision::Double;
  Device device = Device::Cpu;
};
// Throws UsageError where this machine has none.
std::shared_ptr<GpuDevice> open_gpu();
// Throws UsageError where the scene needs double precision or the processor, and where this machine has no such device.
Execution make_execution(const Lab& lab, const ExecutionOptions& options);

// Loads the scene and applies the options. Throws UsageError, before reading a large file, InputError, FileError.
LoadedScene load_with_options(const SceneOptions& options);

// Why the run stopped, in one line. With `start`, the scene as it was opened, also the cause and a remedy tested on copies for up to
// `seconds` [s]: takes a second or two. If the search from the start reaches its work limit before the divergence, it is repeated from
// `before`, a state shortly before the divergence. `progress` is called before every test, and may throw.
std::string explain_divergence(Lab& lab, const Scene* start, double seconds, const std::function<void()>& progress = {},
                               const State* before = nullptr);

}  // namespace hooke
