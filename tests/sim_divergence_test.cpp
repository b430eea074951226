// The watch for divergence: what it takes for one, and what it does not.
#include <gtest/gtest.h>

#include "convergence.h"
#include "sim/divergence.h"
#include "trial.h"

namespace hooke {
namespace {

class Watch : public EveryMethod {
 protected:
  // Frames until the watch speaks, `most` if it stays silent.
  int frames_until_divergence(Trial& trial, int substeps, int most) {
    open_ledger(trial.system, trial.state);
    for (int frame = 0; frame < most; ++frame) {
      trial.run(method(), 1.0 / 60.0, substeps);
      if (find_divergence(trial.system, trial.state, compute_energy(trial.system, trial.state))) return frame;
    }
    return most;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, Watch, testing::ValuesIn(every_method()), method_name);

// a point has no extent, and nothing was put in but its height
TEST_P(Watch, LetsASinglePointFallAndBounce) {
  Trial trial;
  trial.add({0.0, 1.0, 0.0});
  trial.system.colliders = {{.shape = Plane{}, .restitution = 0.9}};
  EXPECT_EQ(frames_until_divergence(trial, 4, 300), 300);
}

// after 20 s the fall has 2e5 times the energy that a scene of 0.1 mm could hold, and explicit Euler h / t of it too much
TEST_P(Watch, LetsATinySceneFallFar) {
  Trial trial;
  trial.join(trial.add({0.0, 0.0, 0.0}), trial.add({1e-4, 0.0, 0.0}), 1.0, 1e-4);
  EXPECT_EQ(frames_until_divergence(trial, 1, 1200), 1200);
}

TEST_P(Watch, StopsASpringThatIsFarTooStiffForTheStep) {
  if (method().stability != Stability::None && method().stability != Stability::Conditional) return;
  Trial trial;
  trial.join(trial.nail(Vec3(0.0)), trial.add({0.0, -1.1, 0.0}), 1e8, 1.0);
  EXPECT_LT(frames_until_divergence(trial, 1, 60), 10);
}

}  // namespace
}  // namespace hooke
