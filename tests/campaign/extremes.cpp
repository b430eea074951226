// For any parameters, no state with non-finite numbers is published: the run stops, keeps the last valid state, names the item that failed
// first and recommends a remedy.

#include <cmath>

#include "campaign/check.h"
#include "campaign/random_document.h"
#include "lab/lab.h"
#include "sim/methods/integrator.h"
#include "support/valid_scene.h"

namespace hooke {
namespace {

constexpr int frames = 4;

// Over twenty orders of magnitude in both directions.
double extreme(Random& random) { return std::pow(10.0, random.uniform(-20.0, 20.0)); }

Scene extreme_scene(Random& random) {
  Scene scene = random_document(random, Numbers::Ordinary);
  scene.settings.substeps = 1 + static_cast<int>(random.below(6));
  // an adaptive method takes as many steps as it needs, which may take too long, so it gets no extreme parameters
  if (scene.settings.integrator->stability == Stability::Adaptive) return scene;
  for (Index i = 0; i < scene.system.point_count(); ++i) {
    if (random.one_in(3)) scene.system.point(i).mass = extreme(random);
    if (random.one_in(6)) scene.state.position[i] *= extreme(random);
    if (random.one_in(6)) scene.state.velocity[i] *= extreme(random);
  }
  for (Index s = 0; s < scene.system.spring_count(); ++s) {
    SpringEdit spring = scene.system.spring(s);
    if (random.one_in(3)) spring->stiffness = extreme(random);
    if (random.one_in(3)) spring->damping = extreme(random);
    if (random.one_in(3)) spring->rest_length = extreme(random);
  }
  for (Force& force : scene.system.forces)
    for (double& value : force.values)
      if (random.one_in(4)) value *= extreme(random);
  if (random.one_in(3)) scene.system.drag = extreme(random);
  if (random.one_in(3)) scene.system.gravity *= extreme(random);
  scene.settings.frame_rate = random.one_in(2) ? 60.0 : extreme(random);
  return scene;
}

// A rejected frame is reported: the run is paused, and a point or spring is named.
void expect_named(const Status& status) {
  const std::optional<Divergence>& divergence = status.snapshot->divergence;
  expect(divergence.has_value(), "a frame was rejected without a reason");
  expect(!status.run.running, "the run continues after a frame was rejected");
  expect(!status.diagnosis.message.empty(), "a frame was rejected without a message");
  expect(divergence->point || divergence->spring, "a frame was rejected and no item is named: " + status.diagnosis.message);
}

long run(std::uint64_t number) {
  Random random(number);
  Lab lab(extreme_scene(random), KeepStart::No);
  for (int frame = 0; frame < frames; ++frame) {
    const State before = lab.scene().state;
    const bool succeeded = lab.step();
    lab.publish();
    const Status& status = *lab.status();
    expect(is_valid(status), "a state with non-finite numbers is published");
    if (succeeded) continue;
    expect(lab.scene().state.position == before.position && lab.scene().state.velocity == before.velocity, "the last good state is lost");
    expect_named(status);
    break;
  }
  return 1;
}

}  // namespace

// an adaptive method may use 2 million force evaluations in each frame, which takes up to 6 s
const Check extremes{"extremes", "sets of parameters", 60, run};

}  // namespace hooke
