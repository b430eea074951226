#include "cli/commands/run.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iostream>
#include <map>
#include <numeric>

#include "base/printable.h"
#include "base/text_lines.h"
#include "cli/commands/run_report.h"
#include "cli/progress_bar.h"
#include "cli/scene_options.h"
#include "formats/point_cache.h"
#include "lab/lab.h"
#include "sim/hash.h"
#include "sim/integrator.h"
#include "study/run_monitor.h"

namespace hooke {
namespace {

struct RunOptions {
  std::shared_ptr<SceneOptions> scene;
  double seconds = 0.0;                   // [s]
  std::optional<double> sample;           // [s]
  std::optional<std::string> points;      // "0,5,9"; none: all
  std::optional<std::string> quantities;  // "time,y5"; none: time, energies, positions of the points
  std::optional<std::string> json, csv, pc2;
  std::optional<AccuracyMode> accuracy;  // none: full if an output contains it
};

double cpu_now() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Frames that cover `seconds`, tolerating rounding errors.
long count_frames(double seconds, double frame_rate) {
  constexpr double max = 1e15, round_off = 1e-9;
  const double frames = seconds * frame_rate;
  if (!(frames <= max)) throw UsageError("--seconds " + format_exact(seconds) + ": must be at most 1e15 frames");
  return static_cast<long>(std::ceil(frames * (1.0 - round_off) - round_off));
}

// Decides which frames are sampled: those that reach a multiple of the spacing, or only the last.
class SampleClock {
 public:
  SampleClock(std::optional<double> spacing, double frame_rate, long frames)
      : frames_per_sample_(spacing ? *spacing * frame_rate : 0.0), last_(frames) {}
  bool is_due(long frame) {
    if (frames_per_sample_ == 0.0) return frame == last_;
    constexpr double round_off = 1e-9;
    if (static_cast<double>(frame) < next_ * frames_per_sample_ * (1.0 - round_off)) return false;
    // at most one sample per frame: multiples within the same frame share it
    next_ = std::floor(static_cast<double>(frame) / frames_per_sample_ * (1.0 + round_off)) + 1.0;
    return true;
  }

