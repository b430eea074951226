#include "sim/frame_error.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/step.h"

namespace hooke {
namespace {

// Order of the positions on this scene.
int effective_order(const Integrator& method, const System& system, const Plan& plan) {
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
    Settings frame_settings = settings;
    frame_settings.substeps = substeps;
    to = state;
    if (!frame.broken().empty()) refresh_values(plan, system);
    frame.begin(plan, system, frame_settings, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, to);
  };

  State coarse, fine;
  step(settings.substeps, coarse);
  if (settings.integrator->stability == Stability::Adaptive) return frame.motion().local_error;
  step(2 * settings.substeps, fine);
  double sum = 0.0;
  for (Index i = 0; i < system.point_count(); ++i) {
    const Vec3 difference = coarse.position[i] - fine.position[i];
    sum += glm::dot(difference, difference);
  }
  const double factor = std::exp2(effective_order(*settings.integrator, system, plan));
  return std::sqrt(sum / system.point_count()) * factor / (factor - 1.0);
}

}  // namespace hooke
