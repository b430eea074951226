// Stepping allocates no memory after the first frame. This program replaces malloc and counts every allocation.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "sim/forces/force_terms.h"
#include "support/convergence.h"
#include "support/nets.h"

// glibc's own implementations
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

static long allocations = 0;

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}

namespace hooke {
namespace {

class Allocation : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Methods, Allocation, testing::ValuesIn(every_method()), method_name);

// everything that a step can involve at once: dashpots, drag, contact with moving points, listed forces, a grab, length-limited springs,
// and breakable springs that do not break
TEST_P(Allocation, DoesNotHappenAfterTheFirstFrame) {
  for (const GrabKind kind : {GrabKind::Hold, GrabKind::Pull}) {
    TestSim sim = net(32, 1e4, 0.5);
    sim.system.drag = 0.3;
    sim.system.colliders.push_back({.shape = Sphere{.center = {0.5, -0.6, 0.1}, .radius = 0.1},
                                    .friction = 0.3,
                                    .path = {.amplitude = {0.1, 0.0, 0.0}, .spin = {0.0, 1.0, 0.0}}});
    sim.system.break_strain = 50.0;
    sim.system.strain_limit = 0.05;
    sim.system.faces.push_back({.points = {sim.system.points()[1].id, sim.system.points()[2].id, sim.system.points()[33].id}});
    for (const ForceTerm& term : force_terms()) sim.system.forces.push_back({.term = &term, .values = default_values(term)});
    sim.system.grab = Grab{.point = sim.system.points()[500].id, .kind = kind};
    State state = sim.state;
    state.hand = {.position = state.position[500], .target = state.position[500] + Vec3(0.01)};

    const Settings settings{.integrator = &method(), .frame_rate = 60.0, .substeps = method().stability == Stability::Conditional ? 20 : 2};
    Plan plan = make_plan(sim.system);
    Frame frame;
    for (int i = 0; i < 3; ++i) {
      const long before = allocations;
      frame.begin(plan, sim.system, settings, state);
      while (!frame.done()) frame.substep(plan);
      frame.end(plan, state);
      if (i > 0) {
        EXPECT_EQ(allocations - before, 0);
      }
    }
  }
  const long before = allocations;
  const auto* seen = new std::string(100, 'a');
  EXPECT_GE(allocations - before, 2);
  delete seen;
}

}  // namespace
}  // namespace hooke
