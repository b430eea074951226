#include "peers/peer.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/threads/thread_time.h"
#include "sim/plan/plan.h"
#include "sim/step/step.h"
#include "study/benchmark.h"

namespace hooke {
namespace {

class HookePeer : public Peer {
 public:
  HookePeer(const Problem& problem, const Integrator& method) : problem_(problem), method_(method), plan_(make_plan(problem.system)) {}

  PeerRun run(const PeerSetting& setting) override {
    const Settings settings{
        .integrator = &method_, .frame_rate = setting.snapshots / problem_.seconds, .substeps = setting.steps * setting.iterations};
    State now = problem_.start;
    const auto advance = [&] {
      frame_.begin(plan_, problem_.system, settings, now);
      while (!frame_.done()) frame_.substep(plan_);
      frame_.end(plan_, now);
    };
    return take_snapshots(problem_, setting, advance, [&](State& state) { state = now; });
  }

 private:
  const Problem& problem_;
  const Integrator& method_;
  Plan plan_;
  Frame frame_;  // reused, so that data built once per topology is not counted as stepping
};

}  // namespace

double PeerRun::total_cpu_seconds() const { return std::accumulate(cpu_seconds.begin(), cpu_seconds.end(), 0.0); }

std::vector<const PeerKind*> other_engines() {
  return {&lammps_peer,           &mujoco_euler_peer,      &mujoco_runge_kutta_peer,
          &bullet_soft_body_peer, &bullet_deformable_peer, &bullet_implicit_peer};
}

std::unique_ptr<Peer> load_method(const Problem& problem, const Integrator& method) { return std::make_unique<HookePeer>(problem, method); }

std::vector<Vec3> start_accelerations(const Problem& problem) {
  const System& system = problem.system;
  const auto &x = problem.start.position, &v = problem.start.velocity;
  std::vector<Vec3> a(system.points().size(), system.gravity);
  for (const Spring& spring : system.springs()) {
    const Index i = system.index_of(spring.first), j = system.index_of(spring.second);
    const double length = glm::distance(x[i], x[j]);
    const Vec3 u = (x[j] - x[i]) / length;
    const Vec3 force = (spring.stiffness * (length - spring.rest_length) + spring.damping * glm::dot(u, v[j] - v[i])) * u;
    a[i] += force / system.points()[i].mass;
    a[j] -= force / system.points()[j].mass;
  }
  for (Index i = 0; i < system.point_count(); ++i)
    if (system.points()[i].nailed) a[i] = Vec3(0.0);
  return a;
}

bool is_lost(const State& state, const Problem& problem) {
  const double distance = rms_distance(problem.system, state, problem.start);
  return !std::isfinite(distance) || distance > 1e6 * problem.size;
}

double thread_seconds() { return thread_cpu_seconds(); }

}  // namespace hooke
