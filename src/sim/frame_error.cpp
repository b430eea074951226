#include "sim/frame_error.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/step.h"

namespace hooke {
namespace {

// Order of the positions on this scene.
int order_on(const Integrator& method, const System& system, const Plan& plan) {
  if (!plan.colliders.empty()) return method.order_contact;
  if (plan.has_dashpots()) return method.order_damped;
  return system.drag_rate() > 0.0 ? method.order_drag : method.order;
}

}  // namespace

double estimate_frame_error(const System& system, const Settings& settings, const State& state) {
  if (system.point_count() == 0) return 0.0;
  Plan plan = make_plan(system);
  Frame frame;
  const auto step = [&](int substeps, State& to) {
    Settings with = settings;
    with.substeps = substeps;
    to = state;
    if (!frame.broken().empty()) refresh_values(plan, system);
    frame.begin(plan, system, with, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, to);
  };

  State coarse, fine;
  step(settings.substeps, coarse);
  if (settings.integrator->stability == Stability::Adaptive) return frame.motion().local_error;
  step(2 * settings.substeps, fine);
  double sum = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3 apart = coarse.position[i] - fine.position[i];
    sum += glm::dot(apart, apart);
  }
  const double gain = std::exp2(order_on(*settings.integrator, system, plan));
  return std::sqrt(sum / system.point_count()) * gain / (gain - 1.0);
}

}  // namespace hooke
