#include "batch/engine/run_with_engine.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <optional>
#include <sstream>
#include <utility>

#include "base/atomic_write.h"
#include "base/errors.h"
#include "base/option_error.h"
#include "base/printable.h"
#include "base/text_lines.h"
#include "batch/engine/child_process.h"
#include "formats/lammps/lammps_dump.h"
#include "formats/lammps/lammps_model.h"
#include "lab/divergence_message.h"
#include "sim/forces/energy/energy.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

// A folder of its own for the files of one run, on a file system that all ranks see if TMPDIR is.
struct WorkFolder {
  std::filesystem::path path;

  WorkFolder() {
    std::error_code error;
    const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (error) {
      const char* given = std::getenv("TMPDIR");
      throw FileError("TMPDIR, the folder for temporary files: " + printable(given != nullptr ? given : "/tmp") + ": " + error.message());
    }
    std::string name = (parent / "hooke-engine-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw FileError(printable(name) + ": cannot be created");
    path = name;
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
};

constexpr const char *script_name = "scene.lmp", *data_name = "scene.data", *dump_name = "scene.dump";

std::vector<std::string> words_of(const std::string& command) {
  std::istringstream stream(command);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.empty()) throw UsageError("--engine: must be a command, such as \"mpirun -np 8 lmp\"");
  return words;
}

// CPU time of all processes that have ended and that this one started, directly or indirectly [s].
double cpu_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// The line that says why the engine failed: the first one with ERROR; else the first ones, or the last one, if LAMMPS was running.
struct EngineOutput {
  static constexpr std::size_t max_reason = 200;
  std::string error, first, last;
  void add(const std::string& line) {
    if (line.find_first_not_of(" \t\r-*=") == std::string::npos) return;
    if (error.empty() && line.find("ERROR") != std::string::npos) error = line;
    if (first.size() < max_reason) first += (first.empty() ? "" : " ") + line;
    last = line;
  }
  std::string reason() const { return printable(!error.empty() ? error : first.starts_with("LAMMPS") ? last : first, max_reason); }
  // Why the motion may be at fault: LAMMPS has lost points that are not finite, or cannot find the other end of a long spring.
  std::string cause_in_motion() const {
    if (error.find("Non-numeric") != std::string::npos || error.find("Lost atoms") != std::string::npos) return "the motion diverged";
    const bool is_spring = error.find("Bond atom") != std::string::npos && error.find("missing") != std::string::npos;
    return is_spring ? "the motion diverged, or a spring became longer than twice its length: use more substeps" : "";
  }
};

// The step in a line of LAMMPS's table of step, potential and kinetic energy; none if it is another line.
std::optional<long> step_in(const std::string& line) {
  std::string_view rest = line;
  const auto step = parse_number(next_token(rest)), potential = parse_number(next_token(rest)), kinetic = parse_number(next_token(rest));
  return step && potential && kinetic && next_token(rest).empty() ? std::optional(static_cast<long>(*step)) : std::nullopt;
}

Accuracy unknown_accuracy() {
  constexpr Measured unknown{.reason = "not measured with --engine"};
  Accuracy accuracy{.off_reason = unknown.reason};
  for (Measured* each :
       {&accuracy.frame, &accuracy.frame_max, &accuracy.accumulated, &accuracy.amplification, &accuracy.growth_rate, &accuracy.predictable})
    *each = unknown;
  return accuracy;
}

class EngineRun {
 public:
  EngineRun(Scene& scene, const EngineRequest& request, const RunHooks& hooks, const std::function<bool()>& should_continue)
      : scene_(scene),
        request_(request),
        hooks_(hooks),
        should_continue_(should_continue),
        words_(words_of(request.command)),
        shown_("--engine \"" + printable(request.command, 80) + "\": ") {
    check();
    initialize_supply(scene.system, scene.state);
    start_ = scene.state;
    frames_ = count_frames(request.run.seconds, scene.settings.frame_rate);
  }

  EngineResults run() {
    write_atomically(folder_.path / data_name, format_lammps_data(scene_));
    write_atomically(folder_.path / script_name, format_lammps_script(scene_, data_name, dump_name));
    compute();
    if (!results_.is_stopped) read_frames();
    results_.totals.seconds = scene_.state.time - start_.time;
    results_.totals.hash = hash_state(scene_.state);
    results_.totals.diverged = !results_.divergence.empty();
    return std::move(results_);
  }

 private:
  void check() const {
    if (request_.run.sample) check_option("sample", *request_.run.sample, positive);
    if (request_.run.accuracy != AccuracyMode::Off) throw UsageError("--accuracy: is not measured with --engine");
    const std::string method(default_integrator().id);
    if (scene_.settings.integrator != &default_integrator())
      throw UsageError("--engine: runs " + method + ", not " + std::string(scene_.settings.integrator->id) + ": add --integrator " +
                       method);
    refuse_unsupported(scene_, printable(request_.scene, 80));
    if (scene_.system.points().empty()) throw InputError(printable(request_.scene, 80) + ": points: must be at least 1");
  }

  long steps(long frames) const { return frames * scene_.settings.substeps; }

