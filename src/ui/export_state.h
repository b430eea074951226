// The settings of the export dialog.
#pragma once

#include <cstddef>
#include <string>

namespace hooke {

struct PictureOptions {
  int width = 0, height = 0;  // [px]; 0: as on screen
  bool transparent = false;
  bool panels = false;  // the whole window instead of the scene
};

struct ExportState {
  bool is_shown = false, is_new = false;
  std::size_t kind = 0;  // index into export_kinds()
  std::string path;      // as typed; its extension follows the kind
  std::string quantities = "time, kinetic, elastic, gravitational, total";
  double seconds = 2.0;
  PictureOptions picture;
};

}  // namespace hooke
