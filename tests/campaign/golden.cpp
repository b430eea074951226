// The hashes of every scene under every method and `auto`, for comparison between compilers, optimization levels, vector units and
// processors:
//   golden FILE            compares with the file; prints "hashes differences", and exits with 1 when there are differences
//   golden FILE --write    writes the file
// Options of a comparison:
//   --part N               only every N-th hash
//   --costs COSTS          writes the seconds of each hash to the file COSTS, or, if it exists, computes the cheapest first
//   --from N               without the first N
//   --seconds S            ends after S seconds; what is left is compared by the next run, with --from
// HOOKE_VECTORS limits the vector unit, by its name in Highway (SSE2, AVX2, ...; SCALAR: none).

#include <hwy/targets.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "formats/scene_file.h"
#include "sim/control/automatic.h"
#include "sim/control/frame_runner.h"
#include "sim/methods/integrator.h"
#include "sim/model/hash.h"
#include "sim/plan/plan.h"
#include "sim/step/divergence.h"

namespace hooke {
namespace {

constexpr double seconds = 0.25;                        // of each run
constexpr Index small_points = 300, max_points = 1300;  // scenes above the first run for one frame; those above the second take too long
constexpr double automatic_tolerance = 1e-3;            // [m]
constexpr const char* header = "scene,method,substeps,seconds,hash";

struct Run {
  std::string key;  // "scene,method,substeps,seconds"
  std::shared_ptr<const Scene> scene;
  const Integrator* method;
  long frames;
};

// Every `part`-th row of the table of scenes and methods.
std::vector<Run> all_runs(std::size_t part) {
  std::vector<Run> runs;
  std::size_t number = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const auto scene = std::make_shared<const Scene>(load_scene(shipped.file).scene);
    if (scene->system.point_count() > max_points) continue;
    const bool is_small = scene->system.point_count() <= small_points;
    const long frames = is_small ? std::lround(seconds * scene->settings.frame_rate) : 1;
    const auto add = [&](const Integrator& method) {
      if (number++ % part != 0) return;
      char key[200];
      std::snprintf(key, sizeof key, "%s,%s,%d,%.4g", shipped.id.c_str(), std::string(method.id).c_str(), scene->settings.substeps,
                    static_cast<double>(frames) / scene->settings.frame_rate);
      runs.push_back({key, scene, &method, frames});
    };
    for (const Integrator& method : integrators()) add(method);
    add(automatic_method());
  }
  return runs;
}

// Runs the scene to its end or until the state is not finite, and describes the last state.
std::string hash_of(const Run& run) {
  Settings settings = run.scene->settings;
  settings.integrator = run.method;
  if (is_automatic(settings)) settings.tolerance = automatic_tolerance;
  Plan plan = make_plan(run.scene->system);
  State state = run.scene->state;
  FrameRunner frame;
  for (long left = run.frames; left > 0; --left) {
    State next = state;
    frame.begin(plan, run.scene->system, settings, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, next);
    if (!is_finite(next)) break;
    state = std::move(next);
  }
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_state(state)));
  return hash;
}

int write(const char* file) {
  std::ofstream out(file);
  out << header << '\n';
  for (const Run& run : all_runs(1)) out << run.key << ',' << hash_of(run) << '\n';
  out.flush();
  return out ? 0 : 5;
}

// What follows the last comma of each line, by what precedes it.
std::map<std::string, std::string> read_rows(const std::string& file) {
  std::ifstream in(file);
  std::map<std::string, std::string> rows;
  for (std::string line; std::getline(in, line);) rows[line.substr(0, line.rfind(','))] = line.substr(line.rfind(',') + 1);
  return rows;
}

// Sorts by the seconds of an earlier run; what is not in it comes last.
void sort_cheapest_first(std::vector<Run>& runs, const std::map<std::string, std::string>& costs) {
  const auto cost = [&](const Run& run) {
    const auto found = costs.find(run.key);
    return found == costs.end() ? std::numeric_limits<double>::infinity() : std::atof(found->second.c_str());
  };
  std::ranges::stable_sort(runs, {}, cost);
}

struct Options {
  std::size_t part = 1, from = 0;
  double seconds = std::numeric_limits<double>::infinity();
  std::string costs;
};

int compare(const char* file, const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); };
  const auto start = Clock::now();
  const std::map<std::string, std::string> expected = read_rows(file);
  std::map<std::string, std::string> costs;
  if (!options.costs.empty()) costs = read_rows(options.costs);
  std::ofstream new_costs;
  if (!options.costs.empty() && costs.empty()) new_costs.open(options.costs);

  std::vector<Run> runs = all_runs(options.part);
  sort_cheapest_first(runs, costs);
  int compared = 0, differences = 0;
  for (std::size_t i = options.from; i < runs.size() && seconds_since(start) < options.seconds; ++i, ++compared) {
    const Run& run = runs[i];
    const auto before = Clock::now();
    const std::string hash = hash_of(run);
    if (new_costs.is_open()) new_costs << run.key << ',' << seconds_since(before) << '\n';
    const auto found = expected.find(run.key);
    if (found != expected.end() && found->second == hash) continue;
    std::fprintf(stderr, "%s: %s, expected %s\n", run.key.c_str(), hash.c_str(), found == expected.end() ? "" : found->second.c_str());
    ++differences;
  }
  std::printf("%d %d\n", compared, differences);
  return differences > 0 ? 1 : 0;
}

// Allows only vector units up to the named one (weaker units have higher bits). Returns false if this processor lacks it.
bool limit_vectors(const std::string& name) {
  const std::int64_t supported = hwy::SupportedTargets();
  for (int bit = 0; bit < 62; ++bit) {
    const std::int64_t target = std::int64_t{1} << bit;
    if (name != hwy::TargetName(target)) continue;
    if ((supported & target) == 0) return false;
    hwy::SetSupportedTargetsForTest(supported & ~(target - 1));
    return true;
  }
  return false;
}

}  // namespace
}  // namespace hooke

int main(int count, char** words) {
  using namespace hooke;
  const auto usage = [] {
    std::fprintf(stderr, "usage: golden FILE [--part N] [--costs FILE] [--from N] [--seconds S] | --write\n");
    return 2;
  };
  if (count < 2) return usage();
  if (const char* vectors = std::getenv("HOOKE_VECTORS"); vectors != nullptr && !limit_vectors(vectors)) {
    std::fprintf(stderr, "no such vector unit here: %s\n", vectors);
    return 2;
  }
  if (count == 3 && words[2] == std::string("--write")) return write(words[1]);
  if (count % 2 != 0) return usage();
  Options options;
  for (int i = 2; i < count; i += 2) {
    const std::string option = words[i];
    if (option == "--part")
      options.part = std::max(1ul, std::strtoul(words[i + 1], nullptr, 10));
    else if (option == "--costs")
      options.costs = words[i + 1];
    else if (option == "--from")
      options.from = std::strtoul(words[i + 1], nullptr, 10);
    else if (option == "--seconds")
      options.seconds = std::atof(words[i + 1]);
    else
      return usage();
  }
  return compare(words[1], options);
}
