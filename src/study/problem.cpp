#include "study/problem.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "formats/scene_file.h"
#include "sim/model/bounding_box.h"
#include "sim/model/hash.h"
#include "sim/step/divergence.h"
#include "study/analytic_scenes.h"

namespace hooke {
namespace {

Problem make(std::string id, std::string title, InitialState start) {
  initialize_supply(start.system, start.state);
  return {.id = std::move(id), .title = std::move(title), .system = std::move(start.system), .start = std::move(start.state)};
}

Problem shipped(const std::string& id, std::string title, double seconds) {
  Problem problem = make_problem(id, load_scene(find_scene(id)).scene);
  problem.title = std::move(title);
  problem.seconds = seconds;
  return problem;
}

}  // namespace

std::span<const BuiltInProblem> built_in_problems() {
  static const std::array rows{
      BuiltInProblem{"net_w2", true, [] { return make("net_w2", "net 16 x 16, k = 1e2 N/m", make_net(16, 1e2, 0.0)); }},
      BuiltInProblem{"net_w4", true, [] { return make("net_w4", "net 16 x 16, k = 1e4 N/m", make_net(16, 1e4, 0.0)); }},
      BuiltInProblem{"net_w4d", true, [] { return make("net_w4d", "net 16 x 16, k = 1e4 N/m, d = 0.9 N s/m", make_net(16, 1e4, 0.9)); }},
      BuiltInProblem{"net_w6", true, [] { return make("net_w6", "net 16 x 16, k = 1e6 N/m", make_net(16, 1e6, 0.0)); }},
      BuiltInProblem{"net_w6d", false, [] { return make("net_w6d", "net 16 x 16, k = 1e6 N/m, d = 9 N s/m", make_net(16, 1e6, 9.0)); }},
      BuiltInProblem{"net_w8d", false, [] { return make("net_w8d", "net 16 x 16, k = 1e8 N/m, d = 90 N s/m", make_net(16, 1e8, 90.0)); }},
      BuiltInProblem{"net_we", false, [] { return make("net_we", "net 16 x 16, k = 1e4 N/m, d = 1e3 N s/m", make_net(16, 1e4, 1e3)); }},
      BuiltInProblem{"drum_32", false, [] { return shipped("drum_32", "drum 32 x 32, k = 1e3 N/m, nailed all around", 1.0); }},
      BuiltInProblem{"rope_64", true, [] { return shipped("rope_64", "rope of 64 points, k = 1e4 N/m, released horizontally", 0.5); }},
      BuiltInProblem{"cloth_32", false, [] { return shipped("cloth_32", "cloth 32 x 32, k = 1e3 N/m, nailed at two corners", 0.5); }},
      BuiltInProblem{"chain_1000", true,
                     [] { return make("chain_1000", "chain of 200 links, the last 1000 times as heavy", make_chain(200, 1e3)); }},
      BuiltInProblem{"curtain_b", true,
                     [] {
                       Problem curtain = make("curtain_b", "curtain 16 x 16, k = 1e4 N/m, buckling", make_curtain(16, 1e4, 0.0));
                       curtain.measure = Measure::Observables;
                       return curtain;
                     }},
  };
  return rows;
}

const BuiltInProblem* find_problem(std::string_view id) {
  for (const BuiltInProblem& row : built_in_problems())
    if (row.id == id) return &row;
  return nullptr;
}

Problem make_problem(const std::string& id, const Scene& scene) {
  Problem problem{.id = id, .title = scene.name.empty() ? id : scene.name, .system = scene.system, .start = scene.state};
  problem.start.time = 0.0;
  initialize_supply(problem.system, problem.start);

  const double largest = bounding_box(problem.start.position).longest_side();
  problem.size = largest > 0.0 ? largest : 1.0;
  return problem;
}

std::uint64_t fingerprint(const Problem& problem) {
  // a scene file contains everything that determines the motion, exactly
  Scene scene;
  scene.system = problem.system;
  scene.state = problem.start;
  std::string text = format_scene(scene);
  text += ' ' + std::to_string(std::bit_cast<std::uint64_t>(problem.seconds)) + ' ' +
          std::to_string(std::bit_cast<std::uint64_t>(problem.size)) + ' ' + std::to_string(static_cast<int>(problem.measure));
  return hash_bytes(text);
}

}  // namespace hooke