  // Calls `use(frame, is_sampled)` for the frames that are needed, in ascending order, the last one always, until it returns false.
  template <class Use>
  void for_needed_frames(Use use) const {
    SampleClock clock(request_.run.sample, scene_.settings.frame_rate, frames_);
    for (long frame = 0; frame <= frames_; ++frame) {
      const bool is_sampled = clock.is_due(frame);
      if ((is_sampled || hooks_.frame || frame == frames_) && !use(frame, is_sampled)) return;
    }
  }

  // The number of frames from one that the engine writes to the next.
  long frames_per_dump() const {
    long spacing = 0;
    for_needed_frames([&](long frame, bool) {
      spacing = std::gcd(spacing, frame);
      return spacing != 1;
    });
    return std::max(1l, spacing);
  }

  std::vector<std::string> command() const {
    const long report = std::max(1l, frames_ / 200);
    std::vector<std::string> words = words_;
    words.insert(words.end(), {"-in", script_name, "-log", "none", "-var", "steps", std::to_string(steps(frames_)), "-var", "every",
                               std::to_string(steps(frames_per_dump())), "-var", "report", std::to_string(steps(report))});
    return words;
  }

  // Runs the engine to its end.
  void compute() {
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = cpu_of_children();
    EngineOutput output;
    int code = 0;
    try {
      ChildProcess engine(command(), folder_.path);
      code = engine.wait(
          [&](const std::string& line) {
            output.add(line);
            if (const std::optional<long> step = step_in(line); step && hooks_.progress)
              hooks_.progress(*step / scene_.settings.substeps, frames_);
          },
          [&] { return !(results_.is_stopped = !should_continue_()); });
    } catch (const FileError& error) {
      throw FileError(shown_ + error.what());
    }
    if (results_.is_stopped) return;
    results_.totals.cpu_seconds = cpu_of_children() - cpu;
    results_.totals.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
    results_.totals.force_evaluations = steps(frames_) + 1;
    if (code == 0) return;
    const std::string cause = output.cause_in_motion();
    if (cause.empty())
      throw FileError(shown_ + "failed with exit code " + std::to_string(code) + (output.last.empty() ? "" : ": ") + output.reason());
    results_.divergence = shown_ + "stopped: " + cause + ": " + output.reason();
  }

  // Passes on the frames that it wrote, up to the last valid one.
  void read_frames() {
    if (!std::filesystem::exists(folder_.path / dump_name)) throw FileError(shown_ + "ended without writing a frame");
    const LammpsDrag drag(scene_);
    LammpsDump dump(folder_.path / dump_name, start_.position.size());
    const Accuracy accuracy = unknown_accuracy();
    for_needed_frames([&](long number, bool is_sampled) {
      if ((results_.is_stopped = !should_continue_())) return false;
      const State before = scene_.state;
      if (number > 0 && !read_frame(dump, drag, number)) return false;
      if (const auto divergence = find_divergence(scene_.system, scene_.state, compute_energy(scene_.system, scene_.state))) {
        results_.divergence = describe(*divergence, scene_.system);
        scene_.state = before;
        return false;
      }
      if (is_sampled && hooks_.sample) hooks_.sample(scene_.state, accuracy);
      was_last_sampled_ = is_sampled;
      return !hooks_.frame || hooks_.frame();
    });
    // as in a run without an engine, the last sample is the last valid state
    if (!results_.divergence.empty() && !was_last_sampled_ && hooks_.sample) hooks_.sample(scene_.state, accuracy);
  }

  // False if the run diverged before this frame. Throws FileError if it ended for another reason.
  bool read_frame(LammpsDump& dump, const LammpsDrag& drag, long number) {
    LammpsFrame frame;
    try {
      while (frame.step < steps(number) && dump.next(frame)) {
      }
    } catch (const InputError& error) {
      // a run that diverged may end within a frame
      if (results_.divergence.empty()) throw FileError(shown_ + error.what());
      return false;
    }
    if (frame.step < steps(number)) {
      if (results_.divergence.empty()) throw FileError(shown_ + "ended before frame " + std::to_string(number));
      return false;
    }
    const double duration = 1.0 / scene_.settings.frame_rate, first = start_.time / duration;
    const bool is_multiple = std::abs(first - std::round(first)) < 1e-6;
    scene_.state.time = ((is_multiple ? std::round(first) : first) + static_cast<double>(number)) * duration;
    const auto& points = scene_.system.points();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].nailed) continue;
      scene_.state.position[i] = frame.position[i];
      scene_.state.velocity[i] =
          frame.force.empty() ? frame.velocity[i] : drag.end_velocity(frame.velocity[i], frame.force[i] / points[i].mass);
    }
    return true;
  }

  Scene& scene_;
  const EngineRequest& request_;
  const RunHooks& hooks_;
  const std::function<bool()>& should_continue_;
  const std::vector<std::string> words_;
  const std::string shown_;  // the beginning of messages
  const WorkFolder folder_;
  State start_;
  long frames_ = 0;
  bool was_last_sampled_ = false;
  EngineResults results_;
};

}  // namespace

EngineResults run_with_engine(Scene& scene, const EngineRequest& request, const RunHooks& hooks,
                              const std::function<bool()>& should_continue) {
  return EngineRun(scene, request, hooks, should_continue).run();
}

}  // namespace hooke
