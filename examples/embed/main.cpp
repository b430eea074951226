// A chain between two nails, built and stepped with the library: its sag, its energy and the estimated error, frame by frame.
#include <hooke/hooke.h>

#include <cstdio>
#include <span>

int main() try {
  namespace hk = hooke::v1;
  hk::Scene scene;
  scene.add(R"("generators": [{"type": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "points": 21, "mass": 0.1, "stiffness": 1000,
                               "damping": 0.1, "nail": ["from", "to"]}])");
  scene.set_substeps(40);

  hk::Simulation simulation(scene, hk::Simulation::Accuracy::Full);
  for (int frame = 1; frame <= 60; ++frame) {
    if (!simulation.step()) return std::puts(simulation.diagnosis().c_str()), 1;
    const std::span<const double> positions = simulation.positions();
    if (frame % 20 == 0)
      std::printf("%.2f s: sag %.4f m, energy %.4f J, error %.1e m\n", simulation.time(), -positions[3 * 10 + 1],
                  simulation.energy().total(), simulation.error());
  }
  simulation.nail(20, false);  // release one end, and undo that
  simulation.step();
  simulation.undo();
  std::printf("libhooke %s, hash %016llx\n", hk::version(), static_cast<unsigned long long>(simulation.hash()));
} catch (const hooke::v1::Error& error) {
  std::puts(error.what());
  return 3;
}
