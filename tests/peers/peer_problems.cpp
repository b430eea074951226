#include "peers/peer_problems.h"

#include <glm/common.hpp>
#include <utility>

#include "base/formatted.h"
#include "formats/scene_file.h"
#include "sim/step/divergence.h"
#include "support/folds.h"

namespace hooke {
namespace {

Problem cloth_problem(int n, double seconds, const char* nails, const char* members) {
  const std::string text = formatted(
      R"({"hooke": 1, "gravity": [0, 0, -9.81], "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0], "down": [0, -1, 0],
          "points": [%d, %d], "density": 0.2, "stiffness": 1000, "shear_stiffness": 500, "mass_model": "equal", "point_radius": 0.004%s}]%s})",
      n, n, nails, members);
  Problem problem = make_problem("cloth_" + std::to_string(n), parse_scene(text, "cloth").scene);
  problem.title = formatted("cloth %d x %d, k = 1e3 N/m, nailed at two corners", n, n);
  problem.seconds = seconds;
  return problem;
}

Problem built_in(const char* id, double seconds) {
  Problem problem = find_problem(id)->make();
  problem.seconds = seconds;
  return problem;
}

}  // namespace

Problem peer_cloth(int n, double seconds) { return cloth_problem(n, seconds, R"(, "nail": ["top_left", "top_right"])", ""); }

Problem cloth_on_ball_and_floor(int n, double seconds) {
  return cloth_problem(n, seconds, "", R"(, "colliders": [
      {"type": "sphere", "center": [0.5, -0.5, -0.35], "radius": 0.3, "friction": 0.3},
      {"type": "plane", "point": [0, 0, -0.66], "normal": [0, 0, 1], "friction": 0.3}])");
}

Problem cloth_in_folds(int n, double seconds) {
  TestSim sim = dropped_sheet(n);
  folds::touch(sim);
  initialize_supply(sim.system, sim.state);
  return {.id = "folds", .title = "a cloth that falls into its own folds", .system = sim.system, .start = sim.state, .seconds = seconds};
}

Problem with_dashpots(Problem problem, double damping) {
  for (Index i = 0; i < problem.system.spring_count(); ++i) problem.system.spring(i)->damping = damping;
  problem.id += "_dashpots";
  append_formatted(problem.title, ", d = %g N s/m", damping);
  initialize_supply(problem.system, problem.start);
  return problem;
}

std::vector<Problem> peer_problems() {
  return {built_in("drum_32", 0.5), with_dashpots(built_in("drum_32", 0.5), 0.02),
          built_in("rope_64", 0.5), peer_cloth(32, 0.5),
          peer_cloth(64, 0.25),     peer_cloth(128, 0.125)};
}

}  // namespace hooke
