// The hashes of every scene under every method, for comparison between compilers, optimization levels, vector units and processors:
//   golden FILE            compares with the file; prints "hashes differences", and exits with 1 when there are differences
// golden FILE --part N   the same for every N-th hash
//   golden FILE --write    writes the file
// HOOKE_VECTORS limits the vector unit, by its name in Highway (SSE4, AVX2, ...; SCALAR: none).

#include <hwy/targets.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "formats/scene_file.h"
#include "sim/divergence.h"
#include "sim/hash.h"
#include "sim/integrator.h"
#include "sim/plan.h"
#include "sim/step.h"

namespace hooke {
namespace {

constexpr double seconds = 0.25;                        // of each run
constexpr Index small_points = 300, max_points = 1300;  // scenes above the first run for one frame; those above the second take too long
constexpr const char* header = "scene,method,substeps,seconds,hash";

// Runs the scene to its end or until the state is not finite, and describes the last state.
std::string run(const Scene& scene, const Integrator& method, long frames) {
  Settings settings = scene.settings;
  settings.integrator = &method;
  Plan plan = make_plan(scene.system);
  State state = scene.state;
  Frame frame;
  for (; frames > 0; --frames) {
    State next = state;
    frame.begin(plan, scene.system, settings, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, next);
    if (!is_finite(next)) break;
    state = std::move(next);
  }
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(hash_state(state)));
  return hash;
}

struct Row {
  std::string key;  // "scene,method,substeps,seconds"
  std::string hash;
};

// Every `part`-th row of the table of scenes and methods.
std::vector<Row> compute(std::size_t part) {
  std::vector<Row> rows;
  std::size_t number = 0;
  for (const ShippedScene& shipped : shipped_scenes()) {
    const Scene scene = load_scene(shipped.file).scene;
    if (scene.system.point_count() > max_points) continue;
    const bool is_small = scene.system.point_count() <= small_points;
    const long frames = is_small ? std::lround(seconds * scene.settings.frame_rate) : 1;
    for (const Integrator& method : integrators()) {
      if (number++ % part != 0) continue;
      char key[200];
      std::snprintf(key, sizeof key, "%s,%s,%d,%.4g", shipped.id.c_str(), std::string(method.id).c_str(), scene.settings.substeps,
                    static_cast<double>(frames) / scene.settings.frame_rate);
      rows.push_back({key, run(scene, method, frames)});
    }
  }
  return rows;
}

int write(const char* file, const std::vector<Row>& rows) {
  std::ofstream out(file);
  out << header << '\n';
  for (const Row& row : rows) out << row.key << ',' << row.hash << '\n';
  out.flush();
  return out ? 0 : 5;
}

int compare(const char* file, const std::vector<Row>& rows) {
  std::ifstream in(file);
  std::map<std::string, std::string> expected;
  for (std::string line; std::getline(in, line);) expected[line.substr(0, line.rfind(','))] = line.substr(line.rfind(',') + 1);
  int differences = 0;
  for (const Row& row : rows) {
    if (expected[row.key] == row.hash) continue;
    std::fprintf(stderr, "%s: %s, expected %s\n", row.key.c_str(), row.hash.c_str(), expected[row.key].c_str());
    ++differences;
  }
  std::printf("%zu %d\n", rows.size(), differences);
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
  if (count < 2) {
    std::fprintf(stderr, "usage: golden FILE [--part N | --write]\n");
    return 2;
  }
  if (const char* vectors = std::getenv("HOOKE_VECTORS"); vectors != nullptr && !limit_vectors(vectors)) {
    std::fprintf(stderr, "no such vector unit here: %s\n", vectors);
    return 2;
  }
  const std::string option = count > 2 ? words[2] : "";
  if (option == "--write") return write(words[1], compute(1));
  return compare(words[1], compute(option == "--part" && count > 3 ? std::strtoul(words[3], nullptr, 10) : 1));
}
