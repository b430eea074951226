// What a scene does from here on, frame by frame into a file: quantities as a table, or all points as a point cache.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lab/goes_on.h"
#include "lab/quantity.h"
#include "lab/scene.h"

namespace hooke {

struct FramesFile {
  std::filesystem::path file;        // .csv or .pc2
  double seconds = 2.0;              // [s], from the scene's state on
  std::vector<Quantity> quantities;  // of a .csv
};

// Steps the scene and writes its start and the end of every frame. `goes_on` is told the share that is done, and may stop
// it: then there is no file. Throws Refused or FileError; a run that diverges leaves what came before and throws Refused with the reason.
void write_frames(Scene scene, const FramesFile& wanted, const GoesOn& goes_on);

}  // namespace hooke
