// A System with its State, built point by point and stepped without a laboratory: the test scene of the physics tests.
#pragma once

#include "sim/model/system.h"
#include "sim/plan/plan.h"
#include "sim/step/step.h"

namespace hooke {

struct TestSim {
  System system;
  State state;

  PointId add(const Vec3& position, double mass = 1.0, const Vec3& velocity = Vec3(0.0)) {
    const PointId id = system.new_point_id();
    system.append_point({.id = id, .mass = mass, .radius = 0.0});
    state.position.push_back(position);
    state.velocity.push_back(velocity);
    return id;
  }

  PointId nail(const Vec3& position) {
    const PointId id = add(position);
    system.point(system.index_of(id)).nailed = true;
    return id;
  }

  SpringId join(PointId first, PointId second, double stiffness, double rest_length, double damping = 0.0) {
    const SpringId id = system.new_spring_id();
    system.append_spring(
        {.id = id, .first = first, .second = second, .stiffness = stiffness, .damping = damping, .rest_length = rest_length});
    return id;
  }

  // Advances by `seconds` in this many equal steps, as one frame. Adaptive methods take each step whole: they start from a longer step and
  // accept any error.
  void run(const Integrator& integrator, double seconds, int steps) {
    state.memory = {.step = 1e9, .error = 1e-4};
    run(integrator, seconds, steps, 1e9);
    state.memory = {};
  }

  // The same, but adaptive methods choose their steps with this tolerance [m].
  void run(const Integrator& integrator, double seconds, int steps, double tolerance) {
    Plan plan = make_plan(system);
    Frame frame;
    frame.begin(plan, system, {.integrator = &integrator, .frame_rate = 1.0 / seconds, .substeps = steps, .tolerance = tolerance}, state);
    while (!frame.done()) frame.substep(plan);
    frame.end(plan, state);
  }

  const Vec3& position(PointId id) const { return state.position[system.index_of(id)]; }
  const Vec3& velocity(PointId id) const { return state.velocity[system.index_of(id)]; }
};

}  // namespace hooke
