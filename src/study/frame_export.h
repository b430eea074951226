// What a scene does from here on, frame by frame into a file: quantities as a table, or all points as a point cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/progress.h"
#include "scene/quantity.h"
#include "scene/scene.h"

namespace hooke {

struct FrameExport {
  std::filesystem::path file;        // .csv or .pc2
  double seconds = 2.0;              // [s], from the scene's state on
  std::vector<Quantity> quantities;  // of a .csv
};

// Steps the scene and writes its start and the end of every frame. `progress` is told the share that is done, and may stop
// it: then there is no file. Throws InputError or FileError; a run that diverges leaves what came before and throws InputError with the
// reason.
void write_frames(Scene scene, const FrameExport& request, const Progress& progress);

}  // namespace hooke
