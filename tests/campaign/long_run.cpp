// A run over days of simulated time does not use more and more memory, and an undamped scene conserves energy.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include "campaign/check.h"
#include "formats/scene_file.h"
#include "lab/lab.h"
#include "sim/methods/integrator.h"
#include "support/valid_scene.h"

namespace hooke {
namespace {

// A case covers one day at 60 frames per second, or HOOKE_FRAMES frames.
constexpr long frames_of_a_day = 5'184'000, frames_per_sample = 20'000;
constexpr double max_growth = 1 << 20;  // [bytes], over the second half

double resident_bytes() {
  long pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file != nullptr && std::fscanf(file, "%ld %ld", &pages, &resident) != 2) resident = 0;
  if (file != nullptr) std::fclose(file);
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Three points on undamped springs under gravity: a motion that never repeats.
Scene pendulum() {
  Scene scene = empty_scene();
  scene.system.colliders.clear();
  for (const Vec3& place : {Vec3(0.0), Vec3(0.5, 0.0, 0.0), Vec3(1.0, 0.1, 0.0)}) {
    scene.system.append_point({.id = scene.system.new_point_id(), .nailed = scene.state.position.empty()});
    scene.state.position.push_back(place);
    scene.state.velocity.emplace_back(0.0);
  }
  for (std::uint32_t i = 0; i < 2; ++i)
    scene.system.append_spring(
        {.id = scene.system.new_spring_id(), .first = PointId{i}, .second = PointId{i + 1}, .stiffness = 400.0, .rest_length = 0.5});
  scene.system.drag = 0.0;
  scene.settings.integrator = find_integrator("velocity_verlet");
  scene.settings.substeps = 8;
  return scene;
}

long run(std::uint64_t) {
  const char* given = std::getenv("HOOKE_FRAMES");
  const long frames = given != nullptr ? std::atol(given) : frames_of_a_day;
  Lab lab(pendulum());
  lab.publish();
  const double scale = std::abs(lab.status()->snapshot->energy.total()) + 10.0;  // [J]
  double half_way = 0.0, first = 0.0, second = 0.0;                              // [bytes], [J]: the largest energy errors of the halves
  const double start = lab.status()->snapshot->energy.total();
  for (long frame = 1; frame <= frames; ++frame) {
    expect(lab.step(), "the run diverged at frame " + std::to_string(frame));
    lab.publish();
    double& largest = frame <= frames / 2 ? first : second;
    largest = std::max(largest, std::abs(lab.status()->snapshot->energy.total() - start));
    if (frame == frames / 2) half_way = resident_bytes();
    if (frame % frames_per_sample == 0) expect(is_valid(*lab.status()), "the scene is not valid at frame " + std::to_string(frame));
  }
  const double growth = resident_bytes() - half_way;
  std::fprintf(stderr, "memory grew by %.0f bytes over the second half; energy error %.3g J, then %.3g J\n", growth, first, second);
  expect(growth <= max_growth, "memory grows by " + std::to_string(growth) + " bytes");
  expect(second <= 2.0 * first + 1e-9 * scale, "the energy drifts");
  return frames;
}

}  // namespace

const Check long_run{"long_run", "frames", 0, run};

}  // namespace hooke
