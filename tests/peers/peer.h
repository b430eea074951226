// Other engines, and the methods of Hooke beside them, behind one interface: each is loaded with a problem and run at a setting from its
// start. Used by the program peers_bench and by a test.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/methods/integrator.h"
#include "study/problem.h"

namespace hooke {

struct PeerSetting {
  int snapshots = 4;  // the duration is divided into this many equal parts
  int steps = 1;      // in each of them
  int iterations = 1;
  double thickness_factor = 1.0;  // of the thickness of contact, if the engine has contact of faces
  double max_cpu_seconds = 20.0;  // a run is abandoned at the first snapshot after more
};

struct PeerRun {
  bool is_finished = false;          // false: the run diverged or was abandoned
  std::vector<State> snapshots;      // those that were reached
  std::vector<double> cpu_seconds;   // [s], of stepping to each of them alone, without setup and output
  double total_cpu_seconds() const;  // [s]
};

// An engine with one problem, which must outlive it. Each run starts at the start of the problem.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual PeerRun run(const PeerSetting& setting) = 0;

 protected:
  // Steps to each snapshot by `advance()` and takes the state by `read(state)`. Ends when positions are not finite or far away, or the CPU
  // time is too long.
  template <class Advance, class Read>
  static PeerRun take_snapshots(const Problem& problem, const PeerSetting& setting, const Advance& advance, const Read& read);
};

struct PeerKind {
  std::string id;        // in charts and tables
  double limit;          // the largest h omega of its steps; 0: none
  bool is_damped_apart;  // dashpots do not reduce that limit
  std::vector<int> iterations;
  // Why it cannot represent the problem; empty: it can.
  std::string (*obstacle)(const Problem& problem);
  std::unique_ptr<Peer> (*load)(const Problem& problem);
};

// The table of engines.
extern const PeerKind lammps_peer, mujoco_euler_peer, mujoco_runge_kutta_peer, bullet_soft_body_peer, bullet_deformable_peer,
    bullet_implicit_peer;
std::vector<const PeerKind*> other_engines();

// A method of Hooke.
std::unique_ptr<Peer> load_method(const Problem& problem, const Integrator& method);

// The accelerations at the start without drag [m/s^2], those of nails 0.
std::vector<Vec3> start_accelerations(const Problem& problem);

bool is_lost(const State& state, const Problem& problem);
double thread_seconds();

template <class Advance, class Read>
PeerRun Peer::take_snapshots(const Problem& problem, const PeerSetting& setting, const Advance& advance, const Read& read) {
  PeerRun run;
  for (int i = 0; i < setting.snapshots; ++i) {
    const double begin = thread_seconds();
    advance();
    run.cpu_seconds.push_back(thread_seconds() - begin);
    State state = problem.start;
    state.time = problem.seconds * (i + 1) / setting.snapshots;
    read(state);
    if (is_lost(state, problem) || run.total_cpu_seconds() > setting.max_cpu_seconds) return run;
    run.snapshots.push_back(std::move(state));
  }
  run.is_finished = true;
  return run;
}

}  // namespace hooke
