#include "lab/loads.h"

#include "sim/forces/energy/energy.h"
#include "sim/forces/forces.h"

namespace hooke {

Loads compute_loads(const Lab& lab) {
  const Plan& plan = lab.plan();
  const System& system = lab.scene().system;
  const State& state = lab.scene().state;
  Loads loads;
  for (const Spring& spring : system.springs()) {
    loads.tension.push_back(tension(system, state, spring));
    loads.energy.push_back(elastic_energy(system, state, spring));
  }

  Motion motion;
  pack(plan, state, motion);
  const auto unpacked = [&](const Field& f) {
    std::vector<Vec3> vectors(state.position.size(), Vec3(0.0));
    for (Index i = 0; i < plan.points; ++i) vectors[i] = vector_at(plan, f, i);
    return vectors;
  };
  Field f = motion.x;
  compute_external_forces(plan, state.time, motion.x, motion.v, f);
  loads.external = unpacked(f);
  // reactions of nails, and of rollers along their fixed axes: the opposite of all forces but those of the rollers
  compute_unlisted_forces(plan, state.time, motion.x, plan.has_dashpots() ? &motion.v : nullptr, f);
  for (const Force& force : plan.forces)
    if (force.term != &roller_force) force.term->add(plan, force.values, state.time, motion.x.data(), motion.v.data(), f.data());
  loads.reaction = unpacked(f);
  for (Index i = 0; i < system.point_count(); ++i) {
    Vec3& reaction = loads.reaction[i];
    reaction = plan.inverse_mass[i] == 0.0 ? -reaction : free_part(plan, i, reaction) - reaction;
  }

  loads.contact = contact_forces(lab);
  return loads;
}

std::vector<Vec3> contact_forces(const Lab& lab) {
  const Plan& plan = lab.plan();
  const Field& impulse = lab.last_frame().motion().contact;
  std::vector<Vec3> forces(lab.scene().state.position.size(), Vec3(0.0));
  if (impulse.size() != static_cast<std::size_t>(plan.dimensions) * static_cast<std::size_t>(plan.points)) return forces;
  for (Index i = 0; i < plan.points; ++i) forces[i] = lab.scene().settings.frame_rate * vector_at(plan, impulse, i);
  return forces;
}

}  // namespace hooke
