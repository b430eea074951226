// What is about to be exported, and how far that is.
#pragma once

#include <cstddef>
#include <string>

namespace hooke {

struct ExportState {
  bool is_shown = false, is_new = false;
  std::size_t kind = 0;  // index into export_kinds()
  std::string path;      // as typed; its ending follows the kind
  std::string quantities = "time, kinetic, elastic, gravitational, total";
  double seconds = 2.0;
  bool wants_export = false, wants_stop = false;
  double fraction = -1.0;        // that is done; below 0: nothing is going on
  double running_seconds = 0.0;  // [s] since it began
  bool is_running() const { return fraction >= 0.0; }
};

}  // namespace hooke
