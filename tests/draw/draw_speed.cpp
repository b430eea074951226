// Time to draw a scene without a display: draw_speed SCENE SAMPLES. Prints milliseconds: minimum and median of 30 pictures of 1280 x 720,
// each drawn to completion; the first picture, including creation of the context; minimum and median of the CPU time of all threads.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "batch/offscreen.h"
#include "draw/gl/gl.h"
#include "draw/view.h"
#include "formats/open_file.h"
#include "formats/scene_file.h"
#include "lab/lab.h"

int main(int count, char** arguments) {
  using namespace hooke;
  if (count != 3) return 2;
  constexpr int width = 1280, height = 720, pictures = 30;
  const auto processor_ms = [] {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
  };

  Lab lab(load_scene(arguments[1]).scene);
  for (int frame = 0; frame < 30; ++frame) lab.step();
  lab.publish();
  const Snapshot& snapshot = *lab.status()->snapshot;
  ViewOptions options = options_for(lab.scene().view, lab.scene().cloth_texture);
  options.samples = std::atoi(arguments[2]);
  const Camera camera = make_camera(lab.scene().view, lab.scene().system, lab.scene().state, double(width) / height);

  const auto start = std::chrono::steady_clock::now();
  const Offscreen offscreen;
  View view;
  view.draw(snapshot, {}, camera, options, width, height, nullptr);
  glFinish();
  const double first = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

  std::vector<double> times, processor_times;
  for (int i = 0; i < pictures; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    const double worked = processor_ms();
    view.draw(snapshot, {}, camera, options, width, height, nullptr);
    glFinish();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    processor_times.push_back(processor_ms() - worked);
  }
  std::sort(times.begin(), times.end());
  std::sort(processor_times.begin(), processor_times.end());
  std::printf("%.1f %.1f %.0f %.1f %.1f\n", times.front(), times[pictures / 2], first, processor_times.front(),
              processor_times[pictures / 2]);
}
