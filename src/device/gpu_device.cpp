#include "device/gpu_device.h"

#include <stdexcept>

#include "device/constants.h"
#include "sim/methods/rows.h"

namespace hooke {

std::string needs_processor(const Plan& plan, const Integrator& method) {
  if (&method != &symplectic_euler && &method != &velocity_verlet && &method != &velocity_verlet_explicit)
    return "the method " + std::string(method.id) + " (symplectic_euler, velocity_verlet and velocity_verlet_explicit run there)";
  if (plan.pairs.on) return "contact of points with each other";
  if (plan.surface.on) return "contact of faces and springs";
  if (!plan.one_way.empty()) return "planes that act one way";
  if (plan.colliders.size() > max_device_colliders) return "more than " + std::to_string(max_device_colliders) + " colliders";
  if (!plan.spring.max_length.empty()) return "the strain limit";
  for (const Force& force : plan.forces)
    if (force.term->id != "wind") return "the force " + std::string(force.term->id);
  if (plan.forces.size() > 1) return "more than one wind";
  for (const LawSpring& spring : plan.spring.laws.springs) {
    if (spring.law.moves()) return "springs whose rest length moves";
    if (spring.law.force == SpringForce::Strut) return "struts";
    if (spring.law.force == SpringForce::Cubic) return "springs with a cubic force";
  }
  if (plan.points > max_device_points) return "more than " + std::to_string(max_device_points) + " points";
  if (plan.points == 0) return "a scene without points";
  return {};
}

std::string GpuDevice::refusal(const Plan& plan, const Integrator& method) const {
  if (!failure_.empty()) return "the GPU stopped: " + failure_;
  const std::string needs = needs_processor(plan, method);
  return needs.empty() ? "" : "not on the GPU: " + needs;
}

bool GpuDevice::advance(Plan& plan, const FrameSteps& steps, Motion& motion, std::vector<Index>& broken) {
  if (steps.locates_breaks || !refusal(plan, steps.method).empty()) return false;
  try {
    context_.run(
        [&](const GlFunctions& gl) { (plan.execution.single != nullptr ? single_ : double_).advance(gl, plan, steps, motion, broken); });
  } catch (const std::exception& error) {  // also where memory for its results is missing
    failure_ = error.what();
    return false;
  }
  return true;
}

std::string describe_gpu() {
  try {
    return "GPU: " + ComputeContext().renderer();
  } catch (const std::runtime_error& error) {
    return "GPU: " + std::string(error.what());
  }
}

bool has_graphics_card() {
  try {
    return ComputeContext().is_card();
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace hooke
