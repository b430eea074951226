#include "device/gpu_device.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "device/constants.h"
#include "sim/forces/energy/plan_energy.h"
#include "sim/methods/rows.h"

namespace hooke {
namespace {

// The device does not measure works. What the energy changes in a frame is booked as the work of the first of these that the scene has; in
// one with none of them, what no cause explains is still the method's.
std::optional<EnergyCause> cause_of(const Plan& plan) {
  if (plan.hand.held || plan.hand.pull) return EnergyCause::Hand;
  if (plan.collider_paths.any_moves) return EnergyCause::Colliders;
  if (!plan.forces.empty() || plan.acceleration != plan.gravity) return EnergyCause::Forces;  // moving air
  if (plan.has_contact()) return EnergyCause::Contact;
  if (plan.drag > 0.0) return EnergyCause::Drag;
  if (plan.has_dashpots()) return EnergyCause::Dashpots;
  return std::nullopt;
}

}  // namespace

std::string needs_processor(const Plan& plan, const Integrator& method) {
  if (&method != &symplectic_euler && &method != &velocity_verlet && &method != &velocity_verlet_explicit)
    return "the method " + std::string(method.id) + ": symplectic_euler, velocity_verlet and velocity_verlet_explicit run there";
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
  const std::optional<EnergyCause> cause = cause_of(plan);
  const double before = cause ? mechanical_energy(plan, motion.time, motion) : 0.0;
  try {
    context_.run(
        [&](const GlFunctions& gl) { (plan.execution.single != nullptr ? single_ : double_).advance(gl, plan, steps, motion, broken); });
  } catch (const std::exception& error) {  // also where memory for its results is missing
    failure_ = error.what();
    return false;
  }
  if (cause && broken.empty()) {
    const double change = mechanical_energy(plan, motion.time, motion) - before;
    motion.energy.add(*cause, *cause >= EnergyCause::Drag ? std::min(0.0, change) : change);
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