 private:
  double frames_per_sample_, next_ = 0.0;
  long last_;
};

// "0,5,9", or all of them.
std::vector<Index> parse_points(const std::optional<std::string>& list, Index count) {
  std::vector<Index> points;
  if (!list) {
    points.resize(static_cast<std::size_t>(count));
    std::iota(points.begin(), points.end(), 0);
    return points;
  }
  const char* at = list->data();
  const char* const end = at + list->size();
  for (;;) {
    Index point = -1;
    const auto [after, error] = std::from_chars(at, end, point);
    const bool is_number = error == std::errc() && point >= 0 && point < count && (after == end || *after == ',');
    if (!is_number)
      throw UsageError("--points " + printable(*list, 80) + ": must be numbers from 0 to " + std::to_string(count - 1) +
                       ", separated by commas");
    points.push_back(point);
    if (after == end) return points;
    at = after + 1;
  }
}

std::vector<Quantity> wanted_quantities(const std::optional<std::string>& list, const std::vector<Index>& points, const System& system) {
  std::vector<Quantity> quantities;
  if (list) {
    const std::string unknown = parse_quantities(*list, system.point_count(), system.spring_count(), quantities);
    if (!unknown.empty()) throw UsageError("--quantities " + printable(unknown, 80) + ": must be one of " + quantity_names());
    return quantities;
  }
  parse_quantities("time,kinetic,elastic,gravitational,total", system.point_count(), system.spring_count(), quantities);
  for (const Index i : points)
    for (const char* component : {"x", "y", "z"})
      quantities.push_back(*find_quantity(component + std::to_string(i), system.point_count(), system.spring_count()));
  return quantities;
}

void print_summary(const RunOptions& options, const Scene& scene, const RunTotals& totals) {
  const Settings& settings = scene.settings;
  const auto count = [](Index number, const char* one, const char* many) { return pluralize(static_cast<std::size_t>(number), one, many); };
  std::cout << printable(options.scene->scene) << ": " << count(scene.system.point_count(), "point", "points") << ", "
            << count(scene.system.spring_count(), "spring", "springs") << "; " << settings.integrator->id << ", "
            << count(settings.substeps, "substep", "substeps") << " per frame, " << settings.frame_rate << " frames per second\n"
            << "simulated " << totals.seconds << " s in " << totals.wall_seconds << " s (" << totals.cpu_seconds << " s of CPU), "
            << totals.force_evaluations << " force evaluations\n"
            << "hash " << to_hexadecimal(totals.hash) << "\n";
}

int run(const RunOptions& options) {
  Lab lab(open_scene(*options.scene), KeepStart::No);
  const Scene& scene = lab.scene();
  const double start = scene.state.time;
  const long frames = count_frames(options.seconds, scene.settings.frame_rate);
  const std::vector<Index> points = parse_points(options.points, scene.system.point_count());

  // open the files first, so that an invalid path is reported before the work
  std::optional<JsonReport> json;
  std::optional<CsvReport> csv;
  if (options.json) json.emplace(*options.json, options.scene->scene, scene);
  if (options.csv) csv.emplace(*options.csv, wanted_quantities(options.quantities, points, scene.system));
  std::optional<PointCacheWriter> pc2;
  if (options.pc2) pc2.emplace(*options.pc2, scene.system.point_count());
  const bool has_accuracy = options.json || (options.csv && options.quantities && csv->needs_accuracy());
  lab.submit(SetAccuracy{options.accuracy.value_or(has_accuracy ? AccuracyMode::Full : AccuracyMode::Off)});
  lab.apply_pending();

  RunTotals totals;
  RunMonitor monitor(scene.system, scene.state, 0);
  const auto add_sample = [&] {
    const Accuracy accuracy = lab.accuracy();
    if (json) json->add_sample(scene.system, scene.state, accuracy, points);
    if (csv) csv->add_sample(scene.system, scene.state, accuracy);
  };
  SampleClock samples(options.sample, scene.settings.frame_rate, frames);
  {
    ProgressBar progress(frames, !options.scene->quiet);
    for (long frame = 0;; ++frame) {
      const bool is_sampled = samples.is_due(frame);
      if (is_sampled) {
        add_sample();
      }
      if (pc2) pc2->add(scene.state.position);
      if (frame == frames) break;

      const double cpu = cpu_now(), wall = wall_now();
      totals.diverged = !lab.step();
      const double measuring = lab.accuracy_cpu_seconds() - totals.accuracy_cpu_seconds;
      totals.cpu_seconds += std::max(0.0, cpu_now() - cpu - measuring);
      totals.wall_seconds += std::max(0.0, wall_now() - wall - measuring);
      totals.accuracy_cpu_seconds += measuring;
      totals.force_evaluations += lab.last_frame().force_evaluations();
      totals.factorizations += lab.last_frame().factorizations();
      if (totals.diverged) {
        // the last good state, unless it was already sampled
        if (!is_sampled) add_sample();
        break;
      }
      monitor.end_frame(scene.system, scene.state, lab.last_frame().motion());
      progress.show(frame + 1);
    }
  }
  totals.seconds = scene.state.time - start;
  totals.hash = hash_state(scene.state);

  if (json) json->finish(totals);
  if (csv) csv->finish();
  if (pc2) pc2->close();
  if (!options.json && !options.csv && !options.scene->quiet) print_summary(options, scene, totals);
  if (!options.scene->quiet)
    for (const std::string& warning : monitor.warnings(scene.system, {})) std::cerr << "warning: " << warning << "\n";
  if (!totals.diverged) return exit_code::success;
  std::cerr << explain_divergence(lab, *options.scene, options.seconds) << "\n";
  return exit_code::diverged;
}

}  // namespace

std::function<int()> declare_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  options->scene = add_scene_options(app);
  app.add_option("--seconds", options->seconds, "Simulated time, rounded up to whole frames [s]")
      ->required()
      ->type_name("S")
      ->check(within(not_negative));
  app.add_option("--sample", options->sample,
                 "Sample at the start and at the end of the first frame at or after each multiple of DT, without interpolation [s]; "
                 "default: only the last state")
      ->type_name("DT")
      ->check(within(positive));
  app.add_option("--points", options->points, "Points to sample, numbered from 0; default: all")->type_name("0,5,9");
  app.add_option("--json", options->json, "Write the run and its samples as JSON; - for stdout")->type_name("FILE");
  app.add_option("--csv", options->csv, "Write one row per sample: time, energies, positions; - for stdout")->type_name("FILE");
  app.add_option("--quantities", options->quantities, "Columns of --csv instead: " + quantity_names())->type_name("time,total,y5");
  app.add_option(
         "--accuracy", options->accuracy,
         "What is measured for --json and for quantities such as error: off; frame (the error of a frame and the energy balance, at "
         "a tenth of the cost of the run); full (also the accumulated error and the growth of small differences, at two and a half "
         "times the cost); default: full where it is written")
      ->type_name("off|frame|full")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, AccuracyMode>{{"off", AccuracyMode::Off}, {"frame", AccuracyMode::Frame}, {"full", AccuracyMode::Full}}));
  app.add_option("--pc2", options->pc2, "Write the positions of all points in every frame as a point cache")->type_name("FILE");
  return [options] { return run(*options); };
}

}  // namespace hooke
