// LAMMPS as a process, with the input script that `hooke convert` writes: harmonic bonds and velocity Verlet, the same equations and the
// same method as Hooke's. Its CPU time is that of its loop over the steps, without output, as it reports it.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <sstream>

#include "base/bounds.h"
#include "formats/lammps/lammps_dump.h"
#include "formats/lammps/lammps_model.h"
#include "peers/peer.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

Scene scene_without_colliders(const Problem& problem) {
  Scene scene;
  scene.system = problem.system;
  scene.system.colliders.clear();
  scene.state = problem.start;
  return scene;
}

std::string lammps_obstacle(const Problem& problem) {
  std::string list;
  for (const std::string& what : unsupported_by_lammps(scene_without_colliders(problem))) list += (list.empty() ? "" : ", ") + what;
  return list;
}

std::string fields(std::initializer_list<double> numbers) {
  std::string text;
  for (const double number : numbers) text += " " + format_exact(number);
  return text;
}

// Colliders as indenters, a penalty force K depth^2 without friction: this one stops a point that falls by 1 m within 1 mm.
std::string indenters(const Problem& problem) {
  const double stiffness = 9.81 * problem.system.points().front().mass * 3.0 / 1e-9;
  const double radius = problem.system.points().front().radius;
  std::string text;
  for (const Collider& collider : problem.system.colliders) {
    const std::string fix = "fix indent" + std::to_string(text.size()) + " free indent" + fields({stiffness});
    if (const Sphere* ball = std::get_if<Sphere>(&collider.shape)) {
      text += fix + " sphere" + fields({ball->center.x, ball->center.y, ball->center.z, ball->radius + radius}) + " side out\n";
    } else if (const Plane* plane = std::get_if<Plane>(&collider.shape)) {
      const int axis = plane->normal.x != 0.0 ? 0 : plane->normal.y != 0.0 ? 1 : 2;
      text += fix + " plane " + "xyz"[axis] + fields({plane->point[axis] + radius}) + " lo\n";
    }
  }
  return text;
}

// "Loop time of 0.5 on 1 procs ..." less "Output | 0 | 0.01 | ...", times "98.7% CPU use ...", which means nothing for short loops.
double cpu_seconds_in(const std::string& log) {
  double loop = 0.0, output = 0.0, use = 100.0;
  std::istringstream stream(log);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("Loop time of ")) loop = std::strtod(line.c_str() + 13, nullptr);
    if (line.find("% CPU use") != std::string::npos) use = std::strtod(line.c_str(), nullptr);
    if (line.starts_with("Output") && line.find('|') != std::string::npos)
      output = std::strtod(line.c_str() + line.find('|', line.find('|') + 1) + 1, nullptr);
  }
  return (loop - output) * (loop > 0.1 ? use / 100.0 : 1.0);
}

class LammpsPeer : public Peer {
 public:
  explicit LammpsPeer(const Problem& problem) : problem_(problem), scene_(scene_without_colliders(problem)) {}

  PeerRun run(const PeerSetting& setting) override {
    const ScratchFolder scratch;
    const std::filesystem::path& folder = scratch.folder;
    scene_.settings = {.frame_rate = setting.snapshots / problem_.seconds, .substeps = setting.steps};
    std::string script = format_lammps_script(scene_, folder / "scene.data", folder / "scene.dump");
    script.insert(script.find("\nthermo_style"), indenters(problem_));
    std::ofstream(folder / "scene.lmp") << script;
    std::ofstream(folder / "scene.data") << format_lammps_data(scene_);
    const std::string all = std::to_string(static_cast<long>(setting.snapshots) * setting.steps);
    // MPI refuses to run as root, as programs in containers do
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMP_NUM_THREADS", "1", 1);
    const Outcome outcome = run_process({LAMMPS, "-in", folder / "scene.lmp", "-log", "none", "-var", "steps", all, "-var", "report", all});
    PeerRun run;
    if (outcome.code != 0) return run;
    // the time of all parts is known, not that of each
    run.cpu_seconds.assign(setting.snapshots, cpu_seconds_in(outcome.out) / setting.snapshots);
    LammpsDump dump(folder / "scene.dump", problem_.start.position.size());
    for (LammpsFrame frame; dump.next(frame);) {
      if (frame.step == 0) continue;
      State state = problem_.start;
      state.time = problem_.seconds * static_cast<double>(frame.step) / (static_cast<double>(setting.snapshots) * setting.steps);
      state.position = frame.position;
      state.velocity = frame.velocity;
      if (is_lost(state, problem_)) return run;
      run.snapshots.push_back(std::move(state));
    }
    run.is_finished = run.snapshots.size() == static_cast<std::size_t>(setting.snapshots);
    return run;
  }

 private:
  const Problem& problem_;
  Scene scene_;
};

}  // namespace

const PeerKind lammps_peer{.id = "lammps",
                           .limit = 2.0,
                           .is_damped_apart = false,
                           .iterations = {1},
                           .obstacle = lammps_obstacle,
                           .load = [](const Problem& problem) -> std::unique_ptr<Peer> { return std::make_unique<LammpsPeer>(problem); }};

}  // namespace hooke
