// Peak memory of `hooke run` in a large net.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <string>
#include <vector>

#include "base/formatted.h"
#include "support/process.h"
#include "support/scratch_folder.h"

namespace hooke {
namespace {

const std::string program = HOOKE_HEADLESS;

// [bytes], of a process that succeeds.
double peak_memory(const std::vector<std::string>& words) {
  const int out = open("/dev/null", O_WRONLY | O_CLOEXEC);
  const pid_t child = start_process(words, out, STDERR_FILENO);
  close(out);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  EXPECT_EQ(status, 0);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

// Of a cloth of n x n points with faces that falls for so many frames, besides that of the program alone.
double bytes_per_spring(int n, int frames) {
  const ScratchFolder scratch;
  const std::string scene = scratch.folder / "cloth.json";
  std::ofstream(scene) << formatted(
      R"({"hooke": 1, "gravity": [0, 0, -9.81], "generators": [{"type": "cloth", "corner": [0, 0, 0], "across": [1, 0, 0],
          "down": [0, -1, 0], "points": [%d, %d], "density": 0.2, "stiffness": 0.001, "shear_stiffness": 0.0005, "mass_model": "equal",
          "nail": ["top_left", "top_right"]}],
          "simulation": {"integrator": "velocity_verlet", "frame_rate": 30, "substeps": 6}})",
      n, n);
  const double peak = peak_memory({program, "run", scene, "--seconds", std::to_string(frames / 30.0), "--accuracy", "off", "--points", "0",
                                   "--json", scratch.folder / "result.json"});
  return (peak - peak_memory({program, "--limits"})) / (4.0 * n * n - 6.0 * n + 2.0);
}

TEST(RunMemory, IsAtMost125BytesPerSpringOfALargeCloth) { EXPECT_LE(bytes_per_spring(1024, 1), 125.0); }

// A state of each second is kept for a search for a remedy, but not where such a search would not get as far. An array of three doubles per
// point is longer than 4 MiB here and given back as soon as it is freed: of shorter ones, the C library keeps now more, now fewer.
TEST(RunMemory, DoesNotGrowWithTimeInALargeNet) { EXPECT_NEAR(bytes_per_spring(448, 35), bytes_per_spring(448, 3), 6.0); }

}  // namespace
}  // namespace hooke
