// Runs a scene from its current state and writes each frame to a file: a table of quantities, or a point cache.
#pragma once

#include <filesystem>
#include <vector>

#include "base/progress.h"
#include "scene/quantity.h"
#include "scene/scene.h"

namespace hooke {

struct FrameExport {
  std::filesystem::path file;        // in a format that is written over time
  double seconds = 2.0;              // [s], starting from the current state
  std::vector<Quantity> quantities;  // of a .csv
};

// Writes the start and the end of each frame. `progress` receives the fraction done and may cancel the export, which then leaves no file.
// Throws InputError or FileError; a run that diverges writes the frames before the divergence and throws InputError with the reason.
void write_frames(Scene scene, const FrameExport& request, const Progress& progress);

}  // namespace hooke
